/* The Jacobian of the derivatives by the states at the present point, without the unknowns of the non-linear blocks:
   with g(x, q, t) = 0 they follow the states, dq = -g_q^-1 (g_x dx + g_t dt). */
#ifndef LINEARISE_H
#define LINEARISE_H

#include "instance.h"

/* Whether the model gives the derivatives by all parameters as one matrix. */
bool has_by_parameters(const Model *m);

/* Brings jacobian.xp up to date, for a model that has it. */
Status evaluate_by_parameters(Instance *s);

/* Brings jacobian.xx and xp up to date, for a model that has both: what they have in common is worked out once. */
Status evaluate_matrices(Instance *s);

/* Brings jacobian.xx up to date. Discard, with a log line, where the blocks are singular. */
Status evaluate_jacobian(Instance *s);

/* Takes the Jacobian anew and with it df/dt (n_x) and dg/dt (n_q), both while q is held. */
Status linearise(Instance *s, double *rate, double *dg_dt);

/* Turns df/dt while q is held into that while q follows; after `linearise`. dg_dt changes. */
void let_blocks_follow(const Instance *s, double *rate, double *dg_dt);

/* Factors g_q at the present point, for lu_solve with jacobian.qq and jacobian.pivot. */
Status factor_blocks(Instance *s);

#endif
