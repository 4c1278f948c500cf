/* Explicit Runge-Kutta steps, and what all families share: sums of stages, and the interpolant. */
#include "kernel.h"

void combine(Job *job, const double *weights, int64_t count, double scale, double *result) {
    const Work *w = &job->work;
    w->sums->add_rows(w->x, w->k, weights, count, scale, result, w->n);
}

void estimate(Job *job, int64_t count, double scale) {
    const Work *w = &job->work;
    fill(w->error, 0.0, w->n);
    w->sums->add_rows(w->error, w->k, job->method.error, count, scale, w->error, w->n);
}

int attempt_explicit(Job *job, double h, double *error) {
    const Method *method = &job->method;
    Work *w = &job->work;
    const double t = job->run.t;
    const int64_t n = w->n, stages = method->stages;
    *error = NAN;
    copy(w->k, w->dx, n);
    for (int64_t i = 1; i < stages; i++) {
        combine(job, method->a + stages * i, i, h, w->x_try);
        const int status = evaluate(job, t + method->c[i] * h, w->x_try, w->k + n * i);
        if (status > WARNING) return status;
    }
    combine(job, method->b, stages, h, w->x_new);
    if (job->control.step > 0.0) return *error = 0.0, OK;
    if (method->end_in_error) {
        const int status = evaluate(job, t + h, w->x_new, w->dx_new);
        if (status > WARNING) return status;
    }
    estimate(job, stages + method->end_in_error, h);
    *error = error_norm(job, w->error, w->x, w->x_new);
    return OK;
}

void dense_coefficients(Job *job, double h) {
    const Method *method = &job->method;
    const Work *w = &job->work;
    const int64_t n = w->n, terms = method->terms;
    const double scale = method->family == ROSENBROCK ? 1.0 : h;
    fill(w->dense, 0.0, terms * n);
    for (int64_t i = 0; i <= method->stages; i++)
        for (int64_t p = 0; p < terms; p++) {
            const double weight = scale * method->dense[i * terms + p];
            if (weight == 0.0) continue;
            for (int64_t j = 0; j < n; j++) w->dense[p * n + j] += weight * w->k[i * n + j];
        }
}

void interpolate(Job *job, double theta) {
    const Work *w = &job->work;
    for (int64_t j = 0; j < w->n; j++) {
        double y = 0.0;
        for (int64_t p = job->method.terms - 1; p >= 0; p--) y = w->dense[p * w->n + j] + theta * y;
        w->x_try[j] = w->x[j] + theta * y;
    }
}
