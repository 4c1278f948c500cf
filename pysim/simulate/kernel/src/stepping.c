/* How long the next step is, and attempts until one is accepted. */
#include "kernel.h"

static const double safety = 0.9, shrink = 0.2, grow = 5.0, failed = 0.25;
static const double grid_width = 1e-9; /* of a fixed step: nearer than that, two points are one */

double next_time_event(const Job *job) {
    return job->run.next_event < job->run.leaves ? job->run.next_event : INFINITY;
}

/* From the size of x, of dx, and of what an Euler step changes (Hairer, Norsett, Wanner I, II.4). */
double first_step(Job *job) {
    const Run *run = &job->run;
    Work *w = &job->work;
    const double span = smaller(smaller(run->horizon, next_time_event(job)) - run->t, job->control.max_step);
    const double size = error_norm(job, w->x, w->x, w->x), rate = error_norm(job, w->dx, w->x, w->x);
    const double h = smaller(smaller(size, rate) > 1e-5 ? 0.01 * size / rate : 1e-6 * span, span);
    for (int64_t i = 0; i < w->n; i++) w->x_try[i] = w->x[i] + h * w->dx[i];
    const int status = evaluate(job, run->t + h, w->x_try, w->error);
    if (status > WARNING || !all_finite(w->error, w->n)) return 0.01 * h;
    for (int64_t i = 0; i < w->n; i++) w->error[i] = (w->error[i] - w->dx[i]) / h;
    const double largest = larger(rate, error_norm(job, w->error, w->x, w->x));
    const double reach = largest > 1e-15 ? pow(0.01 / largest, 1.0 / job->method.error_order) : 1e-3 * span;
    return smaller(smaller(100.0 * h, reach), span);
}

/* A break, a time event, or the next point of a fixed grid. */
double next_target(Job *job) {
    Run *run = &job->run;
    const double step = job->control.step, target = smaller(run->horizon, next_time_event(job));
    if (step == 0.0) return target;
    while (run->start + (double)(run->grid + 1) * step <= run->t + grid_width * step) run->grid++;
    const double grid = run->start + (double)(run->grid + 1) * step;
    return grid + grid_width * step < target ? grid : target;
}

/* Length of the next step and the time of its end; no sliver is left for the step after. */
static void limit(const Job *job, double target, double *h, double *t_new) {
    const Run *run = &job->run;
    const double left = target - run->t;
    if (job->control.step > 0.0 || left <= 1.01 * run->h) {
        *h = left, *t_new = target;
    } else {
        *h = left < 2.0 * run->h ? 0.5 * left : run->h;
        *t_new = run->t + *h;
    }
}

/* Factor for the next step, by a proportional-integral rule (Hairer, Wanner II, IV.2). */
static double growth(const Job *job, double error) {
    const double order = job->method.error_order;
    const double wanted =
        safety * pow(larger(error, 1e-10), -0.7 / order) * pow(larger(job->run.error_before, 1e-4), 0.4 / order);
    return smaller(larger(wanted, shrink), grow);
}

static int attempt_step(Job *job, double h, double *error) {
    switch (job->method.family) {
        case EXPLICIT: return attempt_explicit(job, h, error);
        case ESDIRK: return attempt_esdirk(job, h, error);
        default: return attempt_rosenbrock(job, h, error);
    }
}

/* A step with the derivative at its end; the error is NaN where a value is not finite. */
static int attempt(Job *job, double h, double t_new, double *error) {
    Work *w = &job->work;
    int status = attempt_step(job, h, error);
    if (status <= WARNING && *error <= 1.0 && !job->method.end_in_error)
        status = evaluate(job, t_new, w->x_new, w->dx_new);
    if (!(all_finite(w->x_new, w->n) && all_finite(w->dx_new, w->n))) *error = NAN;
    return status;
}

int accepted_step(Job *job, double target, double *h, double *t_new) {
    Run *run = &job->run;
    const Control *control = &job->control;
    double error = NAN;
    for (;;) {
        limit(job, target, h, t_new);
        const int status = attempt(job, *h, *t_new, &error);
        if (status <= WARNING && error <= 1.0) break;
        run->rejected++;
        run->status = worse((int)run->status, status);
        if (status > DISCARD) return MODEL_ERROR;
        const bool finite = status > WARNING || error == error;
        run->h = *h * (error > 1.0 ? larger(safety * pow(error, -1.0 / job->method.error_order), shrink) : failed);
        if (control->step > 0.0 || run->h <= 4.0 * EPS * larger(fabs(run->t), fabs(target)))
            return finite ? STEP_TOO_SMALL : NOT_FINITE;
    }
    if (control->step == 0.0) {
        const double wanted = *h * growth(job, error);
        run->h = smaller(*t_new == target ? larger(wanted, run->h) : wanted, control->max_step);
        run->error_before = error;
    }
    return RUNNING;
}
