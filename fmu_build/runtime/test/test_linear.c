/* LU factors with many row exchanges: products with known solutions, for the matrix and its transpose. */
#include "check.h"
#include "linear.h"

enum { N = 9, MATRICES = 200 };

static double next_random(void) {
    static unsigned state = 1;
    state = state * 1664525u + 1013904223u;
    return (double)(state >> 8) / (double)(1u << 24) - 0.5;
}

static void fill(double *matrix, double *x) {
    for (size_t k = 0; k < N * N; k++) matrix[k] = next_random();
    for (size_t k = 0; k < N; k++) matrix[k * N + k] = 0.0; /* so that no pivot is where it should be */
    for (size_t k = 0; k < N; k++) x[k] = next_random();
}

static void check_solutions(void) {
    double matrix[N * N], x[N], b[N] = {0.0}, transposed[N] = {0.0};
    int pivot[N];
    fill(matrix, x);
    for (size_t j = 0; j < N; j++)
        for (size_t i = 0; i < N; i++) {
            b[i] += matrix[j * N + i] * x[j];
            transposed[j] += matrix[j * N + i] * x[i];
        }
    CHECK(lu_factor(N, matrix, pivot) == N);
    lu_solve(N, matrix, pivot, b);
    lu_solve_transposed(N, matrix, pivot, transposed);
    for (size_t k = 0; k < N; k++) {
        CHECK_NEAR(b[k], x[k], 1e-9);
        CHECK_NEAR(transposed[k], x[k], 1e-9);
    }
}

int main(void) {
    for (int k = 0; k < MATRICES; k++) check_solutions();
    double singular[] = {1.0, 2.0, 2.0, 4.0};
    int pivot[2];
    CHECK(lu_factor(2, singular, pivot) == 1);
    return 0;
}
