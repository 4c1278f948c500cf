/* Newton's method with the affine-invariant step control of P. Deuflhard, Newton Methods for Nonlinear Problems,
   Springer 2004, Section 3.3: a step is good if the simplified correction, which is one solve with the old
   factors, is smaller than the correction before. That measure does not depend on how residuals are scaled. */
#include "newton.h"

#include <math.h>
#include <string.h>

#include "linear.h"

enum { MAX_ITERATIONS = 100 };
static const double SMALLEST_DAMPING = 1e-4, CAREFUL_DAMPING = 1.0 / 16.0;

/* Size of a correction that is small: relative to its unknown, to the largest unknown, and in itself (an unknown
   that is zero has no other scale; a flow of 1e-6 m3/s still has ten digits). */
typedef struct {
    double relative, of_largest, absolute;
} Accuracy;

static const Accuracy CONVERGED = {1e-10, 1e-15, 1e-16}; /* the next correction would be of its square */
static const Accuracy ROUNDING = {1e-7, 1e-12, 1e-12};   /* enough if corrections no longer shrink */

static double largest(size_t n, const double *values) {
    double result = 0.0;
    for (size_t k = 0; k < n; k++) result = fmax(result, fabs(values[k]));
    return result;
}

/* Largest correction in units of what `accuracy` allows; NaN if one is. */
static double scaled_norm(size_t n, const double *step, const double *unknowns, const Accuracy *accuracy) {
    const double floor = accuracy->of_largest * largest(n, unknowns) + accuracy->absolute;
    double norm = 0.0;
    for (size_t k = 0; k < n; k++) {
        const double ratio = fabs(step[k]) / (accuracy->relative * fabs(unknowns[k]) + floor);
        if (isnan(ratio)) return ratio;
        norm = fmax(norm, ratio);
    }
    return norm;
}

static void move(double *unknowns, const double *from, const double *step, double factor, size_t n) {
    for (size_t k = 0; k < n; k++) unknowns[k] = from[k] - factor * step[k];
}

typedef enum { FAILED, STEPPED, SOLVED } Progress;

/* One damped step along work->step, whose size in units of CONVERGED is `before`. `damping` is the first factor tried;
   on return that for the next step: a step that did what the linear model promised lets it grow. */
static Progress damped_step(Instance *s, NewtonSystem *system, double *unknowns, size_t n, double before,
                            double *damping) {
    NewtonWork *work = &s->newton;
    memcpy(work->previous, unknowns, n * sizeof *unknowns);
    const bool tiny = scaled_norm(n, work->step, unknowns, &ROUNDING) <= 1.0;
    for (double factor = tiny ? 1.0 : *damping; factor >= SMALLEST_DAMPING; factor *= 0.5) {
        move(unknowns, work->previous, work->step, factor, n);
        if (system(s, work->residual, NULL) != STATUS_OK) continue;
        lu_solve(n, work->jacobian, work->pivot, work->residual); /* now the simplified correction */
        const double after = scaled_norm(n, work->residual, work->previous, &CONVERGED);
        if (after <= 1.0) {
            move(unknowns, unknowns, work->residual, 1.0, n);
            return SOLVED;
        }
        if (after <= (1.0 - 0.25 * factor) * before) {
            *damping = after <= (1.0 - 0.75 * factor) * before ? fmin(1.0, 2.0 * factor) : factor;
            return STEPPED;
        }
        if (tiny && isfinite(after)) return SOLVED;
    }
    return FAILED;
}

static Status fail(Instance *s, const char *objection, size_t culprit, double value) {
    s->newton.objection = objection;
    s->newton.culprit = culprit;
    s->newton.value = value;
    return STATUS_DISCARD;
}

/* No step: the residuals come block by block as the unknowns do, so one without a value tells whose it is. */
static Status fail_at_point(Instance *s, const double *unknowns, size_t n, size_t column) {
    for (size_t k = 0; k < n; k++)
        if (!isfinite(s->newton.residual[k])) return fail(s, "have no value", k, unknowns[k]);
    return fail(s, "are singular", column, unknowns[column]);
}

/* No good step: the unknown that is farthest from a solution. */
static Status fail_to_converge(Instance *s, const double *unknowns, size_t n) {
    size_t worst = 0;
    double most = 0.0;
    for (size_t k = 0; k < n; k++) {
        const double size = scaled_norm(1, s->newton.step + k, unknowns + k, &CONVERGED);
        if (size > most) most = size, worst = k;
    }
    return fail(s, "lead nowhere", worst, unknowns[worst]);
}

static Status attempt(Instance *s, NewtonSystem *system, double *unknowns, size_t n, double damping) {
    NewtonWork *work = &s->newton;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        if (system(s, work->residual, work->jacobian) != STATUS_OK) return fail(s, "have no value", 0, unknowns[0]);
        const size_t factored = lu_factor(n, work->jacobian, work->pivot);
        if (factored < n) return fail_at_point(s, unknowns, n, factored);
        memcpy(work->step, work->residual, n * sizeof *work->step);
        lu_solve(n, work->jacobian, work->pivot, work->step);
        const double size = scaled_norm(n, work->step, unknowns, &CONVERGED);
        if (!isfinite(size)) return fail_at_point(s, unknowns, n, 0);
        if (size <= 1.0) {
            move(unknowns, unknowns, work->step, 1.0, n);
            return STATUS_OK;
        }
        const Progress progress = damped_step(s, system, unknowns, n, size, &damping);
        if (progress == SOLVED) return STATUS_OK;
        if (progress == FAILED) return fail_to_converge(s, work->previous, n);
    }
    return fail_to_converge(s, unknowns, n);
}

Status newton_solve(Instance *s, NewtonSystem *system, double *unknowns, size_t n) {
    double *start = s->newton.start;
    memcpy(start, unknowns, n * sizeof *unknowns);
    if (attempt(s, system, unknowns, n, 1.0) == STATUS_OK) return STATUS_OK;
    /* Short steps follow the path on which all residuals shrink together; long ones may jump off it over a fold. */
    memcpy(unknowns, start, n * sizeof *unknowns);
    if (attempt(s, system, unknowns, n, CAREFUL_DAMPING) == STATUS_OK) return STATUS_OK;
    memcpy(unknowns, start, n * sizeof *unknowns);
    return STATUS_DISCARD;
}

void newton_report(Instance *s, LogCategory category, const char *equations, const char *const *names) {
    const NewtonWork *work = &s->newton;
    const char *name = names ? names[work->culprit] : "(unnamed)";
    log_message(s, category,
                "No solution found at time %.16g s: %s %s at %s = %.16g; if there is one, give %s another start value.",
                *s->t, equations, work->objection, name, work->value, name);
}
