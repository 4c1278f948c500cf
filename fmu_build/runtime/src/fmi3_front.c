#include "fmi3_front.h"

static Instance *enter_interface(fmi3Instance instance, unsigned phases, const char *function, Interface interface) {
    Instance *s = fmi3_enter(instance, phases, function);
    if (!s || s->interface == interface) return s;
    log_message(s, LOG_ERROR, "%s: only for %s.", function,
                interface == MODEL_EXCHANGE ? "model exchange" : "co-simulation");
    return NULL;
}

Instance *fmi3_enter_exchange(fmi3Instance instance, unsigned phases, const char *function) {
    return enter_interface(instance, phases, function, MODEL_EXCHANGE);
}

Instance *fmi3_enter_cosim(fmi3Instance instance, unsigned phases, const char *function) {
    return enter_interface(instance, phases, function, CO_SIMULATION);
}

fmi3Status fmi3_no_ability(fmi3Instance instance, const char *function) {
    Instance *s = fmi3_enter(instance, IN_ANY, function);
    if (s) log_message(s, LOG_ERROR, "%s: this FMU has no such ability, as its description says.", function);
    return fmi3Error;
}
