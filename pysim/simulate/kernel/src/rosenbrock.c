/* Rosenbrock steps: linearly implicit, for stiff models (Hairer, Wanner II, IV.7, in the form without products by J). */
#include "kernel.h"

static const double slope_step = 1e-6; /* of the step: between curvature and rounding, which a stiff model enlarges */

/* Partial derivative of dx by time, the inputs' motion included, by a forward difference. */
static int time_slope(Job *job, double h) {
    Work *w = &job->work;
    const double t = job->run.t, later = t + slope_step * h;
    const int status = evaluate(job, later, w->x, w->slope);
    for (int64_t i = 0; i < w->n; i++) w->slope[i] = later > t ? (w->slope[i] - w->dx[i]) / (later - t) : 0.0;
    return status;
}

/* Jacobian and slope at run.t; they serve every attempt from there. */
static int linearise(Job *job, double h) {
    int status = take_jacobian(job, job->run.t, job->work.x);
    if (status <= WARNING) status = time_slope(job, h);
    if (status <= WARNING) job->run.jacobian_at = job->run.t;
    return status;
}

/* Stage i into row i of k. */
static int stage(Job *job, int64_t i, double h) {
    const Method *method = &job->method;
    Work *w = &job->work;
    const int64_t n = w->n;
    double *row = w->k + n * i;
    int status = OK;
    if (i == 0) {
        copy(row, w->dx, n);
    } else {
        combine(job, method->a + method->stages * i, i, 1.0, w->x_try);
        status = evaluate(job, job->run.t + method->c[i] * h, w->x_try, row);
    }
    w->sums->add_rows(row, w->k, method->coupling + method->stages * i, i, 1.0 / h, row, n);
    const double weight = h * method->slope[i];
    if (weight != 0.0)
        for (int64_t r = 0; r < n; r++) row[r] += weight * w->slope[r];
    solve_shifted(job, row);
    return status;
}

int attempt_rosenbrock(Job *job, double h, double *error) {
    const Method *method = &job->method;
    Work *w = &job->work;
    int status = OK;
    *error = NAN;
    if (job->run.jacobian_at != job->run.t) status = linearise(job, h);
    if (status > WARNING || !factorise_shifted(job, 1.0 / (h * method->gamma))) return status;
    for (int64_t i = 0; i < method->stages; i++) {
        status = stage(job, i, h);
        if (status > WARNING) return status;
    }
    combine(job, method->b, method->stages, 1.0, w->x_new);
    estimate(job, method->stages, 1.0);
    *error = error_norm(job, w->error, w->x, w->x_new);
    return OK;
}
