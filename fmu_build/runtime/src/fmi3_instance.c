/* FMI 3.0: version, log, instances, initialization, end. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cosim.h"
#include "exchange.h"
#include "fmi3_front.h"

static void send_message(void *front, const char *name, int status, const char *category, const char *message) {
    const Fmi3Front *f = front;
    (void)name; /* the environment tells FMI 3 importers which instance speaks */
    f->log_message(f->environment, (fmi3Status)status, category, message);
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[]) {
    Instance *s = fmi3_enter(instance, IN_ANY, "fmi3SetDebugLogging");
    return s && log_enable(s, loggingOn, nCategories, categories) ? fmi3OK : fmi3Error;
}

static Instance *refuse(const Fmi3Front *front, const char *why) {
    if (front->log_message) front->log_message(front->environment, fmi3Error, "logStatusError", why);
    return NULL;
}

static bool furnish(Instance *s, fmi3String name, const Fmi3Front *front, bool logging) {
    s->front = malloc(sizeof *front);
    s->log.instance_name = malloc(strlen(name) + 1);
    if (!s->front || !s->log.instance_name) return false;
    memcpy(s->front, front, sizeof *front);
    memcpy(s->log.instance_name, name, strlen(name) + 1);
    s->log.environment = s->front;
    s->log.sink = front->log_message ? send_message : NULL;
    log_begin(&s->log, logging);
    return true;
}

static Instance *instantiate(fmi3String name, fmi3String token, bool logging, const Fmi3Front *front,
                             Interface interface) {
    if (!name || name[0] == '\0') return refuse(front, "fmi3Instantiate: the instance has no name.");
    if (!token || strcmp(token, model.token) != 0)
        return refuse(front, "fmi3Instantiate: the instantiation token is not that of this FMU.");
    Instance *s = instance_new(&model, interface);
    if (s && furnish(s, name, front, logging)) return s;
    instance_free(s);
    return refuse(front, "fmi3Instantiate: there is not enough memory.");
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    (void)resourcePath, (void)visible;
    const Fmi3Front front = {logMessage, NULL, instanceEnvironment};
    return instantiate(instanceName, instantiationToken, loggingOn, &front, MODEL_EXCHANGE);
}

/* Asks the importer, at the end of an internal step, whether it wants to stop here or soon. */
static bool intermediate_update(Instance *s, double time, double *return_time) {
    const Fmi3Front *front = s->front;
    fmi3Boolean wanted = fmi3False;
    fmi3Float64 wanted_time = time;
    set_phase(s, PHASE_INTERMEDIATE);
    front->update(front->environment, time, fmi3False, fmi3True, fmi3True, s->early_return_allowed, &wanted,
                  &wanted_time);
    set_phase(s, PHASE_STEP);
    if (!wanted || !s->early_return_allowed) return false;
    *return_time = wanted_time;
    return true;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment,
                                         fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate) {
    (void)resourcePath, (void)visible;
    const Fmi3Front front = {logMessage, intermediateUpdate, instanceEnvironment};
    for (size_t k = 0; k < nRequiredIntermediateVariables; k++)
        if (!requiredIntermediateVariables || requiredIntermediateVariables[k] >= model.n_variables)
            return refuse(&front, "fmi3InstantiateCoSimulation: a required intermediate variable does not exist.");
    Instance *s = instantiate(instanceName, instantiationToken, loggingOn, &front, CO_SIMULATION);
    if (!s) return NULL;
    s->event_mode_used = eventModeUsed;
    s->early_return_allowed = earlyReturnAllowed;
    s->intermediate_update = intermediateUpdate ? intermediate_update : NULL;
    return s;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken,
                                               fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                               fmi3InstanceEnvironment instanceEnvironment,
                                               fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
                                               fmi3LockPreemptionCallback lockPreemption,
                                               fmi3UnlockPreemptionCallback unlockPreemption) {
    (void)instanceName, (void)instantiationToken, (void)resourcePath, (void)visible, (void)loggingOn;
    (void)clockUpdate, (void)lockPreemption, (void)unlockPreemption;
    const Fmi3Front front = {logMessage, NULL, instanceEnvironment};
    return refuse(&front, "fmi3InstantiateScheduledExecution: this FMU is for model exchange and co-simulation.");
}

void fmi3FreeInstance(fmi3Instance instance) { instance_free(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    static const char *const here = "fmi3EnterInitializationMode";
    Instance *s = fmi3_enter(instance, PHASE_INSTANTIATED, here);
    if (!s) return fmi3Error;
    const Status status =
        set_experiment(s, here, toleranceDefined ? tolerance : 0.0, startTime, stopTimeDefined ? stopTime : INFINITY);
    if (status == STATUS_OK) set_phase(s, PHASE_INITIALIZATION);
    return (fmi3Status)status;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    Instance *s = fmi3_enter(instance, PHASE_INITIALIZATION, "fmi3ExitInitializationMode");
    if (!s) return fmi3Error;
    const Status status = exit_initialization(s);
    if (status > STATUS_WARNING) return (fmi3Status)status;
    const bool to_events = s->interface == MODEL_EXCHANGE || s->event_mode_used;
    set_phase(s, to_events ? PHASE_EVENT : PHASE_STEP);
    return (fmi3Status)(to_events ? status : cosim_start(s));
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    static const char *const here = "fmi3EnterEventMode";
    Instance *s = fmi3_enter(instance, PHASE_CONTINUOUS | PHASE_STEP, here);
    if (!s) return fmi3Error;
    if (s->interface == MODEL_EXCHANGE || s->event_mode_used) return (fmi3Status)enter_event_mode(s);
    log_message(s, LOG_ERROR, "%s: the instance was made with eventModeUsed = false.", here);
    return fmi3Error;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime) {
    static const char *const here = "fmi3UpdateDiscreteStates";
    Instance *s = fmi3_enter(instance, PHASE_EVENT, here);
    if (!s) return fmi3Error;
    const void *const pointers[] = {discreteStatesNeedUpdate,        terminateSimulation,  nominalsOfContinuousStatesChanged,
                                    valuesOfContinuousStatesChanged, nextEventTimeDefined, nextEventTime};
    for (size_t k = 0; k < sizeof pointers / sizeof pointers[0]; k++)
        if (!instance_no_null(s, here, pointers[k])) return fmi3Error;
    EventResult result;
    const Status status = update_discrete_states(s, &result);
    *discreteStatesNeedUpdate = fmi3False; /* the iteration is ours, and done */
    *terminateSimulation = result.terminate;
    *nominalsOfContinuousStatesChanged = fmi3False;
    *valuesOfContinuousStatesChanged = result.x_changed;
    *nextEventTimeDefined = isfinite(result.next_time);
    *nextEventTime = result.next_time;
    return (fmi3Status)status;
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    Instance *s = fmi3_enter(instance, RUNNING, "fmi3Terminate");
    return s ? (fmi3Status)terminate(s) : fmi3Error;
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    Instance *s = fmi3_enter(instance, IN_STATE, "fmi3Reset");
    if (!s) return fmi3Error;
    instance_reset(s);
    return fmi3OK;
}
