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
    const Work *w = &job->work;
    const double sum = w->sums->weighted_square(values, w->nominal, x, y, job->control.atol, job->control.rtol, w->n);
    return sqrt(sum / (double)(w->n > 0 ? w->n : 1));
}
