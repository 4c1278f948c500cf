/* Damped Newton iteration for the non-linear blocks and for the initial problem. */
#ifndef NEWTON_H
#define NEWTON_H

#include "instance.h"

/* Evaluates the residual (n) and, if `jacobian` is not null, its n x n Jacobian at the present unknowns. */
typedef Status NewtonSystem(Instance *s, double *residual, double *jacobian);

/* Solves for the n `unknowns` from their present values. Discard if there is no convergence; the caller logs. */
Status newton_solve(Instance *s, NewtonSystem *system, double *unknowns, size_t n);

/* Logs where the last newton_solve failed; `names` of the unknowns may be null. */
void newton_report(Instance *s, LogCategory category, const char *equations, const char *const *names);

#endif
