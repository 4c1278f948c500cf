/* What a generated model gives to the runtime: sizes, tables and functions. Nothing else crosses. */
#ifndef MODEL_H
#define MODEL_H

#include <stddef.h>
#include <stdint.h>

/* Arguments of every generated function, in this order. All are arrays of double; Booleans are 0 or 1. */
enum Argument {
    ARG_T,     /* 1    time, s */
    ARG_X,     /* n_x  continuous states */
    ARG_U,     /* n_u  inputs */
    ARG_P,     /* n_p  parameters a user may set */
    ARG_C,     /* n_c  parameters calculated from p */
    ARG_D,     /* n_d  discrete variables */
    ARG_R,     /* n_r  relations, held between events */
    ARG_V,     /* n_v  values of delay() */
    ARG_Q,     /* n_q  unknowns of the non-linear blocks */
    ARG_I,     /* n_i  unknowns of initialisation */
    ARG_PRE_D, /* n_d  discrete variables before the event iteration */
    ARG_PRE_B, /* n_b  when-conditions before the event iteration */
    ARG_E,     /* 2 + n_s  initial(), terminal(), then one per sample() clock: 1 while it ticks */
    /* seeds of `forward` (a tangent of the arguments) ... */
    ARG_SEED_X, ARG_SEED_U, ARG_SEED_P, ARG_SEED_V, ARG_SEED_Q,
    /* ... and of `reverse` (weights of the results) */
    ARG_WEIGHT_DX, ARG_WEIGHT_W, ARG_WEIGHT_G,
    ARG_COUNT
};

/* A generated function: reads `arg`, writes the `res` whose pointer is not null, returns 0 or an error. Matrices are
   dense and column-major. */
typedef int ModelFunction(const double **arg, double **res);

typedef enum { VECTOR_T, VECTOR_P, VECTOR_C, VECTOR_X, VECTOR_DX, VECTOR_U, VECTOR_D, VECTOR_W } Vector;
typedef enum { TYPE_REAL, TYPE_INTEGER, TYPE_BOOLEAN } ScalarType;
typedef enum { INDEPENDENT, PARAMETER, CALCULATED_PARAMETER, INPUT, OUTPUT, LOCAL } Causality;
typedef enum { CONSTANT, FIXED, TUNABLE, DISCRETE, CONTINUOUS } Variability;
typedef enum { INITIAL_NONE, INITIAL_EXACT, INITIAL_CALCULATED } Initial;

/* The variable table; a value reference is a row number. */
typedef struct {
    const char *name;
    uint32_t index; /* within its vector */
    uint8_t vector, type, causality, variability, initial;
} ModelVariable;

/* A continuous state's own row of the variable table; others there may share its place. */
typedef struct {
    uint32_t row;
    uint8_t reinit; /* an event may change it */
} ModelState;

typedef struct {
    const char *message;
    int is_warning; /* a failed warning is logged and the run goes on */
} ModelCheck;

typedef struct {
    uint8_t strict;  /* r = z > 0, else r = z >= 0 */
    uint8_t of_time; /* changes at the time `instants` gives, no state event needed */
} ModelRelation;

typedef struct {
    const char *name;  /* Modelica class */
    const char *token; /* FMI 2 guid, FMI 3 instantiationToken */
    size_t n_x, n_u, n_p, n_c, n_d, n_r, n_v, n_q, n_i, n_b, n_s, n_w;
    size_t n_variables, n_checks, n_terminations;

    const ModelVariable *variables;
    const double *start_x, *start_u, *start_p, *start_d; /* what a new instance holds */
    const double *nominal_x;
    const ModelState *states;           /* n_x; null: only all at once can they be set after initialization */
    const ModelRelation *relations;     /* n_r */
    const ModelCheck *checks;           /* n_checks */
    const char *const *terminations;    /* n_terminations: messages */
    const char *const *unknowns;        /* n_q: names for messages, or null ... */
    const char *const *initial_unknowns; /* ... and n_i */
    const uint8_t *constrained;         /* n_q: 1 where a differentiated constraint gives it from states, or null */
    double tolerance;                   /* of the co-simulation's integrator, unless told otherwise */

    /* Functions; the comment names the results in order. A null function has no results (its n is 0). */
    ModelFunction *calculated;       /* c (n_c), from p and i */
    ModelFunction *initial_residual; /* g (n_i), dg/di (n_i x n_i), first guess of i (n_i) */
    ModelFunction *start;            /* x (n_x), d (n_d), q (n_q); reads the user's x and d, and i */
    ModelFunction *derivatives;      /* dx (n_x) */
    ModelFunction *outputs;          /* w (n_w) */
    ModelFunction *residual;         /* g (n_q), dg/dq (n_q x n_q) */
    ModelFunction *indicators;       /* z (n_r) */
    ModelFunction *instants;         /* per relation, the time of its change if of_time (n_r); sample start (n_s),
                                        sample interval (n_s) */
    ModelFunction *delays;           /* source (n_v), time (n_v), maximum (n_v) */
    ModelFunction *update;           /* d (n_d), b (n_b), x (n_x), terminations (n_terminations): 1 where one holds */
    ModelFunction *check;            /* conditions (n_checks): 1 where one holds */
    ModelFunction *jacobian;         /* d dx/dx (n_x x n_x), d dx/dq (n_x x n_q), d g/dx (n_q x n_x),
                                        d dx/dt (n_x), d g/dt (n_q), d dx/dp (n_x x n_p; c follows p; only where
                                        n_q = 0) */
    ModelFunction *forward;          /* tangents of dx (n_x), w (n_w), g (n_q); c follows p */
    ModelFunction *reverse;          /* weights of x (n_x), u (n_u), p (n_p), q (n_q), v (n_v); c follows p */
} Model;

/* The one symbol the generated file defines. */
extern const Model model;

#endif
