/* Tasks: one run or orbit each, in any thread; and all that are left of a pass. */
#include "kernel.h"

enum { BETWEEN_LOOKS = 1 }; /* steps until a run looks whether it is to stop */

bool stopped(const Pass *pass) { return __atomic_load_n(&pass->stop, __ATOMIC_RELAXED) != 0; }

int run_to_end(Job *job, const Pass *pass, int loop(Job *, int64_t)) {
    int code = RUNNING;
    while (code == RUNNING && !stopped(pass)) code = loop(job, BETWEEN_LOOKS);
    job->fmu->status = worse((int)job->fmu->status, (int)job->run.status);
    return code;
}

/* How a run ended, and what the FMU said if it failed. */
void note_run(Job *job, Task *task, int code) {
    const Run *run = &job->run;
    const Log *log = job->fmu->log;
    task->code = code;
    task->status = run->status, task->reached = run->t;
    task->steps = run->steps, task->rejected = run->rejected, task->derivatives = run->derivatives;
    task->jacobians = run->jacobians, task->events = run->events;
    if (code == DONE || code == EVENT || !task->text) return;
    const int64_t first = log->count > LINES ? log->count - LINES : 0;
    for (int64_t i = first; i < log->count; i++)
        memcpy(task->text + (i - first) * LINE_LENGTH, log->lines + (i % LINES) * LINE_LENGTH, LINE_LENGTH);
}

static void run_plain(Job *job, Task *task, const Pass *pass) {
    job->breaks = task->breaks;
    job->rows.next = 0, job->rows.count = task->count, job->rows.times = task->times, job->rows.values = task->values;
    fresh_run(job, task->start, task->end);
    job->run.offset_at = task->offset_at, job->run.offset = task->offset;
    note_run(job, task, run_to_end(job, pass, integrate));
    task->rows = job->rows.next;
}

static void keep_point(const Job *job, const Task *task) {
    const Variation *v = &job->variation;
    const Work *w = &job->work;
    const int64_t n = w->n;
    if (task->state) copy(task->state, w->x, n);
    if (task->nominal) copy(task->nominal, w->nominal, n);
    if (task->low) copy(task->low, v->low, n);
    if (task->high) copy(task->high, v->high, n);
    if (task->rates) copy(task->rates, w->dx, n);
    if (task->jacobian) copy(task->jacobian, w->jacobian, n * n);
    if (task->forcing) copy(task->forcing, v->forcing, v->parameters * n);
}

static void run_varied(Job *job, Task *task, const Pass *pass) {
    Variation *v = &job->variation;
    const int64_t n = job->work.n, c = v->columns, n_p = v->parameters;
    job->breaks = task->breaks;
    job->rows.next = 0, job->rows.count = task->count, job->rows.times = task->times, job->rows.values = task->values;
    fresh_run(job, task->start, task->end);
    job->run.offset_at = task->offset_at, job->run.offset = task->offset;
    v->rewind = 0, v->start = task->states;
    fill(v->start_by, 0.0, n * c);
    for (int64_t i = 0; v->from_start && i < v->by_start; i++) v->start_by[i * c + i] = 1.0;
    for (int64_t i = 0; task->start_by && i < n; i++) copy(v->start_by + i * c + v->by_start, task->start_by + i * n_p, n_p);
    fill(v->sizes, 0.0, c);
    fill(v->low, INFINITY, n);
    fill(v->high, -INFINITY, n);
    v->rows = job->shooting.now.rows;
    job->rows.first = 0, job->rows.slopes = task->slopes;
    job->rows.take = task->take, job->rows.room = task->room, job->rows.number = task->number;
    note_run(job, task, run_to_end(job, pass, integrate_variations));
    task->rows = job->rows.next;
    hand_over(job);
    keep_point(job, task);
}

static void run_task(Job *job, Task *task, const Pass *pass) {
    if (task->kind == ORBIT) {
        find_orbit(job, task, pass);
        return;
    }
    task->part = start_instance(job, task, task->end);
    if (task->part) note_run(job, task, MODEL_ERROR);
    else if (task->kind == VARIED) run_varied(job, task, pass);
    else run_plain(job, task, pass);
}

void work(Pass *pass, Job *job) {
    while (!stopped(pass)) {
        const int64_t number = __atomic_fetch_add(&pass->next, 1, __ATOMIC_RELAXED);
        if (number >= pass->count) return;
        run_task(job, pass->tasks + number, pass);
        const Task *task = pass->tasks + number;
        const bool counts = task->kind == PLAIN || (task->code == DONE && task->trouble == FOUND);
        if (counts) __atomic_fetch_add(&pass->done, 1, __ATOMIC_RELEASE);
        if (job->fmu->status >= FATAL) return; /* the rest is for another instance */
    }
}
