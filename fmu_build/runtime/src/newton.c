/* Newton's method with the affine-invariant step control of P. Deuflhard, Newton Methods for Nonlinear Problems,
   Springer 2004, Section 3.3: a step is good if the simplified correction, which is one solve with the old
   factors, is smaller than the correction before. That measure does not depend on how residuals are scaled. */
#include "newton.h"

#include <math.h>
#include <string.h>

#include "linear.h"

enum { MAX_ITERATIONS = 50 };
static const double SMALLEST_DAMPING = 1e-4;

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

/* One damped step along work->step, whose size in units of CONVERGED is `before`. */
static Progress damped_step(Instance *s, NewtonSystem *system, double *unknowns, size_t n, double before) {
    NewtonWork *work = &s->newton;
    memcpy(work->previous, unknowns, n * sizeof *unknowns);
    const bool tiny = scaled_norm(n, work->step, unknowns, &ROUNDING) <= 1.0;
    for (double damping = 1.0; damping >= SMALLEST_DAMPING; damping *= 0.5) {
        move(unknowns, work->previous, work->step, damping, n);
        if (system(s, work->residual, NULL) != STATUS_OK) continue;
        lu_solve(n, work->jacobian, work->pivot, work->residual); /* now the simplified correction */
        const double after = scaled_norm(n, work->residual, work->previous, &CONVERGED);
        if (after <= 1.0) {
            move(unknowns, unknowns, work->residual, 1.0, n);
            return SOLVED;
        }
        if (after <= (1.0 - 0.25 * damping) * before) return STEPPED;
        if (tiny && isfinite(after)) return SOLVED;
    }
    memcpy(unknowns, work->previous, n * sizeof *unknowns);
    return FAILED;
}

Status newton_solve(Instance *s, NewtonSystem *system, double *unknowns, size_t n) {
    NewtonWork *work = &s->newton;
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        if (system(s, work->residual, work->jacobian) != STATUS_OK) return STATUS_DISCARD;
        if (!lu_factor(n, work->jacobian, work->pivot)) return STATUS_DISCARD;
        memcpy(work->step, work->residual, n * sizeof *work->step);
        lu_solve(n, work->jacobian, work->pivot, work->step);
        const double size = scaled_norm(n, work->step, unknowns, &CONVERGED);
        if (!isfinite(size)) return STATUS_DISCARD;
        if (size <= 1.0) {
            move(unknowns, unknowns, work->step, 1.0, n);
            return STATUS_OK;
        }
        switch (damped_step(s, system, unknowns, n, size)) {
            case SOLVED: return STATUS_OK;
            case FAILED: return STATUS_DISCARD;
            case STEPPED: break;
        }
    }
    return STATUS_DISCARD;
}
