#include "timeevents.h"

#include <float.h>
#include <math.h>

#include "delay.h"
#include "evaluate.h"
#include "relations.h"

static Status instants(Instance *s) {
    if (evaluate_calculated(s) != STATUS_OK) return STATUS_DISCARD;
    double *res[] = {s->event.instants, s->event.sample_start, s->event.sample_interval};
    if (call_model(s, s->model->instants, res) != STATUS_OK) return STATUS_DISCARD;
    for (size_t k = 0; k < s->model->n_s; k++) {
        const double start = s->event.sample_start[k], interval = s->event.sample_interval[k];
        const double shortest = 16.0 * DBL_EPSILON * fmax(fabs(*s->t), fabs(start)); /* else the ticks coincide */
        if (isfinite(start) && interval > shortest && isfinite(interval)) continue;
        log_message(s, LOG_ERROR, "sample() number %zu: start %.16g s and interval %.16g s; the interval must be positive.",
                    k + 1, start, interval);
        return STATUS_ERROR;
    }
    return STATUS_OK;
}

/* First tick of clock k after `time`: start + n * interval, never a running sum. The division may round either way,
   which two corrections set right. */
static double first_tick_after(const Instance *s, size_t k, double time) {
    const double start = s->event.sample_start[k], interval = s->event.sample_interval[k];
    double n = fmax(0.0, floor((time - start) / interval));
    for (int correction = 0; correction < 2 && start + n * interval <= time; correction++) n += 1.0;
    return start + n * interval;
}

Status time_events_tick(Instance *s, bool *any) {
    *any = false;
    if (s->model->n_s == 0) return STATUS_OK;
    const Status status = instants(s);
    if (status != STATUS_OK) return status;
    const double slack = time_slack(s);
    for (size_t k = 0; k < s->model->n_s; k++) {
        const bool ticks = first_tick_after(s, k, s->memory->last_event_time + slack) <= *s->t + slack;
        s->e[2 + k] = ticks ? 1.0 : 0.0;
        *any = *any || ticks;
    }
    return STATUS_OK;
}

Status time_events_next(Instance *s, double *time) {
    *time = delay_next_break(s);
    if (s->model->n_s == 0 && s->n_state_relations == s->model->n_r) return STATUS_OK;
    const Status status = instants(s);
    if (status != STATUS_OK) return status;
    const double now = *s->t + time_slack(s);
    for (size_t k = 0; k < s->model->n_s; k++) *time = fmin(*time, first_tick_after(s, k, now));
    for (size_t k = 0; k < s->model->n_r; k++)
        if (s->model->relations[k].of_time && s->event.instants[k] > now) *time = fmin(*time, s->event.instants[k]);
    return STATUS_OK;
}
