/* The model as a function: derivatives at a point, and how large an error in them is. */
#include "kernel.h"

int set_point(Job *job, double t, const double *x) {
    int status = fmi_set_time(job->fmu, t);
    status = worse(status, fmi_set_states(job->fmu, x, job->work.n));
    return worse(status, set_inputs(job, t));
}

int evaluate(Job *job, double t, const double *x, double *dx) {
    job->run.derivatives++;
    const int status = set_point(job, t, x);
    return status > WARNING ? status : worse(status, fmi_get_derivatives(job->fmu, dx, job->work.n));
}

double error_norm(const Job *job, const double *values, const double *x, const double *y) {
    const double rtol = job->control.rtol, atol = job->control.atol, *nominal = job->work.nominal;
    const int64_t n = job->work.n;
    double total = 0.0;
    for (int64_t i = 0; i < n; i++) {
        const double ratio = values[i] / (atol * nominal[i] + rtol * larger(fabs(x[i]), fabs(y[i])));
        total += ratio * ratio;
    }
    return sqrt(total / (double)(n > 0 ? n : 1));
}
