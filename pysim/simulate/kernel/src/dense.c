/* Small dense systems, by elimination with row pivoting (Golub, Van Loan, Matrix Computations, 3.4). */
#include "kernel.h"

static void swap(double *a, double *b, int64_t n) {
    for (int64_t k = 0; k < n; k++) {
        const double kept = a[k];
        a[k] = b[k], b[k] = kept;
    }
}

/* The matrix, column after column, becomes its factors; the diagonal is kept inverted. */
bool dense_factorise(double *matrix, int64_t *pivots, int64_t n) {
    for (int64_t c = 0; c < n; c++) {
        double *pivot = matrix + n * c;
        int64_t best = c;
        for (int64_t r = c + 1; r < n; r++)
            if (fabs(pivot[r]) > fabs(pivot[best])) best = r;
        pivots[c] = best;
        if (!(fabs(pivot[best]) > 0.0 && fabs(pivot[best]) < 1e300)) return false;
        swap(pivot + c, pivot + best, 1);
        const double inverse = 1.0 / pivot[c];
        pivot[c] = inverse;
        for (int64_t r = c + 1; r < n; r++) pivot[r] *= inverse;
        for (int64_t j = c + 1; j < n; j++) {
            double *column = matrix + n * j;
            swap(column + c, column + best, 1);
            const double top = column[c];
            if (top != 0.0)
                for (int64_t r = c + 1; r < n; r++) column[r] -= top * pivot[r];
        }
    }
    return true;
}

void dense_solve(const double *matrix, const int64_t *pivots, double *right, int64_t n) {
    for (int64_t c = 0; c < n; c++) {
        const double *column = matrix + n * c;
        swap(right + c, right + pivots[c], 1);
        for (int64_t r = c + 1; r < n; r++) right[r] -= right[c] * column[r];
    }
    for (int64_t c = n - 1; c >= 0; c--) {
        const double *column = matrix + n * c;
        right[c] *= column[c];
        for (int64_t r = 0; r < c; r++) right[r] -= right[c] * column[r];
    }
}

void dense_solve_rows(const double *matrix, const int64_t *pivots, double *right, int64_t n, int64_t width,
                      const RowSums *sums) {
    for (int64_t c = 0; c < n; c++) {
        const double *column = matrix + n * c;
        double *row = right + width * c;
        if (pivots[c] != c) swap(row, right + width * pivots[c], width);
        for (int64_t r = c + 1; r < n; r++)
            if (column[r] != 0.0) sums->add_row(right + width * r, row, -column[r], width);
    }
    for (int64_t c = n - 1; c >= 0; c--) {
        const double *column = matrix + n * c;
        double *row = right + width * c;
        for (int64_t k = 0; k < width; k++) row[k] *= column[c];
        for (int64_t r = 0; r < c; r++)
            if (column[r] != 0.0) sums->add_row(right + width * r, row, -column[r], width);
    }
}
