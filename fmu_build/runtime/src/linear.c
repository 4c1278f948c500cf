#include "linear.h"

#include <math.h>

static void swap(double *a, double *b) {
    double old = *a;
    *a = *b;
    *b = old;
}

static size_t largest_below(size_t n, const double *column, size_t k) {
    size_t row = k;
    for (size_t i = k + 1; i < n; i++)
        if (fabs(column[i]) > fabs(column[row])) row = i;
    return row;
}

size_t lu_factor(size_t n, double *matrix, int *pivot) {
    for (size_t k = 0; k < n; k++) {
        double *column = matrix + k * n;
        size_t row = largest_below(n, column, k);
        pivot[k] = (int)row;
        if (!(fabs(column[row]) > 0.0) || !isfinite(column[row])) return k;
        for (size_t j = 0; row != k && j < n; j++) swap(matrix + j * n + k, matrix + j * n + row);
        const double inverse = 1.0 / column[k];
        for (size_t i = k + 1; i < n; i++) column[i] *= inverse;
        for (size_t j = k + 1; j < n; j++) {
            double *other = matrix + j * n;
            const double factor = other[k];
            if (factor == 0.0) continue;
            for (size_t i = k + 1; i < n; i++) other[i] -= factor * column[i];
        }
    }
    return n;
}

void lu_solve(size_t n, const double *lu, const int *pivot, double *b) {
    for (size_t k = 0; k < n; k++) swap(b + k, b + pivot[k]);
    for (size_t k = 0; k < n; k++) {
        const double *column = lu + k * n;
        for (size_t i = k + 1; i < n; i++) b[i] -= column[i] * b[k];
    }
    for (size_t k = n; k-- > 0;) {
        const double *column = lu + k * n;
        b[k] /= column[k];
        for (size_t i = 0; i < k; i++) b[i] -= column[i] * b[k];
    }
}

void lu_solve_transposed(size_t n, const double *lu, const int *pivot, double *b) {
    for (size_t k = 0; k < n; k++) {
        const double *column = lu + k * n;
        for (size_t i = 0; i < k; i++) b[k] -= column[i] * b[i];
        b[k] /= column[k];
    }
    for (size_t k = n; k-- > 0;) {
        const double *column = lu + k * n;
        for (size_t i = k + 1; i < n; i++) b[k] -= column[i] * b[i];
    }
    for (size_t k = n; k-- > 0;) swap(b + k, b + pivot[k]);
}
