#include "linearise.h"

#include "evaluate.h"
#include "linear.h"

Status factor_blocks(Instance *s) {
    JacobianWork *w = &s->jacobian;
    double *res[] = {NULL, w->qq};
    if (s->model->n_q == 0) return STATUS_OK;
    if (call_model(s, s->model->residual, res) == STATUS_OK &&
        lu_factor(s->model->n_q, w->qq, w->pivot) == s->model->n_q)
        return STATUS_OK;
    log_message(s, LOG_DISCARD, "The non-linear equations are singular at time %.16g s.", *s->t);
    return STATUS_DISCARD;
}

/* y -= M * column, with M of n_x rows and n_q columns. */
static void subtract_product(size_t n_x, size_t n_q, const double *matrix, const double *column, double *y) {
    for (size_t j = 0; j < n_q; j++)
        for (size_t i = 0; i < n_x; i++) y[i] -= matrix[j * n_x + i] * column[j];
}

void let_blocks_follow(const Instance *s, double *rate, double *dg_dt) {
    const size_t n_x = s->model->n_x, n_q = s->model->n_q;
    const JacobianWork *w = &s->jacobian;
    lu_solve(n_q, w->qq, w->pivot, dg_dt);
    subtract_product(n_x, n_q, w->xq, dg_dt, rate);
}

Status linearise(Instance *s, double *rate, double *dg_dt) {
    const size_t n_x = s->model->n_x, n_q = s->model->n_q;
    JacobianWork *w = &s->jacobian;
    double *res[] = {w->xx, w->xq, w->qx, rate, dg_dt, NULL};
    clear_computed(s, HAS_JACOBIAN);
    if (call_model(s, s->model->jacobian, res) != STATUS_OK) return STATUS_DISCARD;
    if (factor_blocks(s) != STATUS_OK) return STATUS_DISCARD;
    for (size_t j = 0; j < n_x; j++) let_blocks_follow(s, w->xx + j * n_x, w->qx + j * n_q);
    set_computed(s, HAS_JACOBIAN);
    return STATUS_OK;
}

Status evaluate_jacobian(Instance *s) {
    if (is_computed(s, HAS_JACOBIAN)) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    return linearise(s, NULL, NULL);
}

bool has_by_parameters(const Model *m) { return m->n_q == 0 && m->n_x > 0 && m->n_p > 0; }

/* Those matrices that are asked for and not there yet; no blocks follow, since there are none. */
static Status bring_up_to_date(Instance *s, bool by_states, bool by_parameters) {
    const bool states = by_states && !is_computed(s, HAS_JACOBIAN);
    const bool parameters = by_parameters && !is_computed(s, HAS_BY_PARAMETERS);
    double *res[] = {states ? s->jacobian.xx : NULL, NULL, NULL, NULL, NULL, parameters ? s->jacobian.xp : NULL};
    if (!states && !parameters) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    if (call_model(s, s->model->jacobian, res) != STATUS_OK) return STATUS_DISCARD;
    if (states) set_computed(s, HAS_JACOBIAN);
    if (parameters) set_computed(s, HAS_BY_PARAMETERS);
    return STATUS_OK;
}

Status evaluate_by_parameters(Instance *s) { return bring_up_to_date(s, false, true); }

Status evaluate_matrices(Instance *s) { return bring_up_to_date(s, true, true); }
