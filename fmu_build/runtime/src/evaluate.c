#include "evaluate.h"

#include <math.h>
#include <string.h>

#include "delay.h"
#include "newton.h"

const char *variable_name(const Instance *s, Vector vector, size_t index) {
    for (size_t k = 0; k < s->model->n_variables; k++)
        if (s->model->variables[k].vector == vector && s->model->variables[k].index == index)
            return s->model->variables[k].name;
    return "(unnamed)";
}

/* False if any value is infinite or not a number; 0 * value is then NaN, so one comparison settles it. Four sums do
   not wait for each other. */
static bool all_finite(const double *values, size_t n) {
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    size_t k = 0;
    for (; k + 4 <= n; k += 4)
        for (size_t i = 0; i < 4; i++) sums[i] += 0.0 * values[k + i];
    for (; k < n; k++) sums[0] += 0.0 * values[k];
    return sums[0] + sums[1] + sums[2] + sums[3] == 0.0;
}

static Status report_failure(Instance *s, const char *what) {
    log_message(s, LOG_DISCARD, "%s cannot be evaluated at time %.16g s.", what, *s->t);
    return STATUS_DISCARD;
}

Status evaluate_calculated(Instance *s) {
    if (is_computed(s, HAS_C)) return STATUS_OK;
    double *res[] = {s->c};
    if (call_model(s, s->model->calculated, res) != STATUS_OK) return report_failure(s, "Calculated parameters");
    if (delay_times_update(s) != STATUS_OK) return STATUS_DISCARD;
    set_computed(s, HAS_C);
    return STATUS_OK;
}

static Status residual(Instance *s, double *g, double *jacobian) {
    double *res[] = {g, jacobian};
    return call_model(s, s->model->residual, res);
}

static Status solve_blocks(Instance *s) {
    if (s->model->n_q == 0) return STATUS_OK;
    if (newton_solve(s, residual, s->q, s->model->n_q) == STATUS_OK) return STATUS_OK;
    /* The last solution was no good start; the model's own guess, which `start` gives, may be better. */
    double *res[] = {NULL, NULL, s->q};
    if (call_model(s, s->model->start, res) == STATUS_OK &&
        newton_solve(s, residual, s->q, s->model->n_q) == STATUS_OK)
        return STATUS_OK;
    newton_report(s, LOG_DISCARD, "the non-linear equations", s->model->unknowns);
    return STATUS_DISCARD;
}

Status evaluate_unknowns(Instance *s) {
    if (is_computed(s, HAS_Q)) return STATUS_OK;
    if (evaluate_calculated(s) != STATUS_OK) return STATUS_DISCARD;
    if (!is_computed(s, HAS_V)) {
        const bool late = delay_values_update(s);
        if (late) {
            if (solve_blocks(s) != STATUS_OK) return STATUS_DISCARD;
            if (delay_values_complete(s) != STATUS_OK) return STATUS_DISCARD;
        }
        set_computed(s, HAS_V);
    }
    if (solve_blocks(s) != STATUS_OK) return STATUS_DISCARD;
    set_computed(s, HAS_Q);
    return STATUS_OK;
}

static Status report_derivative(Instance *s) {
    for (size_t k = 0; k < s->model->n_x; k++)
        if (!isfinite(s->dx[k])) {
            log_message(s, LOG_DISCARD, "The derivative %s of state %s = %.16g is %g at time %.16g s.",
                        variable_name(s, VECTOR_DX, k), variable_name(s, VECTOR_X, k), s->x[k], s->dx[k], *s->t);
            break;
        }
    return STATUS_DISCARD;
}

Status evaluate_derivatives(Instance *s) {
    if (is_computed(s, HAS_DX)) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {s->dx};
    if (call_model(s, s->model->derivatives, res) != STATUS_OK) return report_failure(s, "Derivatives");
    if (!all_finite(s->dx, s->model->n_x)) return report_derivative(s);
    set_computed(s, HAS_DX);
    return STATUS_OK;
}

Status evaluate_outputs(Instance *s) {
    if (is_computed(s, HAS_W)) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {s->w};
    if (call_model(s, s->model->outputs, res) != STATUS_OK) return report_failure(s, "Outputs");
    set_computed(s, HAS_W);
    return STATUS_OK;
}

Status evaluate_indicators(Instance *s) {
    if (is_computed(s, HAS_Z)) return STATUS_OK;
    if (evaluate_unknowns(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {s->z};
    if (call_model(s, s->model->indicators, res) != STATUS_OK) return report_failure(s, "Event indicators");
    set_computed(s, HAS_Z);
    return STATUS_OK;
}

Status evaluate_history(Instance *s, bool is_break) {
    if (s->model->n_v == 0) return STATUS_OK;
    return evaluate_unknowns(s) == STATUS_OK ? delay_record(s, is_break) : STATUS_DISCARD;
}
