#include "events.h"

#include <math.h>
#include <string.h>

#include "delay.h"
#include "evaluate.h"
#include "relations.h"
#include "timeevents.h"
#include "vector.h"

enum { MAX_PASSES = 100 };

/* Moves `new` into `old`; true if they differ in any bit (so NaN does not count as a change for ever). */
static bool take_over(double *old, const double *new, size_t n) {
    if (n == 0 || memcmp(old, new, n * sizeof *old) == 0) return false;
    memcpy(old, new, n * sizeof *old);
    return true;
}

static Status call_update(Instance *s) {
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {s->event.d, s->event.b, s->event.x, s->event.terminations};
    if (call_model(s, s->model->update, res) == STATUS_OK) return STATUS_OK;
    log_message(s, LOG_DISCARD, "Discrete equations cannot be evaluated at time %.16g s.", *s->t);
    return STATUS_DISCARD;
}

static void note_terminations(Instance *s) {
    for (size_t k = 0; k < s->model->n_terminations; k++) {
        if (!(s->event.terminations[k] > 0.5)) continue;
        if (!s->memory->is_terminated)
            log_message(s, LOG_EVENTS, "The model ends the simulation at time %.16g s: %s", *s->t,
                        s->model->terminations[k]);
        s->memory->is_terminated = 1;
    }
}

static Status check_reinitialised(Instance *s) {
    for (size_t k = 0; k < s->model->n_x; k++)
        if (!isfinite(s->event.x[k])) {
            log_message(s, LOG_DISCARD, "State %s is set to %g at time %.16g s.", variable_name(s, VECTOR_X, k),
                        s->event.x[k], *s->t);
            return STATUS_DISCARD;
        }
    return STATUS_OK;
}

/* One pass; what it changed is added to `changed` and `x_changed`. */
static Status pass(Instance *s, bool *changed, bool *x_changed) {
    const Model *m = s->model;
    bool r_changed = false;
    if (relations_update(s, &r_changed) != STATUS_OK) return STATUS_DISCARD;
    *changed = *changed || r_changed;
    if (!m->update) return STATUS_OK;
    copy(s->pre_d, s->d, m->n_d);
    if (call_update(s) != STATUS_OK || check_reinitialised(s) != STATUS_OK) return STATUS_DISCARD;
    const bool d_changed = take_over(s->d, s->event.d, m->n_d);
    const bool b_changed = take_over(s->pre_b, s->event.b, m->n_b);
    const bool reinitialised = take_over(s->x, s->event.x, m->n_x);
    note_terminations(s);
    *x_changed = *x_changed || reinitialised;
    *changed = *changed || d_changed || b_changed || reinitialised;
    if (d_changed || reinitialised) changed_discrete(s);
    return STATUS_OK;
}

/* Passes until one of them changes nothing. `happened` tells whether anything changed at all. */
static Status iterate(Instance *s, bool *happened, bool *x_changed) {
    for (int count = 0; count < MAX_PASSES; count++) {
        bool changed = false;
        const Status status = pass(s, &changed, x_changed);
        if (status != STATUS_OK) return status;
        if (!changed) {
            copy(s->pre_d, s->d, s->model->n_d);
            return STATUS_OK;
        }
        *happened = true;
    }
    log_message(s, LOG_ERROR, "The events at time %.16g s do not come to rest within %d passes.", *s->t, MAX_PASSES);
    return STATUS_ERROR;
}

/* when-conditions with all flags off, so that each clock has an edge at its next tick. */
static Status settle_conditions(Instance *s) {
    memset(s->e, 0, (2 + s->model->n_s) * sizeof *s->e);
    if (s->model->n_b == 0) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {NULL, s->event.b, NULL, NULL};
    if (call_model(s, s->model->update, res) != STATUS_OK) return STATUS_DISCARD;
    memcpy(s->pre_b, s->event.b, s->model->n_b * sizeof *s->pre_b);
    return STATUS_OK;
}

static Status iterate_with_flag(Instance *s, size_t flag) {
    bool happened = false, x_changed = false;
    Status status = settle_conditions(s);
    s->e[flag] = 1.0;
    if (status == STATUS_OK) status = iterate(s, &happened, &x_changed);
    const Status settled = settle_conditions(s);
    return status != STATUS_OK ? status : settled;
}

Status events_initial(Instance *s) { return s->model->update ? iterate_with_flag(s, 0) : STATUS_OK; }
Status events_terminal(Instance *s) { return s->model->update ? iterate_with_flag(s, 1) : STATUS_OK; }

static Status happen(Instance *s, bool *happened, bool *x_changed) {
    bool ticks = false;
    Status status = time_events_tick(s, &ticks);
    if (status == STATUS_OK) status = iterate(s, happened, x_changed);
    if (status == STATUS_OK && ticks) status = settle_conditions(s);
    return status;
}

Status events_update(Instance *s, EventResult *result) {
    *result = (EventResult){false, false, INFINITY};
    if (delay_pass_breaks(s, time_slack(s))) changed_point(s);
    bool happened = false;
    Status status = happen(s, &happened, &result->x_changed);
    if (status == STATUS_OK) status = evaluate_history(s, happened);
    if (status != STATUS_OK) return status;
    s->memory->last_event_time = *s->t;
    s->memory->is_disturbed = 0;
    result->terminate = s->memory->is_terminated;
    status = time_events_next(s, &result->next_time);
    s->memory->next_event_time = result->next_time;
    if (happened) log_message(s, LOG_EVENTS, "Event at time %.16g s.", *s->t);
    return status == STATUS_OK ? events_check(s) : status;
}

Status events_check(Instance *s) {
    if (s->model->n_checks == 0) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {s->event.checks};
    if (call_model(s, s->model->check, res) != STATUS_OK) return STATUS_DISCARD;
    Status status = STATUS_OK;
    for (size_t k = 0; k < s->model->n_checks; k++) {
        const ModelCheck *check = &s->model->checks[k];
        const bool failed = !(s->event.checks[k] > 0.5);
        const bool is_new = failed && !(s->warned[k] > 0.5);
        s->warned[k] = failed ? 1.0 : 0.0;
        if (failed && !check->is_warning) {
            log_message(s, LOG_ERROR, "Assertion failed at time %.16g s: %s", *s->t, check->message);
            return STATUS_ERROR;
        }
        if (!is_new) continue;
        log_message(s, LOG_WARNING, "Assertion failed at time %.16g s: %s", *s->t, check->message);
        status = STATUS_WARNING;
    }
    return status;
}
