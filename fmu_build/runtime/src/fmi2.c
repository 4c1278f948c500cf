/* FMI 2.0: checks arguments and call order, then calls the runtime. Compiled into FMI 2 FMUs only. */
#include "fmi2Functions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cosim.h"
#include "evaluate.h"
#include "exchange.h"
#include "sensitivity.h"
#include "state.h"
#include "variables.h"

/* States in which a function is allowed: FMI 2.0.4, Sections 3.2.3 and 4.2.4. */
enum {
    RUNNING_ME = PHASE_EVENT | PHASE_CONTINUOUS,
    RUNNING = RUNNING_ME | PHASE_STEP | PHASE_STEP_FAILED,
    ENDED = PHASE_TERMINATED | PHASE_FAILED,
    IN_ANY = PHASE_INSTANTIATED | PHASE_INITIALIZATION | RUNNING | ENDED,
    IN_GET = PHASE_INITIALIZATION | RUNNING | ENDED,
    IN_SET = PHASE_INSTANTIATED | PHASE_INITIALIZATION | RUNNING_ME | PHASE_STEP,
    IN_SET_DISCRETE = PHASE_INSTANTIATED | PHASE_INITIALIZATION | PHASE_EVENT | PHASE_STEP,
    IN_PARTIALS = PHASE_INITIALIZATION | RUNNING | PHASE_TERMINATED,
    IN_VALUES_ME = PHASE_INITIALIZATION | RUNNING_ME | PHASE_TERMINATED,
    IN_STATUS = PHASE_STEP | PHASE_STEP_FAILED | PHASE_TERMINATED
};

/* The importer's callback, and what the status functions report. */
typedef struct {
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
    double last_successful_time;
    bool terminated;
} Front;

static void send_message(void *front, const char *name, int status, const char *category, const char *message) {
    const Front *f = front;
    f->logger(f->environment, name, (fmi2Status)status, category, "%s", message);
}

static Instance *enter(fmi2Component c, unsigned phases, const char *function) {
    Instance *s = c;
    return s && instance_in_phase(s, phases, function) ? s : NULL;
}

static Instance *enter_exchange(fmi2Component c, unsigned phases, const char *function) {
    Instance *s = enter(c, phases, function);
    if (!s || s->interface == MODEL_EXCHANGE) return s;
    log_message(s, LOG_ERROR, "%s: only for model exchange.", function);
    return NULL;
}

static Instance *enter_cosim(fmi2Component c, unsigned phases, const char *function) {
    Instance *s = enter(c, phases, function);
    if (!s || s->interface == CO_SIMULATION) return s;
    log_message(s, LOG_ERROR, "%s: only for co-simulation.", function);
    return NULL;
}

static bool no_null(Instance *s, const char *function, const void *pointer) {
    if (pointer) return true;
    log_message(s, LOG_ERROR, "%s: a pointer is null.", function);
    return false;
}

/* An array of `n` values where `expected` are wanted. */
static bool is_array(Instance *s, const char *function, const void *array, size_t n, size_t expected) {
    if (n == expected) return n == 0 || no_null(s, function, array);
    log_message(s, LOG_ERROR, "%s: %zu values were given, but there are %zu.", function, n, expected);
    return false;
}

static bool are_arrays(Instance *s, const char *function, const void *a, const void *b, size_t n) {
    return n == 0 || (no_null(s, function, a) && no_null(s, function, b));
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
    Instance *s = enter(c, IN_ANY, "fmi2SetDebugLogging");
    if (!s || !log_enable(s, loggingOn != fmi2False, nCategories, categories)) return fmi2Error;
    return fmi2OK;
}

/* Reports what is wrong before there is an instance that could. */
static void refuse(const fmi2CallbackFunctions *functions, fmi2String name, const char *why) {
    if (functions && functions->logger)
        functions->logger(functions->componentEnvironment, name ? name : "", fmi2Error, "logStatusError",
                          "fmi2Instantiate: %s", why);
}

static char *copy_text(const char *text) {
    char *copy = malloc(strlen(text) + 1);
    if (copy) memcpy(copy, text, strlen(text) + 1);
    return copy;
}

static const char *objection(fmi2String name, fmi2Type type, fmi2String guid) {
    if (!name || name[0] == '\0') return "the instance has no name.";
    if (!guid || strcmp(guid, model.token) != 0) return "the GUID is not that of this FMU.";
    return type == fmi2ModelExchange || type == fmi2CoSimulation ? NULL : "the FMU type is unknown.";
}

static bool furnish(Instance *s, fmi2String name, const fmi2CallbackFunctions *functions, bool logging) {
    Front *front = calloc(1, sizeof *front);
    s->front = front;
    s->log.instance_name = copy_text(name);
    if (!front || !s->log.instance_name) return false;
    if (functions) {
        front->logger = functions->logger;
        front->environment = functions->componentEnvironment;
    }
    s->log.environment = front;
    s->log.sink = front->logger ? send_message : NULL;
    for (int k = 0; k < LOG_CATEGORIES; k++) s->log.enabled[k] = k != LOG_EVENTS || logging;
    return true;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn) {
    (void)fmuResourceLocation;
    (void)visible;
    const char *why = objection(instanceName, fmuType, fmuGUID);
    if (why) {
        refuse(functions, instanceName, why);
        return NULL;
    }
    Instance *s = instance_new(&model, fmuType == fmi2ModelExchange ? MODEL_EXCHANGE : CO_SIMULATION);
    if (s && furnish(s, instanceName, functions, loggingOn != fmi2False)) return s;
    refuse(functions, instanceName, "there is not enough memory.");
    instance_free(s);
    return NULL;
}

void fmi2FreeInstance(fmi2Component c) { instance_free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
    static const char *const here = "fmi2SetupExperiment";
    Instance *s = enter(c, PHASE_INSTANTIATED, here);
    if (!s) return fmi2Error;
    return (fmi2Status)set_experiment(s, here, toleranceDefined ? tolerance : 0.0, startTime,
                                      stopTimeDefined ? stopTime : INFINITY);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    Instance *s = enter(c, PHASE_INSTANTIATED, "fmi2EnterInitializationMode");
    if (!s) return fmi2Error;
    set_phase(s, PHASE_INITIALIZATION);
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    Instance *s = enter(c, PHASE_INITIALIZATION, "fmi2ExitInitializationMode");
    if (!s) return fmi2Error;
    Status status = exit_initialization(s);
    if (status > STATUS_WARNING) return (fmi2Status)status;
    if (s->interface == MODEL_EXCHANGE) {
        set_phase(s, PHASE_EVENT);
        return (fmi2Status)status;
    }
    set_phase(s, PHASE_STEP);
    return (fmi2Status)cosim_start(s);
}

fmi2Status fmi2Terminate(fmi2Component c) {
    Instance *s = enter(c, RUNNING, "fmi2Terminate");
    return s ? (fmi2Status)terminate(s) : fmi2Error;
}

fmi2Status fmi2Reset(fmi2Component c) {
    Instance *s = enter(c, IN_ANY, "fmi2Reset");
    if (!s) return fmi2Error;
    instance_reset(s);
    return fmi2OK;
}

/* Get and set for each type: the loop is the same, the C type of the values is not. */
#define GET(Type, type_code, from_double)                                                                     \
    fmi2Status fmi2Get##Type(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2##Type value[]) { \
        static const char *const here = "fmi2Get" #Type;                                                      \
        Instance *s = enter(c, IN_GET, here);                                                                 \
        if (!s || !are_arrays(s, here, vr, value, nvr)) return fmi2Error;                                     \
        for (size_t k = 0; k < nvr; k++) {                                                                    \
            double x = 0.0;                                                                                   \
            const Status status = variable_get(s, here, vr[k], type_code, &x);                                \
            if (status != STATUS_OK) return (fmi2Status)status;                                               \
            value[k] = from_double;                                                                           \
        }                                                                                                     \
        return fmi2OK;                                                                                        \
    }

#define SET(Type, type_code, phases, to_double)                                                                     \
    fmi2Status fmi2Set##Type(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2##Type value[]) { \
        static const char *const here = "fmi2Set" #Type;                                                            \
        Instance *s = enter(c, phases, here);                                                                       \
        if (!s || !are_arrays(s, here, vr, value, nvr)) return fmi2Error;                                           \
        for (size_t k = 0; k < nvr; k++) {                                                                          \
            const Status status = variable_set(s, here, vr[k], type_code, to_double);                               \
            if (status != STATUS_OK) return (fmi2Status)status;                                                     \
        }                                                                                                           \
        return fmi2OK;                                                                                              \
    }

GET(Real, TYPE_REAL, x)
GET(Integer, TYPE_INTEGER, (fmi2Integer)lround(x))
GET(Boolean, TYPE_BOOLEAN, x > 0.5 ? fmi2True : fmi2False)
SET(Real, TYPE_REAL, IN_SET, value[k])
SET(Integer, TYPE_INTEGER, IN_SET_DISCRETE, (double)value[k])
SET(Boolean, TYPE_BOOLEAN, IN_SET_DISCRETE, value[k] ? 1.0 : 0.0)

static fmi2Status no_strings(fmi2Component c, const char *function, size_t nvr) {
    Instance *s = enter(c, IN_ANY, function);
    if (!s) return fmi2Error;
    if (nvr == 0) return fmi2OK;
    log_message(s, LOG_ERROR, "%s: the model has no String variables.", function);
    return fmi2Error;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[]) {
    (void)vr;
    (void)value;
    return no_strings(c, "fmi2GetString", nvr);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[]) {
    (void)vr;
    (void)value;
    return no_strings(c, "fmi2SetString", nvr);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    static const char *const here = "fmi2GetFMUstate";
    Instance *s = enter(c, IN_ANY, here);
    if (!s || !no_null(s, here, FMUstate)) return fmi2Error;
    SavedState *state = *FMUstate;
    const Status status = state_save(s, here, &state);
    *FMUstate = state;
    return (fmi2Status)status;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
    static const char *const here = "fmi2SetFMUstate";
    Instance *s = enter(c, IN_ANY, here);
    if (!s || !no_null(s, here, FMUstate)) return fmi2Error;
    return (fmi2Status)state_restore(s, here, FMUstate);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    if (!enter(c, IN_ANY, "fmi2FreeFMUstate")) return fmi2Error;
    if (!FMUstate) return fmi2OK;
    state_free(*FMUstate);
    *FMUstate = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
    static const char *const here = "fmi2SerializedFMUstateSize";
    Instance *s = enter(c, IN_ANY, here);
    if (!s || !no_null(s, here, FMUstate) || !no_null(s, here, size)) return fmi2Error;
    *size = state_size(s);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte bytes[], size_t size) {
    static const char *const here = "fmi2SerializeFMUstate";
    Instance *s = enter(c, IN_ANY, here);
    if (!s || !no_null(s, here, FMUstate) || !no_null(s, here, bytes)) return fmi2Error;
    return (fmi2Status)state_serialise(s, here, FMUstate, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *FMUstate) {
    static const char *const here = "fmi2DeSerializeFMUstate";
    Instance *s = enter(c, IN_ANY, here);
    if (!s || !no_null(s, here, bytes) || !no_null(s, here, FMUstate)) return fmi2Error;
    SavedState *state = NULL;
    const Status status = state_deserialise(s, here, bytes, size, &state);
    if (status == STATUS_OK) *FMUstate = state;
    return (fmi2Status)status;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
    static const char *const here = "fmi2GetDirectionalDerivative";
    Instance *s = enter(c, IN_PARTIALS, here);
    if (!s || !are_arrays(s, here, vUnknown_ref, dvUnknown, nUnknown) ||
        !are_arrays(s, here, vKnown_ref, dvKnown, nKnown))
        return fmi2Error;
    const Partials partials = {vUnknown_ref, vKnown_ref, nUnknown, nKnown};
    return (fmi2Status)directional_derivative(s, here, &partials, dvKnown, dvUnknown);
}

fmi2Status fmi2EnterEventMode(fmi2Component c) {
    Instance *s = enter_exchange(c, RUNNING_ME, "fmi2EnterEventMode");
    return s ? (fmi2Status)enter_event_mode(s) : fmi2Error;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
    static const char *const here = "fmi2NewDiscreteStates";
    Instance *s = enter_exchange(c, PHASE_EVENT, here);
    if (!s || !no_null(s, here, info)) return fmi2Error;
    EventResult result;
    const Status status = update_discrete_states(s, &result);
    info->newDiscreteStatesNeeded = fmi2False;
    info->terminateSimulation = result.terminate;
    info->nominalsOfContinuousStatesChanged = fmi2False;
    info->valuesOfContinuousStatesChanged = result.x_changed;
    info->nextEventTimeDefined = isfinite(result.next_time) ? fmi2True : fmi2False;
    info->nextEventTime = result.next_time;
    return (fmi2Status)status;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
    Instance *s = enter_exchange(c, PHASE_EVENT, "fmi2EnterContinuousTimeMode");
    if (!s) return fmi2Error;
    set_phase(s, PHASE_CONTINUOUS);
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation) {
    static const char *const here = "fmi2CompletedIntegratorStep";
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *s = enter_exchange(c, PHASE_CONTINUOUS, here);
    if (!s || !no_null(s, here, enterEventMode) || !no_null(s, here, terminateSimulation)) return fmi2Error;
    bool event = false;
    const Status status = completed_step(s, &event);
    *enterEventMode = event;
    *terminateSimulation = s->memory->is_terminated != 0;
    return (fmi2Status)status;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
    Instance *s = enter_exchange(c, RUNNING_ME, "fmi2SetTime");
    return s ? (fmi2Status)set_time(s, "fmi2SetTime", time) : fmi2Error;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
    static const char *const here = "fmi2SetContinuousStates";
    Instance *s = enter_exchange(c, PHASE_CONTINUOUS, here);
    if (!s || !is_array(s, here, x, nx, s->model->n_x)) return fmi2Error;
    if (nx > 0) memcpy(s->x, x, nx * sizeof *x);
    changed_point(s);
    return fmi2OK;
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
    static const char *const here = "fmi2GetDerivatives";
    Instance *s = enter_exchange(c, IN_VALUES_ME, here);
    if (!s || !is_array(s, here, derivatives, nx, s->model->n_x)) return fmi2Error;
    const Status status = current_derivatives(s);
    if (status == STATUS_OK && nx > 0) memcpy(derivatives, s->dx, nx * sizeof *derivatives);
    return (fmi2Status)status;
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t ni) {
    static const char *const here = "fmi2GetEventIndicators";
    Instance *s = enter_exchange(c, IN_VALUES_ME, here);
    if (!s || !is_array(s, here, indicators, ni, s->n_state_relations)) return fmi2Error;
    return (fmi2Status)current_indicators(s, indicators);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) {
    static const char *const here = "fmi2GetContinuousStates";
    Instance *s = enter_exchange(c, IN_VALUES_ME, here);
    if (!s || !is_array(s, here, x, nx, s->model->n_x)) return fmi2Error;
    const Status status = current_states(s);
    if (status == STATUS_OK && nx > 0) memcpy(x, s->x, nx * sizeof *x);
    return (fmi2Status)status;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx) {
    static const char *const here = "fmi2GetNominalsOfContinuousStates";
    Instance *s = enter_exchange(c, IN_ANY, here);
    if (!s || !is_array(s, here, x_nominal, nx, s->model->n_x)) return fmi2Error;
    if (nx > 0) memcpy(x_nominal, s->model->nominal_x, nx * sizeof *x_nominal);
    return fmi2OK;
}

static fmi2Status no_interpolation(fmi2Component c, const char *function) {
    Instance *s = enter_cosim(c, IN_ANY, function);
    if (s) log_message(s, LOG_ERROR, "%s: this FMU has no such ability, as its description says.", function);
    return fmi2Error;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    return no_interpolation(c, "fmi2SetRealInputDerivatives");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    return no_interpolation(c, "fmi2GetRealOutputDerivatives");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    static const char *const here = "fmi2DoStep";
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *s = enter_cosim(c, PHASE_STEP, here);
    if (!s) return fmi2Error;
    Front *front = s->front;
    StepResult result;
    Status status = cosim_step(s, here, currentCommunicationPoint, communicationStepSize, &result);
    front->last_successful_time = result.time;
    front->terminated = result.terminate;
    if (status == STATUS_DISCARD) set_phase(s, PHASE_STEP_FAILED);
    if (status <= STATUS_WARNING && result.terminate) status = STATUS_DISCARD; /* how FMI 2 reports the end */
    return (fmi2Status)status;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    Instance *s = enter_cosim(c, IN_ANY, "fmi2CancelStep");
    if (s) log_message(s, LOG_ERROR, "fmi2CancelStep: steps do not run asynchronously.");
    return fmi2Error;
}

static fmi2Status no_status(Instance *s, const char *function) {
    log_message(s, LOG_ERROR, "%s: there is no such status; steps do not run asynchronously.", function);
    return fmi2Discard;
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
    static const char *const here = "fmi2GetStatus";
    Instance *s = enter_cosim(c, IN_STATUS, here);
    if (!s || !no_null(s, here, value)) return fmi2Error;
    if (kind != fmi2DoStepStatus) return no_status(s, here);
    *value = s->memory->phase == PHASE_STEP_FAILED ? fmi2Discard : fmi2OK;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    static const char *const here = "fmi2GetRealStatus";
    Instance *s = enter_cosim(c, IN_STATUS, here);
    if (!s || !no_null(s, here, value)) return fmi2Error;
    if (kind != fmi2LastSuccessfulTime) return no_status(s, here);
    *value = ((const Front *)s->front)->last_successful_time;
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    static const char *const here = "fmi2GetBooleanStatus";
    Instance *s = enter_cosim(c, IN_STATUS, here);
    if (!s || !no_null(s, here, value)) return fmi2Error;
    if (kind != fmi2Terminated) return no_status(s, here);
    *value = ((const Front *)s->front)->terminated ? fmi2True : fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
    (void)kind, (void)value;
    Instance *s = enter_cosim(c, IN_STATUS, "fmi2GetIntegerStatus");
    return s ? no_status(s, "fmi2GetIntegerStatus") : fmi2Error;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    (void)kind, (void)value;
    Instance *s = enter_cosim(c, IN_STATUS, "fmi2GetStringStatus");
    return s ? no_status(s, "fmi2GetStringStatus") : fmi2Error;
}
