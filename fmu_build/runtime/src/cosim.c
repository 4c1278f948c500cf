#include "cosim.h"

#include <math.h>
#include <string.h>

#include "evaluate.h"
#include "events.h"
#include "integrate.h"
#include "relations.h"

static const double SAME_POINT = 1e-9;  /* of the time, or of 1 s: an importer may add up its steps */
static const double STEPS_WITHOUT_STATES = 10.0; /* per communication step, to look for events */
static const double NO_PROGRESS = 1e-10; /* of the communication step */
enum {
    MAX_EVENTS_AT_ONCE = 100,
    MAX_STEPS_WITHOUT_PROGRESS = 100000,
    MAX_STEPS = 200000,      /* per communication step */
    MAX_STEPS_OF_DELAY = 20000 /* of those, that a delay alone may ask for */
};

static bool can_step(Instance *s, const char *function, double point, double size) {
    const double slack = SAME_POINT * fmax(1.0, fabs(*s->t));
    if (!(fabs(point - *s->t) <= slack)) {
        log_message(s, LOG_ERROR, "%s: the step begins at %.16g s, but the FMU is at %.16g s.", function, point, *s->t);
    } else if (!(size > 0.0) || !isfinite(size)) {
        log_message(s, LOG_ERROR, "%s: the step size is %.16g s; it must be positive.", function, size);
    } else if (point + size > s->memory->stop_time + slack) {
        log_message(s, LOG_ERROR, "%s: the step ends at %.16g s, after the stop time %.16g s.", function, point + size,
                    s->memory->stop_time);
    } else {
        return true;
    }
    return false;
}

static Status worse(Status a, Status b) { return a > b ? a : b; }

Status cosim_start(Instance *s) {
    EventResult event;
    const Status status = events_update(s, &event);
    if (status <= STATUS_WARNING) return status;
    set_phase(s, PHASE_FAILED);
    return STATUS_ERROR;
}

/* The progress of one communication step. */
typedef struct {
    double target; /* where it ends, s; an importer may shorten it */
    int events_at_once, steps, steps_without_progress;
    StepResult *result;
} Run;

/* An event inside the step is the importer's if it asked for that and can be told so in time. */
static bool is_importers(const Instance *s, const Run *run) {
    return s->event_mode_used && (s->early_return_allowed || *s->t >= run->target);
}

static Status handle_event(Instance *s, Run *run) {
    if (is_importers(s, run)) {
        run->result->event_needed = true;
        return STATUS_OK;
    }
    const bool again = *s->t <= s->memory->last_event_time + time_slack(s);
    run->events_at_once = again ? run->events_at_once + 1 : 0;
    if (run->events_at_once > MAX_EVENTS_AT_ONCE) {
        log_message(s, LOG_ERROR, "More than %d events at time %.16g s.", MAX_EVENTS_AT_ONCE, *s->t);
        return STATUS_ERROR;
    }
    EventResult event;
    const Status status = events_update(s, &event);
    run->result->terminate = event.terminate;
    return status;
}

/* What the importer changed between two steps takes effect: at an event if there are discrete equations. */
static Status take_over_inputs(Instance *s, Run *run) {
    if (!s->memory->is_disturbed) return STATUS_OK;
    if (!s->event_mode_used) return handle_event(s, run);
    bool crossed = false;
    const Status status = relations_are_crossed(s, &crossed);
    return status == STATUS_OK && crossed ? handle_event(s, run) : status;
}

static void offer_update(Instance *s, Run *run) {
    double time = run->target;
    if (!s->intermediate_update || !s->intermediate_update(s, *s->t, &time)) return;
    run->target = fmin(run->target, fmax(time, *s->t));
}

/* An event within rounding of the step's end is there: else chance decides between the inputs of this step and those of
   the next. */
static double next_event(const Instance *s, const Run *run) {
    const double time = s->memory->next_event_time;
    return fabs(time - run->target) <= time_slack(s) ? run->target : time;
}

static double limit_of(const Instance *s, const Run *run, double size) {
    const double limit = fmin(run->target, next_event(s, run));
    if (s->model->n_x > 0) return limit;
    const double part = fmax(*s->t + size / STEPS_WITHOUT_STATES, nextafter(*s->t, INFINITY)); /* time moves on */
    return fmin(limit, part);
}

static bool is_done(const Instance *s, const Run *run) {
    return *s->t >= run->target || run->result->event_needed || run->result->terminate;
}

/* Error control that never comes through, or events that pile up: better an error than an endless step. */
static Status check_progress(Instance *s, Run *run, double before, double size) {
    run->steps++;
    run->steps_without_progress = *s->t - before < NO_PROGRESS * size ? run->steps_without_progress + 1 : 0;
    const bool is_stuck = run->steps_without_progress > MAX_STEPS_WITHOUT_PROGRESS;
    if (!is_stuck && (run->steps <= MAX_STEPS || is_done(s, run))) return STATUS_OK;
    const int count = is_stuck ? MAX_STEPS_WITHOUT_PROGRESS : MAX_STEPS;
    log_message(s, LOG_ERROR,
                "%d steps inside one communication step of %g s have come to %.16g s only; %s asks for the shortest: "
                "check the parameters and the tolerance, or take shorter communication steps.",
                count, size, *s->t, integrate_culprit(s));
    return STATUS_ERROR;
}

/* Nothing happens after the model's end: FMI 2 and FMI 3 report it for each step tried. */
static Status run_step(Instance *s, Run *run, double size) {
    Status status = run->result->terminate ? STATUS_OK : take_over_inputs(s, run);
    while (status <= STATUS_WARNING && !is_done(s, run)) {
        bool event = false;
        const double before = *s->t;
        status = worse(status, integrate_step(s, limit_of(s, run, size), &event));
        status = worse(status, check_progress(s, run, before, size));
        if (status > STATUS_WARNING) break;
        offer_update(s, run);
        if (event || *s->t >= next_event(s, run)) status = worse(status, handle_event(s, run));
    }
    return status;
}

/* After Discard: as if the step had not been tried. */
static void undo(Instance *s) {
    memcpy(s->memory, s->backup, s->memory_size);
    s->memory->computed &= HAS_C | HAS_V | HAS_Q;
}

Status cosim_step(Instance *s, const char *function, double point, double size, StepResult *result) {
    *result = (StepResult){*s->t, false, s->memory->is_terminated != 0, false};
    if (!can_step(s, function, point, size)) return STATUS_ERROR;
    memcpy(s->backup, s->memory, s->memory_size);
    Run run = {.target = point + size, .result = result};
    s->integrator.least_for_delay = size / (double)MAX_STEPS_OF_DELAY;
    const Status status = run_step(s, &run, size);
    if (status == STATUS_DISCARD) undo(s);
    if (status == STATUS_ERROR) set_phase(s, PHASE_FAILED);
    result->time = *s->t;
    result->early = *s->t < point + size;
    return status;
}
