#include "instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "crossing.h"
#include "linearise.h"
#include "rodas.h"
#include "vector.h"

/* Hands out parts of one block; with a null base it only adds up sizes. */
typedef struct {
    char *base;
    size_t used;
} Arena;

static void *take(Arena *arena, size_t count, size_t size) {
    const size_t align = sizeof(double);
    size_t at = arena->used;
    arena->used += (count * size + align - 1) / align * align;
    return arena->base ? arena->base + at : NULL;
}

static double *doubles(Arena *arena, size_t count) { return take(arena, count, sizeof(double)); }

static size_t larger(size_t a, size_t b) { return a > b ? a : b; }

/* The saved state, in one piece. */
static void lay_out_memory(Instance *s, Arena *a) {
    const Model *m = s->model;
    size_t begin = a->used;
    s->memory = take(a, 1, sizeof *s->memory);
    s->t = doubles(a, 1);
    s->x = doubles(a, m->n_x);
    s->u = doubles(a, m->n_u);
    s->p = doubles(a, m->n_p);
    s->c = doubles(a, m->n_c);
    s->d = doubles(a, m->n_d);
    s->r = doubles(a, m->n_r);
    s->v = doubles(a, m->n_v);
    s->q = doubles(a, m->n_q);
    s->i = doubles(a, m->n_i);
    s->pre_d = doubles(a, m->n_d);
    s->pre_b = doubles(a, m->n_b);
    s->e = doubles(a, 2 + m->n_s);
    s->user_x = doubles(a, m->n_x);
    s->user_d = doubles(a, m->n_d);
    s->z_scale = doubles(a, m->n_r);
    s->warned = doubles(a, m->n_checks);
    s->delays = take(a, m->n_v, sizeof *s->delays);
    s->delay_times = doubles(a, m->n_v * DELAY_CAPACITY);
    s->delay_values = doubles(a, m->n_v * DELAY_CAPACITY);
    s->memory_size = a->used - begin;
}

static void lay_out_newton(Instance *s, Arena *a) {
    NewtonWork *n = &s->newton;
    size_t size = larger(s->model->n_q, s->model->n_i);
    n->residual = doubles(a, size);
    n->jacobian = doubles(a, size * size);
    n->step = doubles(a, size);
    n->previous = doubles(a, size);
    n->start = doubles(a, size);
    n->pivot = take(a, size, sizeof(int));
}

static void lay_out_integrator(Instance *s, Arena *a) {
    IntegratorWork *w = &s->integrator;
    size_t n_x = s->interface == CO_SIMULATION ? s->model->n_x : 0;
    size_t n_q = s->interface == CO_SIMULATION ? s->model->n_q : 0;
    w->x_start = doubles(a, n_x);
    w->x_end = doubles(a, n_x);
    w->x_stage = doubles(a, n_x);
    w->rate = doubles(a, n_x);
    w->stages = doubles(a, n_x * RODAS_STAGES);
    w->iteration = doubles(a, n_x * n_x);
    w->dg_dt = doubles(a, n_q);
    w->pivot_x = take(a, n_x, sizeof(int));
    w->z_before = doubles(a, s->model->n_r);
    w->z_after = doubles(a, s->model->n_r);
    w->z_between = doubles(a, s->model->n_r);
    w->z_looks = doubles(a, s->model->n_r * (CROSSING_LOOKS + 1));
    s->backup = s->interface == CO_SIMULATION ? take(a, s->memory_size, 1) : NULL;
}

static void lay_out_events(Instance *s, Arena *a) {
    const Model *m = s->model;
    EventWork *w = &s->event;
    w->d = doubles(a, m->n_d);
    w->b = doubles(a, m->n_b);
    w->x = doubles(a, m->n_x);
    w->terminations = doubles(a, m->n_terminations);
    w->checks = doubles(a, m->n_checks);
    w->instants = doubles(a, m->n_r);
    w->sample_start = doubles(a, m->n_s);
    w->sample_interval = doubles(a, m->n_s);
    w->delay_source = doubles(a, m->n_v);
    w->delay_time = doubles(a, m->n_v);
    w->delay_maximum = doubles(a, m->n_v);
    w->old_v = doubles(a, m->n_v);
    w->indicators = doubles(a, m->n_r);
}

static void lay_out_derivatives(Instance *s, Arena *a) {
    const Model *m = s->model;
    DerivativeWork *w = &s->derivative;
    w->seed_x = doubles(a, m->n_x);
    w->seed_u = doubles(a, m->n_u);
    w->seed_p = doubles(a, m->n_p);
    w->seed_v = doubles(a, m->n_v);
    w->seed_q = doubles(a, m->n_q);
    w->weight_dx = doubles(a, m->n_x);
    w->weight_w = doubles(a, m->n_w);
    w->weight_g = doubles(a, m->n_q);
    w->out_dx = doubles(a, m->n_x);
    w->out_w = doubles(a, m->n_w);
    w->out_g = doubles(a, m->n_q);
    w->out_x = doubles(a, m->n_x);
    w->out_u = doubles(a, m->n_u);
    w->out_p = doubles(a, m->n_p);
    w->out_q = doubles(a, m->n_q);
    w->out_v = doubles(a, m->n_v);
}

static void lay_out_jacobian(Instance *s, Arena *a) {
    const size_t n_x = s->model->n_x, n_q = s->model->n_q;
    JacobianWork *w = &s->jacobian;
    w->xx = doubles(a, n_x * n_x);
    w->xq = doubles(a, n_x * n_q);
    w->xp = doubles(a, has_by_parameters(s->model) ? n_x * s->model->n_p : 0);
    w->qx = doubles(a, n_q * n_x);
    w->qq = doubles(a, n_q * n_q);
    w->pivot = take(a, n_q, sizeof(int));
}

static void lay_out(Instance *s, Arena *a) {
    const Model *m = s->model;
    lay_out_memory(s, a);
    s->dx = doubles(a, m->n_x);
    s->w = doubles(a, m->n_w);
    s->z = doubles(a, m->n_r);
    s->state_relations = take(a, m->n_r, sizeof(size_t));
    lay_out_newton(s, a);
    lay_out_integrator(s, a);
    lay_out_events(s, a);
    lay_out_derivatives(s, a);
    lay_out_jacobian(s, a);
}

static void point_arguments(Instance *s) {
    const DerivativeWork *w = &s->derivative;
    const double *const argument[ARG_COUNT] = {
        [ARG_T] = s->t,
        [ARG_X] = s->x,
        [ARG_U] = s->u,
        [ARG_P] = s->p,
        [ARG_C] = s->c,
        [ARG_D] = s->d,
        [ARG_R] = s->r,
        [ARG_V] = s->v,
        [ARG_Q] = s->q,
        [ARG_I] = s->i,
        [ARG_PRE_D] = s->pre_d,
        [ARG_PRE_B] = s->pre_b,
        [ARG_E] = s->e,
        [ARG_SEED_X] = w->seed_x,
        [ARG_SEED_U] = w->seed_u,
        [ARG_SEED_P] = w->seed_p,
        [ARG_SEED_V] = w->seed_v,
        [ARG_SEED_Q] = w->seed_q,
        [ARG_WEIGHT_DX] = w->weight_dx,
        [ARG_WEIGHT_W] = w->weight_w,
        [ARG_WEIGHT_G] = w->weight_g,
    };
    memcpy(s->arg, argument, sizeof argument);
}

static void list_state_relations(Instance *s) {
    s->n_state_relations = 0;
    for (size_t k = 0; k < s->model->n_r; k++)
        if (!s->model->relations[k].of_time) s->state_relations[s->n_state_relations++] = k;
}

void instance_reset(Instance *s) {
    const Model *m = s->model;
    memset(s->memory, 0, s->memory_size);
    s->memory->stop_time = INFINITY;
    s->memory->tolerance = m->tolerance;
    copy(s->x, m->start_x, m->n_x);
    copy(s->u, m->start_u, m->n_u);
    copy(s->p, m->start_p, m->n_p);
    copy(s->d, m->start_d, m->n_d);
    copy(s->user_x, m->start_x, m->n_x);
    copy(s->user_d, m->start_d, m->n_d);
    copy(s->pre_d, m->start_d, m->n_d);
    set_phase(s, PHASE_INSTANTIATED);
}

Instance *instance_new(const Model *m, Interface interface) {
    Instance sizes = {.model = m, .interface = interface};
    Arena arena = {NULL, 0};
    (void)take(&arena, 1, sizeof(Instance));
    lay_out(&sizes, &arena);

    Instance *s = calloc(1, arena.used);
    if (!s) return NULL;
    s->model = m;
    s->interface = interface;
    arena = (Arena){(char *)s, 0};
    (void)take(&arena, 1, sizeof(Instance));
    lay_out(s, &arena);
    point_arguments(s);
    list_state_relations(s);
    instance_reset(s);
    return s;
}

void instance_free(Instance *s) {
    if (!s) return;
    free(s->log.instance_name);
    free(s->front);
    free(s);
}

static const char *phase_name(uint32_t phase) {
    switch (phase) {
        case PHASE_INSTANTIATED: return "instantiated";
        case PHASE_INITIALIZATION: return "initialization mode";
        case PHASE_EVENT: return "event mode";
        case PHASE_CONTINUOUS: return "continuous-time mode";
        case PHASE_STEP: return "step mode";
        case PHASE_STEP_FAILED: return "step discarded";
        case PHASE_INTERMEDIATE: return "intermediate update mode";
        case PHASE_TERMINATED: return "terminated";
        default: return "error";
    }
}

bool instance_refuse(Instance *s, const char *function) {
    log_message(s, LOG_ERROR, "%s: not allowed in state \"%s\".", function, phase_name(s->memory->phase));
    return false;
}

bool instance_no_null(Instance *s, const char *function, const void *pointer) {
    if (pointer) return true;
    log_message(s, LOG_ERROR, "%s: a pointer is null.", function);
    return false;
}

bool instance_is_array(Instance *s, const char *function, const void *array, size_t n, size_t expected) {
    if (n == expected) return n == 0 || instance_no_null(s, function, array);
    log_message(s, LOG_ERROR, "%s: %zu values were given, but there are %zu.", function, n, expected);
    return false;
}
