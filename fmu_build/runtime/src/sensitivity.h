/* Exact directional and adjoint derivatives; through the non-linear blocks by the implicit function theorem. */
#ifndef SENSITIVITY_H
#define SENSITIVITY_H

#include "instance.h"

typedef struct {
    const uint32_t *unknowns, *knowns;
    size_t n_unknowns, n_knowns;
} Partials;

/* change (n_unknowns) = d unknowns / d knowns * seed (n_knowns) */
Status directional_derivative(Instance *s, const char *function, const Partials *partials, const double *seed,
                              double *change);

/* change (n_knowns) = (d unknowns / d knowns)' * seed (n_unknowns) */
Status adjoint_derivative(Instance *s, const char *function, const Partials *partials, const double *seed,
                          double *change);

#endif
