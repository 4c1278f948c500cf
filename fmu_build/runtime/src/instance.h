/* One instance of the model: where its values live. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include <stdbool.h>

#include "log.h"
#include "model.h"

/* Results of every function; the numbers are those of fmi2Status and fmi3Status. */
typedef enum { STATUS_OK, STATUS_WARNING, STATUS_DISCARD, STATUS_ERROR } Status;

/* The states of FMI's state machines; one bit each, so that a set of them is a mask. */
typedef enum {
    PHASE_INSTANTIATED = 1 << 0,
    PHASE_INITIALIZATION = 1 << 1,
    PHASE_EVENT = 1 << 2,
    PHASE_CONTINUOUS = 1 << 3,    /* model exchange, between events */
    PHASE_STEP = 1 << 4,          /* co-simulation, between steps */
    PHASE_STEP_FAILED = 1 << 5,   /* FMI 2 co-simulation, after a discarded step */
    PHASE_INTERMEDIATE = 1 << 6,  /* FMI 3 co-simulation, inside the intermediate update */
    PHASE_TERMINATED = 1 << 7,
    PHASE_FAILED = 1 << 8
} Phase;

typedef enum { MODEL_EXCHANGE, CO_SIMULATION } Interface;

/* Which computed values belong to the present arguments. */
typedef enum {
    HAS_START = 1 << 0, /* the initial problem is solved (initialization phase only) */
    HAS_C = 1 << 1,
    HAS_V = 1 << 2,
    HAS_Q = 1 << 3,
    HAS_DX = 1 << 4,
    HAS_W = 1 << 5,
    HAS_Z = 1 << 6,
    HAS_JACOBIAN = 1 << 7,
    HAS_BY_PARAMETERS = 1 << 8
} Computed;

/* One delay(): its history lies in a ring of DELAY_CAPACITY points. */
enum { DELAY_CAPACITY = 1024 };

typedef struct {
    double time, maximum; /* arguments of delay(), s */
    double passed;        /* last break of the history that the delayed value has gone past ... */
    double limit;         /* ... and the next one, where it stops until an event; infinite if there is none */
    uint32_t first, count;
} DelayState;

/* The part of an instance that a saved state holds: this head, then the vectors, then the histories. */
typedef struct {
    double start_time, stop_time; /* s; stop_time is infinite unless defined */
    double tolerance;
    double step_size;        /* the integrator's proposal for its next step, s; 0: none yet */
    double accepted_step, accepted_error; /* of the last step, s and in units of the tolerance; 0: none yet */
    double last_event_time;  /* s; events up to here are done */
    double next_event_time;  /* s; the next time event */
    uint32_t phase;          /* Phase */
    uint32_t computed;       /* set of Computed */
    uint32_t is_terminated;  /* the model asked for the end */
    uint32_t is_disturbed;   /* an input or parameter was set since the last event iteration */
} Memory;

/* Work space of one Newton iteration, for the larger of n_q and n_i. */
typedef struct {
    double *residual, *jacobian, *step, *previous, *start;
    int *pivot;
    /* After a failure: what the equations do at which unknown, and its value there. */
    const char *objection;
    size_t culprit;
    double value;
} NewtonWork;

/* Work space of the co-simulation's integrator. */
typedef struct {
    double begin, end;                       /* of the step, s */
    double least_for_delay;                  /* s: a shorter delay does not shorten a step, and is interpolated in it */
    double *x_start, *x_end, *x_stage;       /* n_x */
    double *stages;                          /* n_x for each stage of the method */
    double *rate, *dg_dt;                    /* df/dt (n_x), dg/dt (n_q) */
    double *iteration;                       /* n_x x n_x */
    int *pivot_x;
    double *z_before, *z_after, *z_between;  /* event indicators (n_r) while a crossing is searched for */
    double *z_looks;                         /* those at CROSSING_LOOKS + 1 points of the step */
} IntegratorWork;

/* Work space of the event iteration. */
typedef struct {
    double *d, *b, *x, *terminations, *checks, *instants, *sample_start, *sample_interval;
    double *delay_source, *delay_time, *delay_maximum, *old_v, *indicators;
} EventWork;

/* Seeds and results of directional derivatives. */
typedef struct {
    double *seed_x, *seed_u, *seed_p, *seed_v, *seed_q, *weight_dx, *weight_w, *weight_g;
    double *out_dx, *out_w, *out_g, *out_x, *out_u, *out_p, *out_q, *out_v;
} DerivativeWork;

/* Partial derivatives at one point, column-major: of the derivatives by x, while q follows, by q, and by p where there is
   no q; of the residuals g by x, turned into -dq/dx, and by q, factored. */
typedef struct {
    double *xx, *xq, *xp, *qx, *qq;
    int *pivot;
} JacobianWork;

typedef struct Instance Instance;

/* FMI 3: called after each internal step; returns true and a time to stop the communication step there. */
typedef bool IntermediateUpdate(Instance *s, double time, double *return_time);

struct Instance {
    const Model *model;
    Interface interface;
    Log log;

    /* Saved state. */
    Memory *memory;
    size_t memory_size; /* bytes, with all that follows in this group */
    double *t, *x, *u, *p, *c, *d, *r, *v, *q, *i, *pre_d, *pre_b, *e;
    double *user_x, *user_d; /* start values as the user set them; the initial problem reads these */
    double *z_scale;         /* largest value each event indicator has shown */
    double *warned;          /* checks that failed when last looked at */
    DelayState *delays;
    double *delay_times, *delay_values; /* n_v histories of DELAY_CAPACITY */

    /* Computed from the above. */
    double *dx, *w, *z;

    const double *arg[ARG_COUNT];
    size_t n_state_relations;
    size_t *state_relations; /* relations with an event indicator */
    NewtonWork newton;
    IntegratorWork integrator;
    EventWork event;
    DerivativeWork derivative;
    JacobianWork jacobian;
    char *backup; /* memory before a communication step */

    /* Co-simulation, FMI 3. */
    bool event_mode_used, early_return_allowed;
    IntermediateUpdate *intermediate_update; /* or null */
    void *front;                             /* what the FMI front end keeps for its callbacks */
};

/* A new instance in PHASE_INSTANTIATED with the model's start values, or null if memory is short. */
Instance *instance_new(const Model *m, Interface interface);
void instance_free(Instance *s);

/* Back to what instance_new gave; the log settings stay. */
void instance_reset(Instance *s);

/* Logs a call that is illegal in the present phase; false. */
bool instance_refuse(Instance *s, const char *function);

/* True if the instance is in one of `phases`; else logs the illegal call. */
static inline bool instance_in_phase(Instance *s, unsigned phases, const char *function) {
    return (s->memory->phase & phases) != 0 || instance_refuse(s, function);
}

/* False, logged, if the pointer is null. */
bool instance_no_null(Instance *s, const char *function, const void *pointer);

/* False, logged, if the array has not the expected length, or is null though it has elements. */
bool instance_is_array(Instance *s, const char *function, const void *array, size_t n, size_t expected);

static inline void set_phase(Instance *s, Phase phase) { s->memory->phase = (uint32_t)phase; }

/* Calls a generated function whose results are `res`. */
static inline Status call_model(Instance *s, ModelFunction *function, double **res) {
    return !function || function(s->arg, res) == 0 ? STATUS_OK : STATUS_DISCARD;
}

#endif
