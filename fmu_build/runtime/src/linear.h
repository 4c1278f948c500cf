/* Dense linear systems, column-major, without allocation. */
#ifndef LINEAR_H
#define LINEAR_H

#include <stddef.h>

/* Factors the n x n matrix in place (LU, partial pivoting). Returns n, or the first column that depends on those before
   it or is not finite. */
size_t lu_factor(size_t n, double *matrix, int *pivot);

/* Solves A x = b in place, with A as left by lu_factor. */
void lu_solve(size_t n, const double *lu, const int *pivot, double *b);

/* Solves the transposed system A' x = b in place. */
void lu_solve_transposed(size_t n, const double *lu, const int *pivot, double *b);

#endif
