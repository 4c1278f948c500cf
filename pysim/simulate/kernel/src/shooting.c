/* Periodic orbits by shooting: Newton on the states that come back to themselves after one period (Stoer, Bulirsch,
   Introduction to Numerical Analysis, 7.3).

   With the monodromy matrix M, the derivative of a period's end by its start, the mismatch after one period is removed by
   the correction (I - M)^-1 (x(T) - x(0)); what is left of it is applied to the last period to first order, which makes
   an error of its square. A correction after which the mismatch is larger is halved, unless both mismatches are what the
   choice of the integration's steps leaves open: then the smaller one is left, too. Where corrections go to and fro over a
   kink of the law, periods follow each other from the nearest start instead: an orbit that attracts is reached so, too. */
#include "kernel.h"

enum { ITERATIONS = 15, HALVINGS = 4, PERIODS = 60 };
static const double within = 3.0;    /* tolerated errors of a step: what its choice alone moves the end of a period */
static const double furthest = 10.0; /* amplitudes: a longer correction is shortened to that */
static const double jumpy = 30.0;    /* tolerated errors of a step: so far the end of a period with kinks jumps */
static const double wavers = 10.0;   /* tolerated mismatches: within them a period that attracts may end by its steps */

/* Tolerated error of a step in state i. */
static double step_error(const Job *job, int64_t i) {
    const double size = larger(fabs(job->variation.high[i]), fabs(job->variation.low[i]));
    return job->control.rtol * size + job->control.atol * job->work.nominal[i];
}

/* What brings the period just run back to its start. A direction that a period changes by less than the integration's own
   error is neutral: nothing brings a state back along it. */
static void examine(Job *job, double tolerance) {
    const Variation *v = &job->variation;
    const Work *w = &job->work;
    Shooting *s = &job->shooting;
    Shot *shot = &s->now;
    const int64_t n = w->n, c = v->columns, m = 1 + v->parameters;
    for (int64_t i = 0; i < n; i++) {
        s->scale[i] = larger(0.5 * (v->high[i] - v->low[i]), within * step_error(job, i) / tolerance);
        shot->jumps[i] = larger(tolerance * s->scale[i], jumpy * step_error(job, i));
        s->right[i * m] = (w->x[i] - shot->start[i]) / s->scale[i];
        for (int64_t p = 0; p < v->parameters; p++) s->right[i * m + 1 + p] = v->s[i * c + n + p] / s->scale[i];
    }
    for (int64_t j = 0; j < n; j++)
        for (int64_t i = 0; i < n; i++)
            s->matrix[j * n + i] = (i == j ? 1.0 : 0.0) - v->s[i * c + j] / s->scale[i] * s->scale[j];
    solve_least(s, shot->solved, n, m, job->control.rtol, &shot->drift, w->sums);
    shot->mismatch = 0.0;
    for (int64_t i = 0; i < n; i++) {
        shot->mismatch = larger(shot->mismatch, fabs(shot->solved[i * m]));
        for (int64_t k = 0; k < m; k++) shot->solved[i * m + k] *= s->scale[i];
    }
    shot->steps = job->run.steps, shot->rejected = job->run.rejected;
    shot->derivatives = job->run.derivatives, shot->jacobians = job->run.jacobians, shot->events = job->run.events;
}

/* Whether a correction is no longer than what the choice of the steps may move it. */
static bool resolved(const Job *job, const Shot *shot) {
    const int64_t m = 1 + job->variation.parameters;
    for (int64_t i = 0; i < job->work.n; i++)
        if (!(fabs(shot->solved[i * m]) <= shot->jumps[i])) return false;
    return true;
}

/* One period from the start of `now`; how it ended. */
static int one_period(Job *job, const Task *task, const Pass *pass, bool rewind) {
    Variation *v = &job->variation;
    const Shot *shot = &job->shooting.now;
    const int64_t n = job->work.n;
    fresh_run(job, task->start, task->end);
    v->rewind = rewind, v->start = shot->start;
    fill(v->start_by, 0.0, n * v->columns);
    for (int64_t i = 0; i < n; i++) v->start_by[i * v->columns + i] = 1.0;
    fill(v->sizes, 0.0, v->columns);
    fill(v->low, INFINITY, n);
    fill(v->high, -INFINITY, n);
    v->rows = shot->rows;
    job->rows.next = 0, job->rows.count = task->count, job->rows.times = task->times, job->rows.values = shot->values;
    job->breaks = task->breaks;
    return run_to_end(job, pass, integrate_variations);
}

/* Some periods from the model's own start make a guess; how that run ended. */
static int settle_down(Job *job, const Task *task, const Pass *pass) {
    const Variation kept = job->variation;
    job->variation.columns = job->variation.by_start = job->variation.parameters = 0;
    job->variation.rewind = 0, job->variation.start = NULL;
    fresh_run(job, task->start, task->settling);
    job->rows.count = job->rows.next = 0;
    job->breaks = task->settling_breaks;
    const int code = run_to_end(job, pass, integrate_variations);
    copy(job->shooting.guess, job->work.x, job->work.n);
    job->variation = kept;
    return code;
}

static void swap_shots(Shooting *s) {
    const Shot kept = s->now;
    s->now = s->before, s->before = kept;
}

/* Ends the search at a shot, unless something drifts. */
static int accept(const Shot *shot, double tolerance) { return shot->drift > tolerance ? DRIFTS : FOUND; }

/* Makes the instance ready for another period; whether it is. */
static bool ready(Job *job, Task *task, bool rewind) {
    if (!rewind) task->part = start_instance(job, task, task->end);
    return !task->part;
}

/* Whether the period just run left nothing behind that a start from its states lacks. */
static bool rewinds(const Job *job, const Task *task) {
    return task->code == DONE && job->run.events == 0 && job->run.next_event >= task->end;
}

/* Period after period from the nearest start so far, which is in `before`, until they no longer come closer. */
static int follow(Job *job, Task *task, const Pass *pass, bool rewind) {
    Shooting *s = &job->shooting;
    double last = 0.0;
    copy(s->now.start, s->before.start, job->work.n);
    for (int count = 0; count < PERIODS; count++) {
        task->iterations++;
        if (!ready(job, task, rewind)) return RUN_FAILED;
        task->code = one_period(job, task, pass, rewind);
        if (stopped(pass)) return STOPPED_SEARCH;
        if (task->code == EVENT) return MET_EVENT;
        if (task->code != DONE) return RUN_FAILED;
        examine(job, task->mismatch);
        const bool near = s->now.mismatch <= wavers * task->mismatch && s->now.mismatch >= last;
        if (s->now.mismatch <= task->mismatch || (count && near)) return accept(&s->now, task->mismatch);
        last = s->now.mismatch;
        copy(s->now.start, job->work.x, job->work.n);
        rewind = rewinds(job, task);
    }
    return NOT_CONVERGED;
}

/* The search from `guess`, with the instance in event mode; FOUND leaves the last period in `now`. */
static int search(Job *job, Task *task, const Pass *pass) {
    Shooting *s = &job->shooting;
    const int64_t n = job->work.n, m = 1 + job->variation.parameters;
    const double tolerance = task->mismatch;
    bool rewind = false, have_before = false;
    double length = 1.0;
    copy(s->now.start, s->guess, n);
    for (int count = 1; count <= ITERATIONS; count++) {
        task->iterations = count;
        task->code = one_period(job, task, pass, rewind);
        if (stopped(pass)) return STOPPED_SEARCH;
        if (task->code == EVENT) return MET_EVENT;
        const bool done = task->code == DONE;
        if (done) examine(job, tolerance);
        if (done && s->now.mismatch <= tolerance) return accept(&s->now, tolerance);
        rewind = rewinds(job, task);
        if (!done || (have_before && !(s->now.mismatch < s->before.mismatch))) {
            if (done && have_before && resolved(job, &s->now) && resolved(job, &s->before)) {
                swap_shots(s);
                return accept(&s->now, tolerance);
            }
            length *= 0.5;
            if (!have_before) return RUN_FAILED;
            if (length < 1.0 / (1 << HALVINGS)) break;
        } else {
            swap_shots(s);
            have_before = true;
            length = smaller(1.0, furthest / s->before.mismatch);
        }
        for (int64_t i = 0; i < n; i++) s->now.start[i] = s->before.start[i] + length * s->before.solved[i * m];
        if (!ready(job, task, rewind)) return RUN_FAILED;
    }
    if (task->code != DONE) return RUN_FAILED;
    return s->before.drift > tolerance ? DRIFTS : follow(job, task, pass, rewind);
}

/* Applies what is left of the correction, and puts the derivatives by the parameters together. */
static void finish(Job *job, Task *task) {
    const Variation *v = &job->variation;
    Shooting *s = &job->shooting;
    const Shot *shot = &s->now;
    const int64_t n = job->work.n, c = v->columns, n_p = v->parameters, m = 1 + n_p, n_y = job->rows.columns;
    task->rows = task->count - 1; /* the end of the period is its start */
    for (int64_t r = 0; r < task->rows * n_y; r++) {
        const double *row = shot->rows + r * c;
        s->sum[0] = shot->values[r];
        copy(s->sum + 1, row + n, n_p);
        for (int64_t j = 0; j < n; j++)
            if (row[j] != 0.0) job->work.sums->add_row(s->sum, shot->solved + j * m, row[j], m);
        task->values[r] = s->sum[0];
        copy(task->slopes + r * n_p, s->sum + 1, n_p);
    }
    for (int64_t i = 0; i < n; i++) {
        task->state[i] = shot->start[i] + shot->solved[i * m];
        copy(task->state_by + i * n_p, shot->solved + i * m + 1, n_p);
    }
    task->correction = shot->mismatch;
    task->steps = shot->steps, task->rejected = shot->rejected, task->derivatives = shot->derivatives;
    task->jacobians = shot->jacobians, task->events = shot->events;
}

void find_orbit(Job *job, Task *task, const Pass *pass) {
    Shooting *s = &job->shooting;
    if (task->states) {
        copy(s->guess, task->states, job->work.n);
    } else {
        task->part = start_instance(job, task, task->settling);
        task->code = task->part ? MODEL_ERROR : settle_down(job, task, pass);
        if (task->code != DONE) {
            task->trouble = stopped(pass) ? STOPPED_SEARCH : task->code == EVENT ? MET_EVENT : RUN_FAILED;
            note_run(job, task, (int)task->code);
            return;
        }
    }
    task->part = start_instance(job, task, task->end);
    task->code = MODEL_ERROR;
    task->trouble = task->part ? RUN_FAILED : search(job, task, pass);
    note_run(job, task, (int)task->code);
    if (task->trouble == FOUND) finish(job, task);
}
