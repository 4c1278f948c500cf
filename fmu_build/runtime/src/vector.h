/* Vectors of n doubles; where n is 0 their pointers may be null. */
#ifndef VECTOR_H
#define VECTOR_H

#include <stddef.h>
#include <string.h>

static inline void copy(double *to, const double *from, size_t n) {
    if (n > 0) memcpy(to, from, n * sizeof *to);
}

static inline void clear(double *values, size_t n) {
    if (n > 0) memset(values, 0, n * sizeof *values);
}

#endif
