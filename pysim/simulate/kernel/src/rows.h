/* Sums of rows, four columns at a time: in one vector of a processor with AVX2, in two of another. Both do the same
   operations in the same order, so the bits agree. */
#ifndef ROWS_H
#define ROWS_H

#include <stdint.h>

typedef struct {
    /* result = base + scale sum_i weights_i rows_i over the first `count` rows, all (n,). The result may be the base; it
       must not be one of the rows. */
    void (*add_rows)(const double *base, const double *rows, const double *weights, int64_t count, double scale,
                     double *result, int64_t n);

    /* The same, and scaled = factor result. */
    void (*add_rows_and_scale)(const double *base, const double *rows, const double *weights, int64_t count, double scale,
                               double *result, double factor, double *scaled, int64_t n);

    /* result = factor (a - b), n numbers. */
    void (*scale_difference)(const double *a, const double *b, double factor, double *result, int64_t n);

    /* sum_i (values_i / (absolute nominal_i + relative max(|x_i|, |y_i|)))^2 over n numbers. */
    double (*weighted_square)(const double *values, const double *nominal, const double *x, const double *y,
                              double absolute, double relative, int64_t n);

    /* target += factor source, n numbers. */
    void (*add_row)(double *target, const double *source, double factor, int64_t n);

    /* row = factor row - sum_i weights_i rows[numbers_i], rows of `width` numbers, a multiple of four; `row` is none of
       those summed. */
    void (*reduce_row)(double *row, double factor, const double *weights, const int64_t *numbers, int64_t count,
                       const double *rows, int64_t width);
} RowSums;

/* The best one for this processor, and the one that all can do. */
const RowSums *row_sums(void);
const RowSums *plainest_row_sums(void);

#endif
