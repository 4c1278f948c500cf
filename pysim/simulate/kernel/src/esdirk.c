/* Diagonally implicit Runge-Kutta steps: Newton in each stage, with one Jacobian and one factorisation per step
   (Hairer, Wanner II, IV.8). */
#include "kernel.h"

enum { ITERATIONS = 10 };           /* of Newton in a stage; slower, a shorter step is cheaper */
static const double enough = 1e-2;  /* of the tolerated error of a step: what Newton may leave */
static const double slowest = 0.9;  /* ratio of two corrections above which Newton will not arrive */

/* Solves X = x + h sum_{j<i} a_ij k_j + h gamma f(t + c_i h, X) for row i of stages. The stage's derivative k_i follows
   from X and not from f, which would enlarge what Newton leaves of stiff parts. */
static int stage(Job *job, int64_t i, double h, bool *converged) {
    const Method *method = &job->method;
    Work *w = &job->work;
    const int64_t n = w->n;
    const double t = job->run.t + method->c[i] * h, reach = h * method->gamma, shift = 1.0 / reach;
    double *x = w->stages + n * i, *k = w->k + n * i, *right = w->right, *change = w->error;
    double before = 0.0;
    int status = OK;
    *converged = false;
    combine(job, method->a + method->stages * i, i, h, right);
    w->sums->add_rows(right, w->k, method->predict + method->stages * i, i, reach, x, n); /* where Newton starts */
    for (int count = 0; count < ITERATIONS; count++) {
        status = worse(status, evaluate(job, t, x, k));
        if (status > WARNING) return status;
        for (int64_t r = 0; r < n; r++) change[r] = (right[r] - x[r]) * shift + k[r];
        solve_shifted(job, change);
        for (int64_t r = 0; r < n; r++) x[r] += change[r];
        const double size = error_norm(job, change, w->x, x);
        if (!(size < 1e100)) return status;
        const double ratio = count > 0 && before > 0.0 ? size / before : 0.5;
        before = size;
        if (size <= 1e-3 * enough || (count > 0 && size * ratio <= (1.0 - ratio) * enough)) {
            for (int64_t r = 0; r < n; r++) k[r] = (x[r] - right[r]) * shift;
            *converged = true;
            return status;
        }
        if (count > 0 && ratio > slowest) return status;
    }
    return status;
}

/* Fills stages and dx_new as well. The norm is infinite where Newton does not converge. */
int attempt_esdirk(Job *job, double h, double *error) {
    Run *run = &job->run;
    const Method *method = &job->method;
    Work *w = &job->work;
    const int64_t n = w->n, last = n * (method->stages - 1);
    int status = OK;
    *error = NAN;
    if (run->jacobian_at != run->t) {
        status = take_jacobian(job, run->t, w->x);
        if (status > WARNING) return status;
        run->jacobian_at = run->t, run->matrix_step = 0.0;
    }
    if (run->matrix_step != h && !factorise_shifted(job, 1.0 / (h * method->gamma))) {
        run->matrix_step = 0.0;
        return status;
    }
    run->matrix_step = h;
    copy(w->k, w->dx, n);
    copy(w->stages, w->x, n);
    for (int64_t i = 1; i < method->stages; i++) {
        bool converged = false;
        status = worse(status, stage(job, i, h, &converged));
        if (status > WARNING) return status;
        if (!converged) return *error = INFINITY, status;
    }
    copy(w->x_new, w->stages + last, n);
    copy(w->dx_new, w->k + last, n);
    estimate(job, method->stages, h);
    *error = error_norm(job, w->error, w->x, w->x_new);
    return status;
}
