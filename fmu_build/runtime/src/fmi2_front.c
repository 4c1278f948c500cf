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

bool fmi2_no_null(Instance *s, const char *function, const void *pointer) {
    if (pointer) return true;
    log_message(s, LOG_ERROR, "%s: a pointer is null.", function);
    return false;
}

bool fmi2_is_array(Instance *s, const char *function, const void *array, size_t n, size_t expected) {
    if (n == expected) return n == 0 || fmi2_no_null(s, function, array);
    log_message(s, LOG_ERROR, "%s: %zu values were given, but there are %zu.", function, n, expected);
    return false;
}

bool fmi2_are_arrays(Instance *s, const char *function, const void *a, const void *b, size_t n) {
    return n == 0 || (fmi2_no_null(s, function, a) && fmi2_no_null(s, function, b));
}
