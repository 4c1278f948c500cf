/* In g(x, q) = 0 rounding of the states moves q by d = g_q^-1 r. Where that changes g_q by as much as it is, there may be
   two solutions near, or none (L. V. Kantorovich): no digit of q is known, whatever the residual. Elsewhere the change is
   of the order of the rounding itself, so nothing depends on units, nor on a tolerance. */
#include "constraints.h"

#include <float.h>
#include <math.h>

#include "evaluate.h"
#include "linear.h"
#include "vector.h"

/* What rounding of the states does to the constraints (n_q); zero for other equations. */
static void rounding(const Instance *s, const double *dg_dx, double *result) {
    const size_t n = s->model->n_q;
    for (size_t k = 0; k < n; k++) {
        result[k] = 0.0;
        for (size_t j = 0; s->model->constrained[k] && j < s->model->n_x; j++)
            result[k] += DBL_EPSILON * fabs(dg_dx[j * n + k] * s->x[j]);
    }
}

/* g_q at q + step, in newton.jacobian. */
static Status jacobian_beside(Instance *s, const double *step) {
    const size_t n = s->model->n_q;
    double *res[] = {NULL, s->newton.jacobian};
    copy(s->newton.previous, s->q, n);
    for (size_t k = 0; k < n; k++) s->q[k] += step[k];
    const Status status = call_model(s, s->model->residual, res);
    copy(s->q, s->newton.previous, n);
    return status;
}

/* The first constraint whose g_q, over the step, is not what it was when g_q step = expected; n_q if there is none. */
static size_t first_lost(const Instance *s, const double *step, const double *expected) {
    const size_t n = s->model->n_q;
    for (size_t k = 0; k < n; k++) {
        double sum = 0.0, size = 0.0;
        for (size_t j = 0; j < n; j++) {
            const double term = s->newton.jacobian[j * n + k] * step[j];
            sum += term;
            size += fabs(term);
        }
        if (s->model->constrained[k] && fabs(sum - expected[k]) > 0.5 * size) return k;
    }
    return n;
}

Status constraints_check(Instance *s) {
    const size_t n = s->model->n_q;
    NewtonWork *w = &s->newton;
    double *by_states[] = {NULL, NULL, s->jacobian.qx, NULL, NULL}, *by_unknowns[] = {NULL, w->jacobian};
    if (!s->model->constrained) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    if (call_model(s, s->model->jacobian, by_states) != STATUS_OK) return STATUS_DISCARD;
    if (call_model(s, s->model->residual, by_unknowns) != STATUS_OK) return STATUS_DISCARD;
    if (lu_factor(n, w->jacobian, w->pivot) < n) return STATUS_OK; /* the next solution will say so */
    rounding(s, s->jacobian.qx, w->residual);
    copy(w->step, w->residual, n);
    lu_solve(n, w->jacobian, w->pivot, w->step);
    if (jacobian_beside(s, w->step) != STATUS_OK) return STATUS_DISCARD;
    const size_t lost = first_lost(s, w->step, w->residual);
    if (lost == n) return STATUS_OK;
    log_message(s, LOG_DISCARD, "At time %.16g s the states no longer determine %s = %.3g; choose others by stateSelect.",
                *s->t, s->model->unknowns ? s->model->unknowns[lost] : "(unnamed)", s->q[lost]);
    return STATUS_DISCARD;
}
