#include "integrate.h"

#include <float.h>
#include <math.h>

#include "constraints.h"
#include "crossing.h"
#include "delay.h"
#include "evaluate.h"
#include "events.h"
#include "rodas.h"

static const double SAFETY = 0.9, GROWTH = 6.0, SHRINK = 0.2;
static const double SHRINK_AFTER_FAILURE = 0.25;
static const double STRETCH = 1.1; /* a step may be this much longer, so that no tiny one is left before the limit */
static const double FIRST_STEP = 1e-6; /* s, where values and derivatives give no scale */
enum { HISTORY_POINTS = 4 };           /* per step, for delay() */

static double scaled_size(const Instance *s, const double *values) {
    double sum = 0.0;
    for (size_t k = 0; k < s->model->n_x; k++) {
        const double ratio = values[k] / (s->model->nominal_x[k] + fabs(s->x[k]));
        sum += ratio * ratio;
    }
    return sqrt(sum / (double)s->model->n_x);
}

/* First proposal: 1 percent of the time in which the states would change by their own size. */
static double first_step(Instance *s, double limit) {
    const double whole = limit - *s->t;
    if (s->model->n_x == 0 || evaluate_derivatives(s) != STATUS_OK) return whole;
    const double size = scaled_size(s, s->x), speed = scaled_size(s, s->dx);
    const double step = size > 1e-5 && speed > 1e-5 ? 0.01 * size / speed : FIRST_STEP;
    return fmin(whole, step);
}

/* Below this, the rounding of the time would show in the step. */
static double smallest_step(const Instance *s, double limit) {
    return 16.0 * DBL_EPSILON * fmax(fabs(s->integrator.begin), fabs(limit));
}

/* Where the next step ends: the limit itself if that is near. */
static double step_end(const Instance *s, double limit) {
    const double begin = s->integrator.begin;
    const double delay = fmax(delay_smallest(s), s->integrator.least_for_delay);
    const double step = fmin(s->memory->step_size, delay);
    if (begin + STRETCH * step >= limit) return limit;
    return begin + 2.0 * step >= limit ? begin + 0.5 * (limit - begin) : begin + step;
}

/* Quotient of the next step and one of the given error, within bounds. */
static double factor_for(double error) {
    return fmin(GROWTH, fmax(SHRINK, SAFETY * pow(fmax(error, 1e-10), -1.0 / (double)RODAS_ORDER)));
}

/* After an accepted step: also expects the error to go on growing as it did (K. Gustafsson, Control-theoretic techniques
   for stepsize selection in implicit Runge-Kutta methods, ACM Trans. Math. Softw. 20, 1994). */
static double next_step_size(Memory *memory, double step, double error, bool after_rejection) {
    double factor = factor_for(error);
    if (memory->accepted_step > 0.0) {
        const double growth = pow(fmax(error, 1e-10) / memory->accepted_error, 1.0 / (double)RODAS_ORDER);
        const double predicted = step / memory->accepted_step * factor / growth;
        factor = fmin(factor, fmax(SHRINK, predicted));
    }
    memory->accepted_step = step;
    memory->accepted_error = fmax(error, 1e-2);
    return step * (after_rejection ? fmin(factor, 1.0) : factor);
}

const char *integrate_culprit(const Instance *s) {
    return s->model->n_x > 0 ? variable_name(s, VECTOR_X, rodas_worst(s)) : "an event";
}

static Status give_up(Instance *s, double step, bool evaluated) {
    if (!evaluated) (void)evaluate_derivatives(s); /* where the trial failed: now it may say why */
    if (evaluated)
        log_message(s, LOG_DISCARD, "At time %.16g s even a step of %.3g s misses the tolerance of %.3g, most of all %s.",
                    s->integrator.begin, step, s->memory->tolerance, integrate_culprit(s));
    else
        log_message(s, LOG_DISCARD, "At time %.16g s even a step of %.3g s cannot be evaluated.", s->integrator.begin, step);
    return STATUS_DISCARD;
}

/* One trial: OK if it is accepted, Discard if a smaller step must be tried. */
static Status try_step(Instance *s, double end, bool *evaluated, double *error, bool *event) {
    s->log.quiet = true;
    Status status = rodas_try(s, end, error);
    *evaluated = status == STATUS_OK;
    if (*evaluated && *error > 1.0) status = STATUS_DISCARD;
    if (status == STATUS_OK) {
        status = crossing_locate(s, event);
        *evaluated = status == STATUS_OK;
    }
    s->log.quiet = false;
    return status;
}

static Status accepted_step(Instance *s, double limit, bool *event) {
    Memory *memory = s->memory;
    bool rejected = false;
    for (;;) {
        const double end = step_end(s, limit), step = end - s->integrator.begin;
        bool evaluated = false;
        double error = 0.0;
        if (try_step(s, end, &evaluated, &error, event) == STATUS_OK) {
            const double next = next_step_size(memory, step, error, rejected);
            memory->step_size = step < memory->step_size ? fmax(next, memory->step_size) : next;
            return STATUS_OK;
        }
        rejected = true;
        memory->step_size = step * (evaluated ? fmin(factor_for(error), 1.0) : SHRINK_AFTER_FAILURE);
        if (!(memory->step_size > smallest_step(s, limit))) return give_up(s, step, evaluated); /* both may be 0 */
    }
}

/* Adds points of the accepted step, up to the present time, to the histories. */
static Status record_history(Instance *s) {
    if (s->model->n_v == 0) return STATUS_OK;
    const IntegratorWork *w = &s->integrator;
    const double reached = (*s->t - w->begin) / (w->end - w->begin);
    Status status = STATUS_OK;
    for (int k = 1; k <= HISTORY_POINTS && status == STATUS_OK; k++) {
        rodas_move(s, k < HISTORY_POINTS ? reached * (double)k / (double)HISTORY_POINTS : reached);
        status = evaluate_history(s, false);
    }
    return status;
}

Status integrate_step(Instance *s, double limit, bool *event) {
    *event = false;
    if (s->memory->step_size <= 0.0) s->memory->step_size = first_step(s, limit);
    Status status = rodas_begin(s);
    if (status == STATUS_OK) status = accepted_step(s, limit, event);
    if (status == STATUS_OK) status = record_history(s);
    if (status == STATUS_OK) status = constraints_check(s);
    return status == STATUS_OK ? events_check(s) : status;
}
