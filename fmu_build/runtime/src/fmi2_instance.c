/* FMI 2.0: version, log, instances, initialization, end. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cosim.h"
#include "exchange.h"
#include "fmi2_front.h"

static void send_message(void *front, const char *name, int status, const char *category, const char *message) {
    const Fmi2Front *f = front;
    f->logger(f->environment, name, (fmi2Status)status, category, "%s", message);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
    Instance *s = fmi2_enter(c, IN_ANY, "fmi2SetDebugLogging");
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
    Fmi2Front *front = calloc(1, sizeof *front);
    s->front = front;
    s->log.instance_name = copy_text(name);
    if (!front || !s->log.instance_name) return false;
    if (functions) {
        front->logger = functions->logger;
        front->environment = functions->componentEnvironment;
    }
    s->log.environment = front;
    s->log.sink = front->logger ? send_message : NULL;
    log_begin(&s->log, logging);
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
    Instance *s = fmi2_enter(c, PHASE_INSTANTIATED, here);
    if (!s) return fmi2Error;
    return (fmi2Status)set_experiment(s, here, toleranceDefined ? tolerance : 0.0, startTime,
                                      stopTimeDefined ? stopTime : INFINITY);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    Instance *s = fmi2_enter(c, PHASE_INSTANTIATED, "fmi2EnterInitializationMode");
    if (!s) return fmi2Error;
    set_phase(s, PHASE_INITIALIZATION);
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    Instance *s = fmi2_enter(c, PHASE_INITIALIZATION, "fmi2ExitInitializationMode");
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
    Instance *s = fmi2_enter(c, RUNNING, "fmi2Terminate");
    return s ? (fmi2Status)terminate(s) : fmi2Error;
}

fmi2Status fmi2Reset(fmi2Component c) {
    Instance *s = fmi2_enter(c, IN_ANY, "fmi2Reset");
    if (!s) return fmi2Error;
    instance_reset(s);
    return fmi2OK;
}
