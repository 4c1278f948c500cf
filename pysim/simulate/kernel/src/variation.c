/* What a small change of the start or of a parameter does: the derivative of every step, next to the step itself.

   S is d x / d (start states, parameters): one row per state, one column per direction. Each stage of an implicit step
   is an equation of its own, so its derivative solves the linear equation of that stage: with J = df/dx and F = df/dp
   there,

       (I - h gamma J) S_i = S + h sum_{j<i} a_ij K_j + h gamma F,    K_i = J S_i + F.

   The lengths of the steps are taken as they are (internal numerical differentiation, Bock 1981). */
#include "kernel.h"

/* Adds F to the columns of the parameters in target (n, c). */
static void add_forcing(const Job *job, double *target) {
    const Variation *v = &job->variation;
    for (int64_t e = 0; e < v->entries; e++) target[v->forcing_targets[e]] += v->forcing[v->by_parameters->places[e]];
}

/* K at run.t, where the derivatives jump: at the start and behind every break of an input. */
int begin_variation(Job *job) {
    Variation *v = &job->variation;
    Work *w = &job->work;
    const int64_t n = w->n, width = v->columns;
    const int status = take_jacobian_and_forcing(job, job->run.t, w->x);
    if (status > WARNING) return status;
    job->run.jacobian_at = job->run.t, job->run.matrix_step = 0.0;
    fill(v->k, 0.0, n * width);
    add_forcing(job, v->k);
    for (int64_t i = 0; i < n; i++)
        for (int64_t j = 0; j < n; j++) {
            const double entry = w->jacobian[j * n + i];
            if (entry != 0.0) w->sums->add_row(v->k + width * i, v->s + width * j, entry, width);
        }
    return status;
}

static int vary_stage(Job *job, int64_t i, double h) {
    Variation *v = &job->variation;
    const Method *method = &job->method;
    Work *w = &job->work;
    const int64_t size = w->n * v->columns;
    const double shift = 1.0 / (h * method->gamma);
    const int status = take_jacobian_and_forcing(job, job->run.t + method->c[i] * h, w->stages + w->n * i);
    if (status > WARNING) return status;
    if (!factorise_shifted(job, shift)) return ERROR;
    double *known = v->right, *solved = v->inside, *k = v->k + size * i;
    w->sums->add_rows_and_scale(v->s, v->k, method->a + method->stages * i, i, h, known, shift, solved, size);
    add_forcing(job, solved);
    solve_shifted_rows(job, solved, v->columns);
    w->sums->scale_difference(solved, known, shift, k, size);
    return status;
}

/* Fills k for the step just accepted, whose stages are still there. Jacobian and factors of the last stage stay, for
   they are those of the next step. */
int vary_step(Job *job, double h) {
    int status = OK;
    for (int64_t i = 1; i < job->method.stages; i++) {
        status = worse(status, vary_stage(job, i, h));
        if (status > WARNING) return status;
    }
    job->run.matrix_step = h;
    return status;
}

/* Largest error of a column of S in the step just taken, over what is tolerated; states weigh as in their own. */
double variation_error(Job *job, double h) {
    const Variation *v = &job->variation;
    const Control *control = &job->control;
    const Work *w = &job->work;
    const int64_t width = v->columns;
    double worst = 0.0;
    fill(v->error, 0.0, w->n * width);
    w->sums->add_rows(v->error, v->k, job->method.error, job->method.stages, h, v->error, w->n * width);
    for (int64_t c = 0; c < v->by_start + v->parameters; c++) {
        double wrong = 0.0, size = 0.0;
        for (int64_t i = 0; i < w->n; i++) {
            const double weight = 1.0 / (control->atol * w->nominal[i] + control->rtol * fabs(w->x_new[i]));
            const double e = weight * v->error[i * width + c], s = weight * v->inside[i * width + c];
            wrong += e * e;
            size += s * s;
        }
        v->sizes[c] = larger(v->sizes[c], sqrt(size));
        if (v->sizes[c] > 0.0) worst = larger(worst, sqrt(wrong) / v->sizes[c]);
    }
    return worst / v->tolerance;
}

/* Widens low and high to the states at run.t. */
void note_range(Job *job) {
    const Variation *v = &job->variation;
    for (int64_t i = 0; i < job->work.n; i++) {
        v->low[i] = smaller(v->low[i], job->work.x[i]);
        v->high[i] = larger(v->high[i], job->work.x[i]);
    }
}

/* What a start did fades for ever; processors take a hundred times as long over the smallest numbers that they know. */
static const double faded = 1e-200;

static void forget_faded(double *x, int64_t n) {
    for (int64_t i = 0; i < n; i++) x[i] = fabs(x[i]) < faded ? 0.0 : x[i];
}

/* Makes the end of the step the current point. */
void end_variation(Job *job) {
    Variation *v = &job->variation;
    const int64_t size = job->work.n * v->columns;
    double *last = v->inside; /* the last stage */
    v->inside = v->s, v->s = last;
    copy(v->k, v->k + size * (job->method.stages - 1), size);
    forget_faded(v->s, size);
    forget_faded(v->k, size);
    job->run.jacobian_at = job->run.t;
}

/* target (n, c) = S at the share theta of the step, by the interpolant of the step itself. */
void vary_inside(Job *job, double theta, double h, double *target) {
    const Variation *v = &job->variation;
    const Method *method = &job->method;
    for (int64_t i = 0; i < method->stages; i++) {
        double weight = 0.0;
        for (int64_t p = method->terms - 1; p >= 0; p--) weight = theta * (method->dense[i * method->terms + p] + weight);
        v->weights[i] = weight;
    }
    job->work.sums->add_rows(v->s, v->k, v->weights, method->stages, h, target, job->work.n * v->columns);
}

/* Derivatives of what is recorded, at the point last set with S in s (n, c), as that row. */
int record_variation(Job *job, int64_t row, const double *s) {
    const Variation *v = &job->variation;
    const int64_t n = job->work.n, width = v->columns, columns = job->rows.columns;
    double *place = v->rows + row * columns * width;
    for (int64_t y = 0; y < columns; y++)
        copy(place + width * y, v->kinds[y] >= 0 ? s + width * v->kinds[y] : v->fixed + width * y, width);
    const int status = take_partials(job, v->of_outputs, v->gradient);
    for (int64_t e = 0; e < v->slopes && status <= WARNING; e++) {
        const int64_t j = v->slope_columns[e];
        double *target = place + width * v->slope_rows[e];
        if (j >= n) target[v->by_start + j - n] += v->gradient[e];
        else if (v->gradient[e] != 0.0) job->work.sums->add_row(target, s + width * j, v->gradient[e], width);
    }
    return status;
}
