/* Derivatives of dx by the states at any point: exact where the FMU offers them, else by differences. */
#include "kernel.h"

static const double root_eps = 1.4901161193847656e-08;
static const double small = 1e-3; /* of a nominal value: a state below it is moved as if it were that large */

/* Those entries that may differ from zero, into the matrix, at the point last set. */
int take_partials(const Job *job, const Partials *p, double *matrix) {
    int status = OK;
    for (int64_t g = 0; g < p->groups; g++) {
        const int64_t first = p->first_entry[g], size = p->first_entry[g + 1] - first, known = p->first_known[g];
        if (size == 0) continue;
        status = worse(status, fmi_get_directional(job->fmu, p->unknowns + first, size, p->knowns + known,
                                                   p->first_known[g + 1] - known, p->ones, p->column));
        if (status > WARNING) return status;
        for (int64_t i = 0; i < size; i++) matrix[p->places[first + i]] = p->column[i];
    }
    return status;
}

/* One-sided differences, each state moved by the root of the rounding error. They start from the model's own derivative
   at x: that of an implicit stage is off by what Newton left of it, which the small steps would enlarge to the size of
   the Jacobian. */
static int by_differences(Job *job, double t, const double *x) {
    Work *w = &job->work;
    const int64_t n = w->n;
    double *moved = w->slope, *rate = w->error;
    copy(moved, x, n);
    int status = evaluate(job, t, moved, rate);
    for (int64_t j = 0; j < n && status <= WARNING; j++) {
        const double before = moved[j];
        double *column = w->jacobian + n * j;
        moved[j] = before + root_eps * larger(fabs(before), small * w->nominal[j]);
        status = worse(status, evaluate(job, t, moved, column));
        for (int64_t i = 0; i < n; i++) column[i] = (column[i] - rate[i]) / (moved[j] - before);
        moved[j] = before;
    }
    return status;
}

/* Jacobian and, where wanted, F at the point last set, from the matrices that an FMU of ours keeps. */
static int take_matrices(Job *job, bool with_forcing) {
    Work *w = &job->work;
    Variation *v = &job->variation;
    const double *by_states = NULL, *by_parameters = NULL;
    const int status = fmi_get_matrices(job->fmu, &by_states, with_forcing ? &by_parameters : NULL);
    if (status > WARNING) return status;
    copy(w->jacobian, by_states, w->n * w->n);
    for (int64_t p = 0; with_forcing && p < v->parameters; p++)
        if (v->columns_of[p] >= 0) copy(v->forcing + w->n * p, by_parameters + w->n * v->columns_of[p], w->n);
    return status;
}

int take_jacobian(Job *job, double t, const double *x) {
    job->run.jacobians++;
    if (!job->work.has_directional) return by_differences(job, t, x);
    const int status = set_point(job, t, x);
    if (status > WARNING) return status;
    if (job->fmu->get_matrices) return worse(status, take_matrices(job, false));
    return worse(status, take_partials(job, job->work.by_states, job->work.jacobian));
}

int take_jacobian_and_forcing(Job *job, double t, const double *x) {
    Variation *v = &job->variation;
    if (job->fmu->get_matrices && v->columns_of && job->work.has_directional) {
        job->run.jacobians++;
        const int status = set_point(job, t, x);
        return status > WARNING ? status : worse(status, take_matrices(job, true));
    }
    const int status = take_jacobian(job, t, x);
    return status > WARNING ? status : worse(status, take_partials(job, v->by_parameters, v->forcing));
}
