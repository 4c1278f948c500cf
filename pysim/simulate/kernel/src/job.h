/* What a run is, as data. Python reads this file too (layout.py): every field is 8 bytes wide, one on a line, and an
   address is that of the first of the items that the comment counts. All memory belongs to whoever made the job.

   n states, m event indicators, s stages of the method, d coefficients of its interpolant, c columns of derivatives. */
#ifndef JOB_H
#define JOB_H

#include <stddef.h>
#include <stdint.h>

#include "rows.h"

typedef void Function(void); /* a function of the FMU; fmi.c knows how each is called */
typedef void Take(int64_t number, int64_t first, int64_t count); /* rows of a task from the row `first` on are in memory */

/* The numbers of fmi2Status and fmi3Status, as far as they agree and matter. */
enum { OK, WARNING, DISCARD, ERROR, FATAL };

/* How a run stands: in the order of pysim.types.Outcome, or still running, or at an event that is not differentiated. */
enum { RUNNING = -1, DONE, STEP_TOO_SMALL, NOT_FINITE, MODEL_ERROR, TERMINATED, TOO_MANY_STEPS, TOO_MANY_EVENTS, EVENT = 100 };

/* Parts of a run's life ahead of its first step, for a message. Python adds two of its own: a worker process that ended,
   and one that gave no answer. */
enum { PART_NONE, PART_INSTANTIATE, PART_SET, PART_ENTER, PART_EXIT };

/* How a search for a periodic orbit ended. */
enum { FOUND, STOPPED_SEARCH, MET_EVENT, RUN_FAILED, NOT_CONVERGED, DRIFTS };

enum { EXPLICIT, ROSENBROCK, ESDIRK };

/* How a variable lies in memory. */
enum { KIND_DOUBLE, KIND_SINGLE, KIND_INT, KIND_LONG, KIND_OCTET,
       KIND_INT8, KIND_UINT8, KIND_INT16, KIND_UINT16, KIND_UINT32, KIND_UINT64 };

/* How a recorded variable depends on the states, where it is none of them. */
enum { ASKED = -1, FIXED = -2 }; /* the FMU is asked; it does not */

/* What an FMU says through its logger: the last LINES messages that do not say that all is well. */
enum { LINES = 20, LINE_LENGTH = 1024 };
typedef struct {
    int64_t count; /* of messages since the log was emptied */
    char *lines;   /* (LINES, LINE_LENGTH) each ends with a zero; message i is line i modulo LINES */
} Log;

/* The functions of one instance, and how to make another in its place. */
typedef struct {
    int64_t version; /* 2 | 3 */
    void *instance;  /* null where there is none */
    int64_t needs_completed_step;
    int64_t status;       /* worst of the run; after FATAL nothing of the instance may be called any more */
    int64_t refuses_reset; /* 1: it has to be instantiated anew for each run */
    const char *name;
    const char *token;
    const char *resources;
    void *callbacks; /* FMI 2: fmi2CallbackFunctions, of which this is the address */
    Log *log;
    Function *instantiate;
    Function *free_instance;
    Function *reset;
    Function *setup_experiment; /* FMI 2 */
    Function *enter_initialisation;
    Function *exit_initialisation;
    Function *set_time;
    Function *set_states;
    Function *get_states;
    Function *get_nominals;
    Function *get_derivatives;
    Function *get_indicators;
    Function *set_reals;
    Function *get_directional;
    Function *get_matrices; /* of our own FMUs, not of the standard: all partial derivatives at once; else null */
    Function *completed_step;
    Function *enter_event_mode;
    Function *update_discrete;
    Function *enter_continuous_mode;
    /* What the FMU asked for after the last step or event. */
    int64_t again; /* another round of the event iteration */
    int64_t event; /* event mode */
    int64_t terminate;
    int64_t nominals_changed;
    int64_t states_changed;
    double next_time; /* of its next time event, s; infinite where there is none */
} Fmu;

/* Coefficients of a method; method.py says what they mean. */
typedef struct {
    int64_t family;
    int64_t stages;
    int64_t terms; /* d */
    double error_order;
    int64_t end_in_error; /* 1: an attempt fills dx_new itself */
    double gamma;
    const double *a;        /* (s, s) */
    const double *b;        /* (s,) */
    const double *c;        /* (s,) */
    const double *error;    /* (s + 1,) */
    const double *dense;    /* (s + 1, d) */
    const double *coupling; /* (s, s) */
    const double *slope;    /* (s,) */
    const double *predict;  /* (s, s) */
} Method;

/* Step rule: the part of a solver's settings that every method shares. */
typedef struct {
    double step; /* s, fixed step; 0 where the error rules */
    double rtol; /* tolerated error of a step, of a state's magnitude */
    double atol; /* the same, of a state's nominal value */
    double max_step; /* s */
    int64_t max_steps;
} Control;

/* Input i follows signal i, or its rate. Piece k of a signal is a cubic and some sines of the time since it began. */
typedef struct {
    int64_t count; /* n_u */
    const uint32_t *references; /* (n_u,) */
    const int64_t *rate;   /* (n_u,) 1 for the rate */
    const int64_t *pieces; /* (n_u + 1,) signal i owns the pieces pieces[i] to pieces[i + 1] - 1 */
    const double *starts;  /* (n_k,) s */
    const double *cubics;  /* (n_k, 4) */
    const int64_t *waves;  /* (n_k + 1,) piece k owns the sines waves[k] to waves[k + 1] - 1 */
    const double *sines;   /* (n_s, 4) amplitude, phase, angular frequency, its rate */
    int64_t *cursor;       /* (n_u,) piece in force */
    double *values;        /* (n_u,) */
} Inputs;

/* Where integration restarts because an input is not smooth. */
typedef struct {
    int64_t count; /* n_b */
    const double *times;  /* (n_b,) s, increasing; the last one is the end of the run */
    const int64_t *jumps; /* (n_b,) 1 where a value jumps, which is an event */
} Breaks;

/* Where a run stands. */
typedef struct {
    double start; /* s */
    double end;   /* s */
    double t;     /* s, last accepted point */
    double h;     /* s, step to try next */
    double error_before; /* norm of the last accepted step */
    int64_t grid;    /* fixed step: number of the last grid point reached */
    int64_t segment; /* number of the next break; -1 before the run has begun */
    double horizon;  /* s, time of that break: inputs are smooth up to here */
    double inputs_at;  /* s, of the values that the FMU has; NaN where it has none of this segment */
    double next_event; /* s, the model's next time event */
    double offset_at;  /* s, when the states are offset, at a break; NaN: never */
    const double *offset; /* (n,) what is added to them */
    double leaves;     /* s, time events from here on are left to who drives the run */
    int64_t status;    /* worst status of an FMI function so far */
    int64_t crowd;     /* events since time last moved on */
    double jacobian_at; /* s, where the Jacobian was taken; NaN where it was not */
    double matrix_step; /* s, step for which it was factorised; 0 where it was not */
    int64_t is_sparse;  /* 1: the factors last made are the sparse ones */
    int64_t has_tried;  /* 1: sparse factors were tried and found good */
    int64_t looked;    /* steps when the pace was looked at last ... */
    double looked_at;  /* s, ... and where the run was then */
    int64_t steps;
    int64_t rejected;
    int64_t derivatives;
    int64_t jacobians;
    int64_t events;
} Run;

/* Partial derivatives of unknowns by knowns, a directional derivative for each group of knowns of which no unknown depends
   on two (Curtis, Powell, Reid 1974). */
typedef struct {
    int64_t groups;
    const int64_t *first_known; /* (groups + 1,) group g seeds the knowns first_known[g] to first_known[g + 1] - 1 */
    const uint32_t *knowns;     /* references */
    const int64_t *first_entry; /* (groups + 1,) and yields the entries first_entry[g] to first_entry[g + 1] - 1 */
    const uint32_t *unknowns;   /* references, one per entry */
    const int64_t *places;      /* in the matrix, one per entry */
    double *column;             /* the entries of a group */
    const double *ones;         /* seeds, as many as any group has */
} Partials;

/* Entry `target` loses the product of two others. */
typedef struct {
    uint32_t target, weight, source, unused;
} Operation;

/* Memory of the solver, and the structure of the Jacobian. */
typedef struct {
    int64_t n;
    int64_t m;
    const RowSums *sums; /* as this processor does them best */
    double *scratch; /* (scratch_size,) what must not tell a run of the one before, in one piece */
    int64_t scratch_size;
    double *x;       /* (n,) at run.t */
    double *dx;      /* (n,) derivative there */
    double *x_new;   /* (n,) at the end of the step */
    double *dx_new;  /* (n,) derivative there: the last row of k */
    double *x_try;   /* (n,) where a stage or an interpolation looks */
    double *k;       /* (s + 1, n) stages */
    double *error;   /* (n,) */
    double *dense;   /* (d, n) coefficients of theta, theta^2, ... */
    double *nominal; /* (n,) */
    double *z;       /* (m,) event indicators at run.t */
    double *z_new;   /* (m,) at the end of the step */
    double *z_try;   /* (m,) */
    double *z_low;   /* (m,) at the lower end of a search */
    double *jacobian; /* (n, n) row j: derivatives by state j */
    double *matrix;   /* (n, n) factorised */
    int64_t *pivots;  /* (n,) */
    double *slope;    /* (n,) partial derivative of dx by time */
    double *stages;   /* (s, n) states of the stages, where those are unknowns */
    double *right;    /* (n,) what is known of such a stage */
    int64_t has_directional;
    const Partials *by_states; /* of the derivatives, into `jacobian` */
    /* Sparse elimination: entries (n_e,) row after row, rows and columns in the order of elimination. */
    int64_t sparse;  /* 0: dense elimination only, and nothing of what follows */
    int64_t entries; /* n_e */
    const int64_t *sources;   /* (n_e,) place in `jacobian` */
    const int64_t *states;    /* (n,) state of a row */
    const int64_t *row_first; /* (n + 1,) row r owns the entries row_first[r] to row_first[r + 1] - 1 */
    const int64_t *diagonal;  /* (n,) entry on the diagonal */
    const int64_t *places;    /* (n_e,) column */
    const int64_t *columns;   /* (n_e,) state of the column */
    const int64_t *operation_first; /* (n + 1,) row r is made by the operations operation_first[r] to ...[r + 1] - 1 */
    const Operation *operations;
    double *factors;      /* (n, n), of which the first n_e are used */
    double *pivot_values; /* (n,) */
    double *tried_pivots; /* (n,) of the factors last tried */
    double *probe;        /* (n,) */
    double *magnitude;    /* (n,) */
} Work;

/* Variables that are read or set together: in groups of one type, in one call each. */
typedef struct {
    int64_t groups; /* n_g */
    Function **functions; /* (n_g,) getters or setters */
    const int64_t *kinds; /* (n_g,) */
    const int64_t *first; /* (n_g + 1,) group g owns the entries first[g] to first[g + 1] - 1 of the next two */
    const uint32_t *references; /* (n_y,) */
    const int64_t *places; /* (n_y,) place among the values */
} Access;

/* What is recorded. */
typedef struct {
    int64_t count; /* n_t */
    int64_t next;  /* row to record next */
    const double *times; /* (n_t,) s */
    double *values;      /* (n_t, n_y) */
    int64_t columns;     /* n_y */
    int64_t first;       /* row that is the first in `values`: those before it were handed over */
    int64_t room;        /* rows that are handed over at a time */
    int64_t number;      /* of the task, for take */
    Function *take;      /* Take, which is given the rows; null: they stay, all of them */
    double *slopes;      /* (n_t or room, n_y, columns that are asked for) of the rows in memory, once they are handed over */
    const Access *access;
    const Access *set; /* start values, ahead of initialisation */
    void *buffer; /* of 8 bytes for each recorded variable and for each start value */
} Rows;

/* Derivatives: c columns, first those of the start states (n or none), then one per parameter, then zeros up to a
   multiple of COLUMNS. */
enum { COLUMNS = 4 };
typedef struct {
    int64_t columns;    /* c */
    int64_t by_start;   /* columns of start states, or of the offset of the states: n or 0 */
    int64_t from_start; /* 1: those of start states */
    int64_t parameters; /* n_p */
    int64_t rewind;     /* 1: the FMU is in continuous-time mode already */
    int64_t through;    /* 1: goes on at events that change neither a state nor its derivative */
    const double *start;    /* (n,) states to start from; null: those of the FMU */
    double *start_by;       /* (n, c) their derivatives */
    const Partials *by_parameters; /* of the derivatives, into `forcing`; a start value is in no equation */
    int64_t entries;               /* of those that may differ from zero */
    const int64_t *forcing_targets; /* (entries,) place of each in (n, c) */
    const int64_t *columns_of;      /* (n_p,) column of get_matrices, -1 for a start value; null: the FMU is asked */
    double *s;      /* (n, c) at run.t */
    double *k;      /* (s, n, c) */
    double *right;  /* (n, c) */
    double *inside; /* (n, c) within a step */
    double *weights; /* (s,) */
    double tolerance; /* tolerated error of a step in a column of S, of the column's largest size so far */
    double *error;   /* (n, c) */
    double *sizes;   /* (c,) those sizes */
    double *forcing; /* (n_p, n) F */
    double *rows;    /* (n_t, n_y, c) derivatives of what is recorded */
    const int64_t *kinds; /* (n_y,) number of the state that a variable is, or ASKED or FIXED */
    const double *fixed;  /* (n_y, c) derivatives of those that no state moves */
    const Partials *of_outputs; /* of the others, into `gradient` */
    int64_t slopes;             /* entries of that */
    const int64_t *slope_rows;    /* (slopes,) number of the recorded variable */
    const int64_t *slope_columns; /* (slopes,) number of the state, or n + that of the parameter */
    double *gradient;             /* (slopes,) */
    double *low;  /* (n,) least and */
    double *high; /* (n,) largest value of each state so far */
} Variation;

/* One period from some states, and what brings them back to themselves. */
typedef struct {
    double *values; /* (n_t, n_y) */
    double *rows;   /* (n_t, n_y, c) */
    double *start;  /* (n,) where it began */
    double *solved; /* (n, 1 + n_p) Newton correction of the start; derivative of the periodic states by the parameters */
    double *jumps;  /* (n,) by how much the choice of the integration's steps may move `step`, at least */
    double mismatch; /* largest entry of `step`, in amplitudes of the orbit */
    double drift;    /* largest mismatch, in amplitudes, that no correction can remove */
    int64_t steps;
    int64_t rejected;
    int64_t derivatives;
    int64_t jacobians;
    int64_t events;
} Shot;

/* Memory of a search for a periodic orbit. */
typedef struct {
    Shot now;
    Shot before;
    double *guess;   /* (n,) */
    double *scale;   /* (n,) amplitudes, but no less than what the integration leaves open */
    double *matrix;  /* (n, n) */
    double *factors; /* (n, n) */
    double *inverse; /* (n, n) */
    double *right;   /* (n, 1 + n_p) */
    double *sum;     /* (1 + n_p,) */
    int64_t *pivots; /* (n,) */
} Shooting;

/* What is to be run, and what comes of it. */
enum { PLAIN, VARIED, ORBIT };
typedef struct {
    int64_t kind;
    double start; /* s */
    double end;   /* s */
    const double *set_values; /* start values, ahead of initialisation */
    Inputs inputs;
    Breaks breaks;
    const double *times; /* (n_t,) s */
    int64_t count;       /* n_t */
    const double *states;   /* (n,) to start from, for an orbit a guess; null: those of the FMU */
    const double *start_by; /* (n, n_p) derivatives of the start; null: none */
    double offset_at;       /* s, when the states are offset; NaN: never */
    const double *offset;   /* (n,) */
    double settling;        /* s, end of the run that makes a guess ... */
    Breaks settling_breaks; /* ... and the breaks of its inputs */
    double mismatch;        /* largest correction of an orbit, in amplitudes, that is left to first order */
    /* Found. */
    double *values;   /* (n_t, n_y), or (room, n_y) where rows are handed over */
    double *slopes;   /* (n_t, n_y, n_p) likewise, ahead of them n columns of an offset if that is a direction */
    int64_t room;     /* rows that are handed over at a time */
    int64_t number;   /* of the task, for take */
    Function *take;   /* as in Rows */
    double *state;    /* (n,) at the end, or at phase zero of the orbit */
    double *state_by; /* (n, n_p) */
    double *rates;    /* (n,) derivative at the end, or null, as the next two */
    double *jacobian; /* (n, n) row j: by state j */
    double *forcing;  /* (n_p, n) */
    double *low;      /* (n,) least and */
    double *high;     /* (n,) largest value of each state */
    double *nominal;  /* (n,) */
    int64_t code;  /* how the run ended */
    int64_t part;  /* what failed ahead of it */
    int64_t trouble; /* how the search for an orbit ended */
    int64_t iterations; /* periods of an orbit */
    double correction;  /* of an orbit, in amplitudes */
    int64_t rows;   /* recorded */
    int64_t status; /* worst of the run */
    double reached; /* s */
    int64_t steps;
    int64_t rejected;
    int64_t derivatives;
    int64_t jacobians;
    int64_t events;
    char *text; /* (LINES, LINE_LENGTH) what the FMU said, where the run failed; null: not wanted */
} Task;

/* Tasks that threads share. */
typedef struct {
    Task *tasks; /* (count,) */
    int64_t count;
    int64_t next; /* to be begun; threads count it up */
    int64_t done; /* the same; with derivatives only what came to its end */
    int64_t stop; /* 1: no more steps */
} Pass;

typedef struct {
    Fmu *fmu;
    Method method;
    Control control;
    Inputs inputs;
    Breaks breaks;
    Run run;
    Work work;
    Rows rows;
    Variation variation;
    Shooting shooting;
} Job;

#endif
