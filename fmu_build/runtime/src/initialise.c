#include "initialise.h"

#include <math.h>

#include "delay.h"
#include "evaluate.h"
#include "events.h"
#include "newton.h"
#include "relations.h"
#include "vector.h"

enum { MAX_PASSES = 100 };
static const double SAME_DELAYED_VALUE = 1e-12; /* relative; delays of delays settle one after the other */

/* Nothing of an earlier solution may show in this one. */
static void forget(Instance *s) {
    const Model *m = s->model;
    s->memory->computed = 0;
    s->memory->is_terminated = 0;
    s->memory->last_event_time = *s->t - 3.0 * time_slack(s); /* a clock may tick at the start */
    copy(s->x, s->user_x, m->n_x);
    copy(s->d, s->user_d, m->n_d);
    copy(s->pre_d, s->user_d, m->n_d);
    clear(s->r, m->n_r);
    clear(s->v, m->n_v);
    clear(s->i, m->n_i);
    clear(s->e, 2 + m->n_s);
    clear(s->pre_b, m->n_b);
    clear(s->z_scale, m->n_r);
    for (size_t k = 0; k < m->n_v; k++) s->delays[k].count = 0;
}

/* i from its first guess; the guess may use calculated parameters that do not depend on i. */
static Status guess(Instance *s) {
    if (s->model->n_i == 0) return STATUS_OK;
    if (evaluate_calculated(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {NULL, NULL, s->newton.previous};
    if (call_model(s, s->model->initial_residual, res) != STATUS_OK) return STATUS_DISCARD;
    copy(s->i, s->newton.previous, s->model->n_i);
    changed_parameters(s);
    return STATUS_OK;
}

static Status residual(Instance *s, double *g, double *jacobian) {
    changed_parameters(s);
    if (evaluate_calculated(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {g, jacobian, NULL};
    return call_model(s, s->model->initial_residual, res);
}

static Status solve_initial_equations(Instance *s) {
    if (s->model->n_i > 0 && newton_solve(s, residual, s->i, s->model->n_i) != STATUS_OK) {
        newton_report(s, LOG_ERROR, "the initial equations", s->model->initial_unknowns);
        return STATUS_ERROR;
    }
    changed_parameters(s);
    return evaluate_calculated(s);
}

/* x, d and the first guess of q; the model reads the user's values, so results go elsewhere first. */
static Status start_values(Instance *s, bool first) {
    const Model *m = s->model;
    copy(s->x, s->user_x, m->n_x);
    copy(s->d, s->user_d, m->n_d);
    changed_point(s);
    double *res[] = {s->event.x, s->event.d, first ? s->newton.previous : NULL};
    if (!m->start) return STATUS_OK;
    if (call_model(s, m->start, res) != STATUS_OK) return STATUS_DISCARD;
    copy(s->x, s->event.x, m->n_x);
    copy(s->d, s->event.d, m->n_d);
    copy(s->pre_d, s->event.d, m->n_d);
    if (first) copy(s->q, s->newton.previous, m->n_q);
    return STATUS_OK;
}

/* Delayed values before any time has passed: the delayed expressions themselves. */
static Status start_delays(Instance *s, bool *changed) {
    const size_t n = s->model->n_v;
    if (n == 0) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    copy(s->event.old_v, s->v, n);
    if (delay_start(s) != STATUS_OK) return STATUS_DISCARD;
    changed_point(s);
    for (size_t k = 0; k < n; k++) {
        const double difference = fabs(s->v[k] - s->event.old_v[k]);
        *changed = *changed || difference > SAME_DELAYED_VALUE * fabs(s->v[k]);
    }
    return STATUS_OK;
}

/* Relations choose among equations and follow from their solution: both are repeated until they agree. */
static Status settle(Instance *s) {
    for (int count = 0; count < MAX_PASSES; count++) {
        bool r_changed = false, v_changed = false;
        Status status = solve_initial_equations(s);
        if (status == STATUS_OK) status = start_values(s, count == 0);
        if (status == STATUS_OK) status = start_delays(s, &v_changed);
        if (status == STATUS_OK) status = relations_update(s, &r_changed);
        if (status != STATUS_OK || !(r_changed || v_changed)) return status;
    }
    log_message(s, LOG_ERROR, "The relations at the start do not come to rest within %d passes.", MAX_PASSES);
    return STATUS_ERROR;
}

Status initialise(Instance *s) {
    if (is_computed(s, HAS_START)) return STATUS_OK;
    forget(s);
    Status status = guess(s);
    if (status == STATUS_OK) status = settle(s);
    if (status == STATUS_OK) status = events_initial(s);
    if (status == STATUS_OK) status = evaluate_unknowns(s); /* later solutions are found from this one */
    if (status == STATUS_OK) set_computed(s, HAS_START);
    return status;
}
