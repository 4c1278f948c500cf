#include "exchange.h"

#include <math.h>

#include "constraints.h"
#include "evaluate.h"
#include "initialise.h"
#include "relations.h"

static Status failed_if_error(Instance *s, Status status) {
    if (status == STATUS_ERROR) set_phase(s, PHASE_FAILED);
    return status;
}

Status set_experiment(Instance *s, const char *function, double tolerance, double start_time, double stop_time) {
    if (!isfinite(start_time) || isnan(stop_time) || stop_time < start_time || isnan(tolerance)) {
        log_message(s, LOG_ERROR, "%s: start time %g s, stop time %g s, tolerance %g are not usable.", function,
                    start_time, stop_time, tolerance);
        return STATUS_ERROR;
    }
    s->memory->start_time = start_time;
    s->memory->stop_time = stop_time;
    if (tolerance > 0.0) s->memory->tolerance = tolerance;
    *s->t = start_time;
    changed_parameters(s);
    return STATUS_OK;
}

Status exit_initialization(Instance *s) {
    Status status = initialise(s);
    if (status == STATUS_DISCARD) status = STATUS_ERROR; /* there is no other point to go to */
    return failed_if_error(s, status);
}

Status terminate(Instance *s) {
    const Status status = events_terminal(s);
    set_phase(s, PHASE_TERMINATED);
    return status;
}

Status update_discrete_states(Instance *s, EventResult *result) {
    return failed_if_error(s, events_update(s, result));
}

Status set_time(Instance *s, const char *function, double time) {
    if (time == *s->t) return STATUS_OK;
    if (!isfinite(time)) {
        log_message(s, LOG_ERROR, "%s: the time is %g.", function, time);
        return STATUS_ERROR;
    }
    *s->t = time;
    changed_point(s);
    return STATUS_OK;
}

Status enter_event_mode(Instance *s) {
    set_phase(s, PHASE_EVENT);
    return evaluate_history(s, false);
}

Status completed_step(Instance *s, bool *enter_event_mode) {
    Status status = relations_are_crossed(s, enter_event_mode);
    if (status == STATUS_OK) status = evaluate_history(s, false);
    if (status == STATUS_OK) status = constraints_check(s);
    if (status == STATUS_OK) status = events_check(s);
    return failed_if_error(s, status);
}

Status current_states(Instance *s) {
    return s->memory->phase == PHASE_INITIALIZATION ? initialise(s) : STATUS_OK;
}

Status current_derivatives(Instance *s) {
    const Status status = current_states(s);
    return status == STATUS_OK ? evaluate_derivatives(s) : status;
}

Status current_indicators(Instance *s, double *z) {
    const Status status = current_states(s);
    return status == STATUS_OK ? relations_indicators(s, z) : status;
}
