/* Signals at a time, as pysim.types.Signal defines them. */
#include "kernel.h"

static double value_of(const Inputs *inputs, int64_t k, double s) {
    const double *c = inputs->cubics + 4 * k;
    double y = c[0] + s * (c[1] + s * (c[2] + s * c[3]));
    for (int64_t j = inputs->waves[k]; j < inputs->waves[k + 1]; j++) {
        const double *w = inputs->sines + 4 * j;
        y += w[0] * sin(w[1] + (w[2] + 0.5 * w[3] * s) * s);
    }
    return y;
}

static double rate_of(const Inputs *inputs, int64_t k, double s) {
    const double *c = inputs->cubics + 4 * k;
    double y = c[1] + s * (2.0 * c[2] + 3.0 * s * c[3]);
    for (int64_t j = inputs->waves[k]; j < inputs->waves[k + 1]; j++) {
        const double *w = inputs->sines + 4 * j;
        y += w[0] * (w[2] + w[3] * s) * cos(w[1] + (w[2] + 0.5 * w[3] * s) * s);
    }
    return y;
}

/* Piece of input i at time t. One that starts at the horizon is not yet in force when t reaches it. */
static int64_t find_piece(const Inputs *inputs, int64_t i, double t, double horizon) {
    const double *starts = inputs->starts;
    const int64_t first = inputs->pieces[i], last = inputs->pieces[i + 1] - 1;
    int64_t k = inputs->cursor[i];
    while (k < last && starts[k + 1] <= t && starts[k + 1] < horizon) k++;
    while (k > first && starts[k] > t) k--;
    return inputs->cursor[i] = k;
}

int set_inputs(Job *job, double t) {
    const Inputs *inputs = &job->inputs;
    if (inputs->count == 0 || t == job->run.inputs_at) return OK; /* several stages of a step look at one moment */
    for (int64_t i = 0; i < inputs->count; i++) {
        const int64_t k = find_piece(inputs, i, t, job->run.horizon);
        const double s = t - inputs->starts[k];
        if (inputs->rate[i]) inputs->values[i] = s >= 0.0 ? rate_of(inputs, k, s) : 0.0;
        else inputs->values[i] = value_of(inputs, k, larger(s, 0.0));
    }
    const int status = fmi_set_reals(job->fmu, inputs->references, inputs->values, inputs->count);
    job->run.inputs_at = status <= WARNING ? t : NAN;
    return status;
}
