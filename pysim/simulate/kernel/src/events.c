/* Events: where an indicator changes its sign, and what the model does about it. */
#include "kernel.h"

enum {
    ROUNDS = 1000, /* of one event iteration */
    CROWD = 1000,  /* events without time moving on */
    SEARCH = 200   /* evaluations to locate one event; every third one halves the bracket */
};

static const double standstill = 1e-15; /* of the time so far and of the whole run: less is rounding */

void move_time(Run *run, double t_new) {
    if (t_new - run->t > standstill * larger(fabs(t_new), run->end - run->start)) run->crowd = 0;
    run->t = t_new;
}

/* Whether an indicator changed between > 0 and <= 0. */
bool crossed(const Job *job, const double *before, const double *after) {
    bool changed = false;
    for (int64_t i = 0; i < job->work.m; i++) changed |= (before[i] > 0.0) != (after[i] > 0.0);
    return changed;
}

/* First crossing in [low, high], by straight lines through work.z_low and work.z_new. */
static double first_secant(const Job *job, double low, double high) {
    const double *a = job->work.z_low, *b = job->work.z_new;
    double first = high;
    for (int64_t i = 0; i < job->work.m; i++)
        if ((a[i] > 0.0) != (b[i] > 0.0)) first = smaller(first, low + (high - low) * a[i] / (a[i] - b[i]));
    return first;
}

/* Share of the step just after its first sign change, where work.z_new is taken.

   The bracket is narrowed by secants kept half a tolerance away from its ends, so that both ends close in, and in every
   third round by its middle, so that they always do. work.z, work.z_new and work.dense are filled; work.x_try changes. */
int locate(Job *job, double h, double *theta) {
    const Run *run = &job->run;
    Work *w = &job->work;
    const double width = 4.0 * EPS * larger(fabs(run->t), fabs(run->t + h)) / h;
    double low = 0.0, high = 1.0;
    copy(w->z_low, w->z, w->m);
    for (int count = 0; count < SEARCH && high - low > width; count++) {
        double share = count % 3 == 2 ? 0.5 * (low + high) : first_secant(job, low, high);
        share = smaller(larger(share, low + 0.5 * width), high - 0.5 * width);
        interpolate(job, share);
        int status = set_point(job, run->t + share * h, w->x_try);
        if (status <= WARNING) status = worse(status, fmi_get_indicators(job->fmu, w->z_try, w->m));
        if (status > WARNING) return *theta = high, status;
        if (crossed(job, w->z, w->z_try)) {
            high = share;
            copy(w->z_new, w->z_try, w->m);
        } else {
            low = share;
            copy(w->z_low, w->z_try, w->m);
        }
    }
    return *theta = high, OK;
}

/* Event iteration, from event mode to continuous-time mode. */
int settle(Job *job) {
    Fmu *fmu = job->fmu;
    Run *run = &job->run;
    Work *w = &job->work;
    bool states = false, nominals = false;
    fmu->again = 1;
    for (int rounds = 0; fmu->again; rounds++) {
        if (rounds >= ROUNDS) return TOO_MANY_EVENTS;
        run->status = worse((int)run->status, fmi_update_discrete(fmu));
        if (run->status > WARNING) return MODEL_ERROR;
        if (fmu->terminate) return TERMINATED;
        states |= fmu->states_changed != 0, nominals |= fmu->nominals_changed != 0;
        if (fmu->next_time <= run->t) fmu->again = 1; /* due at once, as some FMUs say instead of asking for a round */
    }
    int status = fmi_enter_continuous_mode(fmu);
    if (states) status = worse(status, fmi_get_states(fmu, w->x, w->n));
    if (nominals) status = worse(status, fmi_get_nominals(fmu, w->nominal, w->n));
    run->next_event = fmu->next_time;
    run->status = worse((int)run->status, status);
    return run->status > WARNING ? MODEL_ERROR : RUNNING;
}

/* Event at run.t, where the FMU stands; inputs take their values to the right of it. */
int handle_event(Job *job) {
    Run *run = &job->run;
    run->events++;
    run->crowd++;
    if (run->crowd > CROWD) return TOO_MANY_EVENTS;
    int status = fmi_enter_event_mode(job->fmu);
    if (status <= WARNING) status = worse(status, set_inputs(job, run->t));
    run->status = worse((int)run->status, status);
    return status <= WARNING ? settle(job) : MODEL_ERROR;
}
