/* What the functions of the FMI 2 front end share: entry checks and the states in which each is allowed. */
#ifndef FMI2_FRONT_H
#define FMI2_FRONT_H

#include "fmi2Functions.h"
#include "instance.h"

/* Sets of states: FMI 2.0.4, Sections 3.2.3 and 4.2.4. */
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

/* The importer's callback. */
typedef struct {
    fmi2CallbackLogger logger;
    fmi2ComponentEnvironment environment;
} Fmi2Front;

/* The instance, or null (logged if there is one) where `function` must not be called. */
static inline Instance *fmi2_enter(fmi2Component c, unsigned phases, const char *function) {
    Instance *s = c;
    return s && instance_in_phase(s, phases, function) ? s : NULL;
}
Instance *fmi2_enter_exchange(fmi2Component c, unsigned phases, const char *function);
Instance *fmi2_enter_cosim(fmi2Component c, unsigned phases, const char *function);

/* False, logged, if a pointer is null; arrays of no elements may be. */
bool fmi2_are_arrays(Instance *s, const char *function, const void *a, const void *b, size_t n);

#endif
