/* A run with its derivatives. It stops where an event would make them jump.

   At an event whose time depends on a parameter p, S jumps by (f- - f+) dt/dp, and by what the states' own jump depends
   on (Hiskens, Pai 2000). Where the states stay and f- = f+, S stays, unless slopes depend on a number that the event
   left behind. Whoever lets a run go through events knows that they do not. */
#include "kernel.h"

static const double same_slope = 1e-6; /* change of a derivative that is rounding, of its size and of nominal / span */

/* Starts afresh at run.t: derivatives, first step, K. */
static int restart(Job *job) {
    int code = resume(job);
    if (code == RUNNING && job->variation.columns > 0) {
        job->run.status = worse((int)job->run.status, begin_variation(job));
        code = job->run.status <= WARNING ? RUNNING : MODEL_ERROR;
    }
    return code;
}

/* The next row at the point last set, with S in s. */
static int record(Job *job, const double *s) {
    const Rows *rows = &job->rows;
    const int64_t row = rows->next - rows->first;
    int status = read_row(job);
    if (status <= WARNING) status = worse(status, record_variation(job, row, s));
    if (status <= WARNING && rows->take && row + 1 == rows->room) hand_over(job);
    return status;
}

/* Records the point reached, and sees whether it is the last one. */
static int finish_point(Job *job) {
    Run *run = &job->run;
    const Rows *rows = &job->rows;
    if (rows->next < rows->count && rows->times[rows->next] <= run->t) {
        int status = set_point(job, run->t, job->work.x);
        if (status <= WARNING) status = worse(status, record(job, job->variation.s));
        run->status = worse((int)run->status, status);
        if (status > WARNING) return MODEL_ERROR;
    }
    note_range(job);
    if (!all_finite(job->variation.s, job->work.n * job->variation.columns)) return NOT_FINITE;
    return ended(job);
}

/* The states have been offset: S gets the derivatives by it, and the model looks for what changes with them. */
static int offset(Job *job) {
    const Work *w = &job->work;
    const Variation *v = &job->variation;
    if (job->run.status > WARNING) return MODEL_ERROR;
    for (int64_t i = 0; i < v->by_start; i++) v->s[i * v->columns + i] += 1.0;
    copy(w->x_try, w->x, w->n);
    const int code = handle_event(job);
    for (int64_t i = 0; code == RUNNING && i < w->n; i++)
        if (w->x[i] != w->x_try[i]) return EVENT;
    return code;
}

/* First event iteration unless the FMU is past it, states, derivatives, and S. */
static int begin(Job *job) {
    Run *run = &job->run;
    Work *w = &job->work;
    const Variation *v = &job->variation;
    int code = RUNNING;
    next_segment(job);
    if (v->rewind) run->next_event = INFINITY;
    else code = settle(job);
    if (code != RUNNING) return code;
    if (v->start) copy(w->x, v->start, w->n);
    else run->status = worse((int)run->status, fmi_get_states(job->fmu, w->x, w->n));
    run->status = worse((int)run->status, fmi_get_nominals(job->fmu, w->nominal, w->n));
    copy(v->s, v->start_by, w->n * v->columns);
    if (run->status > WARNING) return MODEL_ERROR;
    if (offset_here(job)) code = offset(job);
    if (code == RUNNING) code = restart(job);
    return code == RUNNING ? finish_point(job) : code;
}

/* Handles an event at run.t; EVENT where a state or its derivative changes. */
static int pass_event(Job *job) {
    Run *run = &job->run;
    const Work *w = &job->work;
    copy(w->x_new, w->x, w->n);
    int status = evaluate(job, run->t, w->x, w->dx); /* a step leaves what Newton left of it */
    run->status = worse((int)run->status, status);
    const int code = status <= WARNING ? handle_event(job) : MODEL_ERROR;
    if (code != RUNNING) return code;
    status = evaluate(job, run->t, w->x, w->dx_new);
    run->status = worse((int)run->status, status);
    if (status > WARNING) return MODEL_ERROR;
    for (int64_t i = 0; i < w->n; i++) {
        const double size = larger(fabs(w->dx[i]), fabs(w->dx_new[i])) + w->nominal[i] / (run->end - run->start);
        if (w->x[i] != w->x_new[i] || fabs(w->dx_new[i] - w->dx[i]) > same_slope * size) return EVENT;
    }
    return restart(job);
}

/* Goes on behind a break of the inputs. A jump is an event for the model, harmless where no state changes: no parameter
   moves its time. */
static int pass_break(Job *job) {
    const Work *w = &job->work;
    const bool jump = job->breaks.jumps[job->run.segment] != 0;
    next_segment(job);
    if (jump) {
        const int code = handle_event(job);
        if (code != RUNNING) return code;
        for (int64_t i = 0; i < w->n; i++)
            if (w->x[i] != w->x_new[i]) return EVENT;
    }
    const bool is_offset = offset_here(job);
    int code = is_offset ? offset(job) : RUNNING;
    if (code == RUNNING) code = restart(job);
    const bool harmless = is_offset || (jump && job->variation.through);
    return code == RUNNING && !harmless && crossed(job, w->z, w->z_new) ? EVENT : code;
}

/* Makes the end of the step the current point, passes a break of the inputs there, records. */
static int arrive(Job *job, double t_new, bool event) {
    Run *run = &job->run;
    Work *w = &job->work;
    move_time(run, t_new);
    copy(w->x, w->x_new, w->n);
    copy(w->dx, w->dx_new, w->n);
    copy(w->z, w->z_new, w->m);
    if (job->variation.columns > 0) end_variation(job);
    if (job->fmu->terminate) return TERMINATED;
    event = event || job->fmu->event || run->t >= run->next_event;
    if (event && !(job->variation.through && !at_break(job))) return EVENT;
    const int code = event ? pass_event(job) : at_break(job) ? pass_break(job) : RUNNING;
    return code == RUNNING ? finish_point(job) : code;
}

/* Every row before t_end (s), with its derivatives, in the step of length h from run.t. */
static int record_rows_inside(Job *job, double h, double t_end) {
    Rows *rows = &job->rows;
    double *s = job->variation.right;
    if (rows->next >= rows->count || rows->times[rows->next] >= t_end) return OK;
    dense_coefficients(job, h);
    while (rows->next < rows->count && rows->times[rows->next] < t_end) {
        const double t = rows->times[rows->next], theta = (t - job->run.t) / h;
        interpolate(job, theta);
        vary_inside(job, theta, h, s);
        int status = set_point(job, t, job->work.x_try);
        if (status <= WARNING) status = record(job, s);
        if (status > WARNING) return status;
    }
    return OK;
}

/* Whether the step has to be taken again because a derivative is too far off; sets the length to try next. */
static bool shortened(Job *job, double h) {
    Run *run = &job->run;
    const Variation *v = &job->variation;
    if (!(v->columns > 0 && v->tolerance < INFINITY)) return false;
    const double error = variation_error(job, h);
    const double wanted = h * larger(0.9 * pow(larger(error, 1e-6), -1.0 / job->method.error_order), 0.2);
    if (error <= 1.0 || !(wanted > 1e-12 * (run->end - run->start))) {
        run->h = smaller(run->h, wanted);
        return false;
    }
    run->rejected++;
    run->h = wanted;
    run->jacobian_at = NAN; /* what is there belongs to the end of the step */
    return true;
}

/* The step of length h from run.t ends at its share theta. */
static void end_at(Job *job, double theta, double h) {
    interpolate(job, theta);
    copy(job->work.x_new, job->work.x_try, job->work.n);
    if (job->variation.columns > 0) vary_inside(job, theta, h, job->variation.inside);
}

/* One accepted step, its derivative, and what is recorded in it. */
static int advance(Job *job) {
    Run *run = &job->run;
    Work *w = &job->work;
    double h = 0.0, t_new = 0.0, theta = 1.0;
    bool event;
    int status;
    do {
        const int code = accepted_step(job, next_target(job), &h, &t_new);
        if (code != RUNNING) return code;
        run->status = run->status > WARNING ? WARNING : run->status; /* what was rejected is forgiven */
        status = fmi_get_indicators(job->fmu, w->z_new, w->m);
        event = status <= WARNING && crossed(job, w->z, w->z_new);
        if (event && !job->variation.through) return EVENT;
        if (status <= WARNING && job->variation.columns > 0) status = vary_step(job, h);
    } while (status <= WARNING && shortened(job, h));
    run->steps++;
    if (event && status <= WARNING) {
        dense_coefficients(job, h);
        status = locate(job, h, &theta);
        t_new = theta < 1.0 ? run->t + theta * h : t_new;
    }
    if (status <= WARNING) status = record_rows_inside(job, h, t_new);
    if (theta < 1.0) end_at(job, theta, h);
    if (status <= WARNING) status = set_point(job, t_new, w->x_new);
    if (status <= WARNING) status = fmi_completed_step(job->fmu);
    run->status = worse((int)run->status, status);
    return status <= WARNING ? arrive(job, t_new, event) : MODEL_ERROR;
}

int integrate_variations(Job *job, int64_t budget) {
    int code = job->run.segment < 0 ? begin(job) : RUNNING;
    for (; code == RUNNING && budget > 0; budget--) code = advance(job);
    return code;
}
