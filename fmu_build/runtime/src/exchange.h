/* What FMI 2 and FMI 3 have in common above the single function: life cycle and model exchange. Arguments are
   checked by the fronts; every function leaves the instance in PHASE_FAILED when it returns Error. */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#include "events.h"
#include "instance.h"

/* Time span and tolerance (<= 0: the model's own). Error, logged, if a number is not usable. */
Status set_experiment(Instance *s, const char *function, double tolerance, double start_time, double stop_time);

Status exit_initialization(Instance *s);
Status terminate(Instance *s);
Status update_discrete_states(Instance *s, EventResult *result);

Status set_time(Instance *s, const char *function, double time);
Status enter_event_mode(Instance *s);
Status completed_step(Instance *s, bool *enter_event_mode);

/* Up-to-date values in any phase from initialization on. */
Status current_states(Instance *s);
Status current_derivatives(Instance *s);
Status current_indicators(Instance *s, double *z);

#endif
