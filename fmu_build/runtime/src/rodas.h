/* Rodas5P: a Rosenbrock method of order 5 for stiff systems, L-stable, stiffly accurate, with dense output of order 4.
   G. Steinebach, Construction of Rosenbrock-Wanner method Rodas5P and numerical benchmarks within the Julia
   Differential Equations package, BIT 63, 27 (2023). */
#ifndef RODAS_H
#define RODAS_H

#include "instance.h"

enum { RODAS_STAGES = 8, RODAS_ORDER = 5 };

/* Takes the present point as the start of a step: keeps it, the Jacobian and df/dt there. */
Status rodas_begin(Instance *s);

/* Tries to reach time `end`. On return the instance is at the end; `error` is the estimated error in units of the
   tolerance (root mean square over the states). Discard where the model cannot be evaluated on the way. */
Status rodas_try(Instance *s, double end, double *error);

/* The state with the largest error in the step that was tried last; 0 where there is none. */
size_t rodas_worst(const Instance *s);

/* Moves the instance to the fraction `part` (0 to 1) of the step that was tried last. */
void rodas_move(Instance *s, double part);

#endif
