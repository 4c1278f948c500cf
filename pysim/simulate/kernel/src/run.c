/* A run: step, locate, record, handle events. */
#include "kernel.h"

static const int64_t stretch = 1000000; /* steps over which the pace of a run is seen; no transient takes as many */
static const double hopeless = 1e3;     /* times the limit of steps that the rest would take at that pace */

/* Whether the point reached is a break of the inputs with a segment behind it. */
bool at_break(const Job *job) {
    return job->run.t >= job->run.horizon && job->run.segment + 1 < job->breaks.count;
}

/* Enters the first segment of the inputs, or the one behind the break that was reached. */
void next_segment(Job *job) {
    Run *run = &job->run;
    run->segment++;
    run->horizon = job->breaks.times[run->segment];
    run->inputs_at = NAN;
}

bool offset_here(Job *job) {
    Run *run = &job->run;
    if (!(run->t >= run->offset_at)) return false;
    run->offset_at = NAN;
    for (int64_t i = 0; i < job->work.n; i++) job->work.x[i] += run->offset[i];
    run->status = worse((int)run->status, set_point(job, run->t, job->work.x));
    return true;
}

/* Whether the last stretch of steps got so little further that the run would never come to its end. */
static bool stuck(Job *job) {
    Run *run = &job->run;
    if (run->steps - run->looked < stretch) return false;
    const double steps = (double)(run->steps - run->looked), time = run->t - run->looked_at;
    run->looked = run->steps, run->looked_at = run->t;
    return steps * (run->end - run->t) > hopeless * (double)job->control.max_steps * time;
}

/* Whether the point reached is the last one: DONE, TOO_MANY_STEPS or RUNNING. */
int ended(Job *job) {
    if (job->run.t >= job->run.end) return DONE;
    return job->run.steps >= job->control.max_steps || stuck(job) ? TOO_MANY_STEPS : RUNNING;
}

/* Derivatives, indicators, and a first step that suits them. */
int resume(Job *job) {
    Run *run = &job->run;
    Work *w = &job->work;
    int status = evaluate(job, run->t, w->x, w->dx);
    if (status <= WARNING) status = worse(status, fmi_get_indicators(job->fmu, w->z, w->m));
    run->status = worse((int)run->status, status);
    if (status > WARNING) return MODEL_ERROR;
    if (!(all_finite(w->x, w->n) && all_finite(w->dx, w->n))) return NOT_FINITE;
    run->jacobian_at = NAN;
    if (job->control.step == 0.0 && run->t < run->end) {
        run->error_before = 1.0;
        run->h = first_step(job);
    }
    return RUNNING;
}

/* Records the point reached, and sees whether it is the last one. */
static int finish_point(Job *job) {
    job->run.status = worse((int)job->run.status, record_here(job));
    return job->run.status > WARNING ? MODEL_ERROR : ended(job);
}

/* First event iteration, states and derivatives; the FMU has left initialisation mode. */
static int begin(Job *job) {
    Run *run = &job->run;
    Work *w = &job->work;
    next_segment(job);
    int code = settle(job);
    if (code != RUNNING) return code;
    run->status = worse((int)run->status, fmi_get_states(job->fmu, w->x, w->n));
    run->status = worse((int)run->status, fmi_get_nominals(job->fmu, w->nominal, w->n));
    if (run->status > WARNING) return MODEL_ERROR;
    if (offset_here(job)) code = run->status <= WARNING ? handle_event(job) : MODEL_ERROR;
    if (code == RUNNING) code = resume(job);
    return code == RUNNING ? finish_point(job) : code;
}

/* Makes the end of the step the current point; handles what is due there; records it. */
static int arrive(Job *job, double t_new, bool event) {
    Fmu *fmu = job->fmu;
    Run *run = &job->run;
    Work *w = &job->work;
    move_time(run, t_new);
    copy(w->x, w->x_new, w->n);
    copy(w->dx, w->dx_new, w->n);
    copy(w->z, w->z_new, w->m);
    if (fmu->terminate) return TERMINATED;
    event = event || fmu->event || run->t >= next_time_event(job);
    bool restart = false;
    if (at_break(job)) {
        restart = true;
        event = event || job->breaks.jumps[run->segment];
        next_segment(job);
    }
    if (offset_here(job)) {
        if (run->status > WARNING) return MODEL_ERROR;
        event = true;
    }
    int code = event ? handle_event(job) : RUNNING;
    if (code == RUNNING && (event || restart)) code = resume(job);
    return code == RUNNING ? finish_point(job) : code;
}

/* One accepted step with all that happens in it and at its end. */
static int advance(Job *job) {
    Run *run = &job->run;
    Work *w = &job->work;
    double h = 0.0, t_new = 0.0;
    const int code = accepted_step(job, next_target(job), &h, &t_new);
    if (code != RUNNING) return code;
    run->steps++;
    run->status = run->status > WARNING ? WARNING : run->status; /* what was rejected is forgiven */
    int status = fmi_get_indicators(job->fmu, w->z_new, w->m);
    const bool event = crossed(job, w->z, w->z_new);
    const bool inside = job->rows.next < job->rows.count && job->rows.times[job->rows.next] < t_new;
    if (event || inside) dense_coefficients(job, h);
    if (event && status <= WARNING) {
        double theta = 1.0;
        status = locate(job, h, &theta);
        if (theta < 1.0) {
            interpolate(job, theta);
            copy(w->x_new, w->x_try, w->n);
            t_new = run->t + theta * h;
        }
    }
    if (inside && status <= WARNING) status = record_inside(job, h, t_new);
    if ((event || inside) && status <= WARNING) status = set_point(job, t_new, w->x_new);
    if (status <= WARNING) status = fmi_completed_step(job->fmu);
    run->status = worse((int)run->status, status);
    return status <= WARNING ? arrive(job, t_new, event) : MODEL_ERROR;
}

int integrate(Job *job, int64_t budget) {
    int code = job->run.segment < 0 ? begin(job) : RUNNING;
    for (; code == RUNNING && budget > 0; budget--) code = advance(job);
    return code;
}
