/* What the functions of the FMI 3 front end share: entry checks and the states in which each is allowed. */
#ifndef FMI3_FRONT_H
#define FMI3_FRONT_H

#include "fmi3Functions.h"
#include "instance.h"

/* Sets of states: FMI 3.0, Sections 2.3, 3.2 and 4.2. */
enum {
    BEFORE_START = PHASE_INSTANTIATED | PHASE_INITIALIZATION,
    RUNNING = PHASE_EVENT | PHASE_CONTINUOUS | PHASE_STEP,
    ENDED = PHASE_TERMINATED | PHASE_FAILED,
    IN_ANY = BEFORE_START | RUNNING | PHASE_INTERMEDIATE | ENDED,
    IN_SET = BEFORE_START | RUNNING,
    IN_SET_DISCRETE = BEFORE_START | PHASE_EVENT | PHASE_STEP,
    IN_STATE = BEFORE_START | RUNNING | ENDED, /* not inside a callback */
    IN_VALUES = PHASE_INITIALIZATION | RUNNING | PHASE_TERMINATED
};

typedef struct {
    fmi3LogMessageCallback log_message;
    fmi3IntermediateUpdateCallback update;
    fmi3InstanceEnvironment environment;
} Fmi3Front;

/* The instance, or null (logged if there is one) where `function` must not be called. */
static inline Instance *fmi3_enter(fmi3Instance instance, unsigned phases, const char *function) {
    Instance *s = instance;
    return s && instance_in_phase(s, phases, function) ? s : NULL;
}
Instance *fmi3_enter_exchange(fmi3Instance instance, unsigned phases, const char *function);
Instance *fmi3_enter_cosim(fmi3Instance instance, unsigned phases, const char *function);

/* Error, logged: the FMU's description does not claim this ability. */
fmi3Status fmi3_no_ability(fmi3Instance instance, const char *function);

#endif
