/* The parts of the kernel, from the smallest outwards. A function that returns an int returns the worst FMI status, or
   how the run stands where its comment says so. */
#ifndef KERNEL_H
#define KERNEL_H

#include "fmi.h"
#include "job.h"
#include "numbers.h"

/* inputs.c: every driven input to its value at t (s), to the left of whatever happens at the horizon. */
int set_inputs(Job *job, double t);

/* point.c: the model as a function. */
int set_point(Job *job, double t, const double *x);
int evaluate(Job *job, double t, const double *x, double *dx);
/* Root mean square of n values over what is tolerated between the states x and y; 1 is just accepted. */
double error_norm(const Job *job, const double *values, const double *x, const double *y);

/* dense.c: systems of columns, by elimination with row pivoting. False if the matrix is singular or not finite. */
bool dense_factorise(double *matrix, int64_t *pivots, int64_t n);
void dense_solve(const double *matrix, const int64_t *pivots, double *right, int64_t n);
void dense_solve_rows(const double *matrix, const int64_t *pivots, double *right, int64_t n, int64_t width,
                      const RowSums *sums);

/* sparse.c: shift I - J with J in work.jacobian; false if it is singular or not finite. */
bool factorise_shifted(Job *job, double shift);
void solve_shifted(Job *job, double *right);                   /* (n,) becomes the solution */
void solve_shifted_rows(Job *job, double *right, int64_t width); /* (n, width), a multiple of COLUMNS */

/* jacobian.c: fills work.jacobian at t (s) and the states x; the FMU is left at that point only where it offers
   directional derivatives, and without them work.error and slope change. Other partials are those at the point last
   set. */
int take_jacobian(Job *job, double t, const double *x);
int take_jacobian_and_forcing(Job *job, double t, const double *x); /* F = df/dp into variation.forcing as well */
int take_partials(const Job *job, const Partials *partials, double *matrix);

/* explicit.c, rosenbrock.c, esdirk.c: one step of length h (s) from run.t fills k and x_new; the norm of its error. */
int attempt_explicit(Job *job, double h, double *error);
int attempt_rosenbrock(Job *job, double h, double *error);
int attempt_esdirk(Job *job, double h, double *error);
void combine(Job *job, const double *weights, int64_t count, double scale, double *result); /* x + scale sum w_i k_i */
void estimate(Job *job, int64_t count, double scale); /* work.error = scale sum error_i k_i */
/* Coefficients of the interpolant over the step just taken, and the states in it, at the share theta, into x_try. */
void dense_coefficients(Job *job, double h);
void interpolate(Job *job, double theta);

/* stepping.c: attempts until a step is accepted; RUNNING or the outcome, the step's length and the time of its end. */
int accepted_step(Job *job, double target, double *h, double *t_new);
double first_step(Job *job);
double next_time_event(const Job *job); /* s; infinite where it is left to who drives the run */
double next_target(Job *job);           /* s, that the next step must not pass */

/* record.c: rows at the requested times. */
int read_row(Job *job);
int record_inside(Job *job, double h, double t_end);
int record_here(Job *job);
void hand_over(Job *job); /* of a run with derivatives */

/* events.c. settle and handle_event: RUNNING, or the outcome if the run ends there. */
bool crossed(const Job *job, const double *before, const double *after);
int locate(Job *job, double h, double *theta);
int settle(Job *job);
int handle_event(Job *job);
/* Makes t_new (s) the time; where it truly moves on, no crowd of events is left behind. */
void move_time(Run *run, double t_new);

/* run.c: breaks of the inputs, and the end of a run. */
bool at_break(const Job *job);
void next_segment(Job *job);
int ended(Job *job);
/* Adds the offset to the states where its time has come; whether it had. The model takes it as an event. */
bool offset_here(Job *job);

/* At most `budget` accepted steps of a run; RUNNING or how it ended. */
int integrate(Job *job, int64_t budget);
int resume(Job *job); /* begin afresh at run.t, where something changed */

/* variation.c: derivatives of the steps, next to the steps. */
int begin_variation(Job *job);
int vary_step(Job *job, double h);
double variation_error(Job *job, double h);
void note_range(Job *job);
void end_variation(Job *job);
void vary_inside(Job *job, double theta, double h, double *target);
int record_variation(Job *job, int64_t row, const double *s);

/* start.c: values ahead of initialisation, with a buffer of 8 bytes for each; initialisation mode, without a tolerance
   where that is 0. */
int set_values(const Fmu *fmu, const Access *access, const double *values, void *buffer);
int enter_initialisation(Fmu *fmu, double tolerance, double start, double stop);

/* An instance as new, set and initialised, in event mode; 0 or the part that failed. Then a run that has not
   begun, from start to end (s). */
int start_instance(Job *job, const Task *task, double end);
void fresh_run(Job *job, double start, double end);

/* small.c: the solution (n, m) of A y = right (n, m), A column after column in work space that it uses up. A direction
   that A shortens to less than `least`, of the longest or of 1, counts as lost: the solution has no part in it, and
   `left` is the largest entry of the first column that is left over. */
void solve_least(Shooting *s, double *solved, int64_t n, int64_t m, double least, double *left, const RowSums *sums);

/* shooting.c: a periodic orbit. tasks.c: runs a task, all that are left of a pass; and one run to its end, with or
   without derivatives, unless the pass is to stop. */
void find_orbit(Job *job, Task *task, const Pass *pass);
int run_to_end(Job *job, const Pass *pass, int loop(Job *, int64_t));
bool stopped(const Pass *pass);
void note_run(Job *job, Task *task, int code);
void work(Pass *pass, Job *job);

/* variation_run.c: the same run with its derivatives; RUNNING, EVENT or how it ended. */
int integrate_variations(Job *job, int64_t budget);

#endif
