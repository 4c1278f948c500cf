/* Vectors of doubles. Sums run in the same order on every processor, and nothing is fused, so that the bits agree. */
#ifndef NUMBERS_H
#define NUMBERS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define EPS 2.220446049250313e-16

static inline int worse(int a, int b) { return a > b ? a : b; }
static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

/* to = from; they do not overlap. Most are a dozen numbers, or some hundreds: too few for a call. */
static inline void copy(double *restrict to, const double *restrict from, int64_t n) {
    if (n > 1024) {
        memcpy(to, from, (size_t)n * sizeof *to);
        return;
    }
    for (int64_t i = 0; i < n; i++) to[i] = from[i];
}

static inline void fill(double *x, double value, int64_t n) {
    for (int64_t i = 0; i < n; i++) x[i] = value;
}

/* NaN or infinity times zero is NaN, which stays. Four sums do not wait for each other. */
static inline bool all_finite(const double *x, int64_t n) {
    double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
    int64_t i = 0;
    for (; i + 4 <= n; i += 4) a += 0.0 * x[i], b += 0.0 * x[i + 1], c += 0.0 * x[i + 2], d += 0.0 * x[i + 3];
    for (; i < n; i++) a += 0.0 * x[i];
    return a + b + c + d == 0.0;
}

#endif
