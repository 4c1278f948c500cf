#include "fmi2_front.h"

Instance *fmi2_enter_exchange(fmi2Component c, unsigned phases, const char *function) {
    Instance *s = fmi2_enter(c, phases, function);
    if (!s || s->interface == MODEL_EXCHANGE) return s;
    log_message(s, LOG_ERROR, "%s: only for model exchange.", function);
    return NULL;
}

Instance *fmi2_enter_cosim(fmi2Component c, unsigned phases, const char *function) {
    Instance *s = fmi2_enter(c, phases, function);
    if (!s || s->interface == CO_SIMULATION) return s;
    log_message(s, LOG_ERROR, "%s: only for co-simulation.", function);
    return NULL;
}

bool fmi2_are_arrays(Instance *s, const char *function, const void *a, const void *b, size_t n) {
    return n == 0 || (instance_no_null(s, function, a) && instance_no_null(s, function, b));
}
