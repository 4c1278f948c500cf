/* Systems shift I - J by a list of indices that was made once per model (elimination.py): entries that are zero whatever
   the point are never touched. Pivots stay on the diagonal, which may be a bad choice; so every factorisation is tried
   on one vector, and where it fails, the dense one with row pivoting takes over. */
#include "kernel.h"

static const double loss = 1e-12; /* of a row's size: what rounding may change in it */
static const double alike = 10.0; /* times: so much may two pivots differ and be as good as each other */

/* Factors L D U of shift I - J; the diagonals of L and U are one, that of D is kept inverted. For each row the list of
   operations comes first, then what is left of the diagonal is scaled, then what is right of it. */
static void eliminate(Work *w, double shift) {
    double *restrict v = w->factors;
    const double *restrict jacobian = w->jacobian;
    const int64_t *first = w->row_first, *diagonal = w->diagonal;
    const Operation *operation = w->operations;
    for (int64_t q = 0; q < w->entries; q++) v[q] = -jacobian[w->sources[q]];
    for (int64_t r = 0; r < w->n; r++) {
        const int64_t middle = diagonal[r];
        const Operation *end = w->operations + w->operation_first[r + 1];
        v[middle] += shift;
        for (; operation < end; operation++) v[operation->target] -= v[operation->weight] * v[operation->source];
        for (int64_t q = first[r]; q < middle; q++) v[q] *= v[diagonal[w->places[q]]];
        w->pivot_values[r] = v[middle];
        const double inverse = 1.0 / v[middle];
        v[middle] = inverse;
        for (int64_t u = middle + 1; u < first[r + 1]; u++) v[u] *= inverse;
    }
}

/* Whether the factors give back the matrix, applied to a vector of the size of the states. */
static bool reproduces(const Work *w, double shift) {
    const double *v = w->factors, *x = w->x, *nominal = w->nominal, *jacobian = w->jacobian;
    const int64_t *first = w->row_first, *diagonal = w->diagonal;
    double *probe = w->probe, *size_of = w->magnitude;
    for (int64_t i = 0; i < w->n; i++) size_of[i] = nominal[i] + fabs(x[i]);
    for (int64_t r = 0; r < w->n; r++) { /* D U times the vector */
        double y = size_of[w->states[r]];
        for (int64_t u = diagonal[r] + 1; u < first[r + 1]; u++) y += v[u] * size_of[w->columns[u]];
        probe[r] = y * w->pivot_values[r];
    }
    bool good = true;
    for (int64_t r = 0; r < w->n; r++) {
        const double own = shift * size_of[w->states[r]];
        double size = fabs(own), rest = probe[r] - own;
        for (int64_t q = first[r]; q < diagonal[r]; q++) rest += v[q] * probe[w->places[q]];
        for (int64_t q = first[r]; q < first[r + 1]; q++) {
            const double change = jacobian[w->sources[q]] * size_of[w->columns[q]];
            rest += change;
            size += fabs(change);
        }
        good = good && fabs(rest) <= loss * size;
    }
    return good;
}

/* Whether every pivot is about as large as when the factors were last tried: rounding grows by the pivots' decline. */
static bool pivots_are_alike(const Work *w) {
    bool alike_all = true;
    for (int64_t r = 0; r < w->n; r++) {
        const double now = fabs(w->pivot_values[r]), then = fabs(w->tried_pivots[r]);
        alike_all &= now * alike >= then && now <= alike * then;
    }
    return alike_all;
}

/* Whether the factors are good; tried only where they may be worse than those last tried. */
static bool factors_are_good(Job *job, double shift) {
    const Work *w = &job->work;
    if (job->run.has_tried && pivots_are_alike(w)) return true;
    job->run.has_tried = reproduces(w, shift);
    copy(w->tried_pivots, w->pivot_values, w->n);
    return job->run.has_tried;
}

bool factorise_shifted(Job *job, double shift) {
    Work *w = &job->work;
    if (w->sparse) {
        eliminate(w, shift);
        job->run.is_sparse = factors_are_good(job, shift);
        if (job->run.is_sparse) return true;
    }
    job->run.is_sparse = 0;
    const int64_t n = w->n;
    for (int64_t i = 0; i < n * n; i++) w->matrix[i] = -w->jacobian[i];
    for (int64_t i = 0; i < n; i++) w->matrix[i * n + i] += shift;
    return dense_factorise(w->matrix, w->pivots, n);
}

static void substitute(const Work *w, double *b) {
    const double *v = w->factors;
    const int64_t *first = w->row_first, *diagonal = w->diagonal, *states = w->states, *columns = w->columns;
    for (int64_t r = 0; r < w->n; r++) {
        double y = b[states[r]];
        for (int64_t q = first[r]; q < diagonal[r]; q++) y -= v[q] * b[columns[q]];
        b[states[r]] = y;
    }
    for (int64_t r = w->n - 1; r >= 0; r--) {
        double y = b[states[r]] * v[diagonal[r]];
        for (int64_t u = diagonal[r] + 1; u < first[r + 1]; u++) y -= v[u] * b[columns[u]];
        b[states[r]] = y;
    }
}

static void substitute_rows(const Work *w, double *right, int64_t width) {
    const double *v = w->factors;
    const int64_t *first = w->row_first, *diagonal = w->diagonal, *states = w->states, *columns = w->columns;
    for (int64_t r = 0; r < w->n; r++) {
        const int64_t q = first[r];
        if (diagonal[r] > q)
            w->sums->reduce_row(right + width * states[r], 1.0, v + q, columns + q, diagonal[r] - q, right, width);
    }
    for (int64_t r = w->n - 1; r >= 0; r--) {
        const int64_t u = diagonal[r] + 1;
        w->sums->reduce_row(right + width * states[r], v[u - 1], v + u, columns + u, first[r + 1] - u, right, width);
    }
}

void solve_shifted(Job *job, double *right) {
    if (job->run.is_sparse) substitute(&job->work, right);
    else dense_solve(job->work.matrix, job->work.pivots, right, job->work.n);
}

void solve_shifted_rows(Job *job, double *right, int64_t width) {
    const Work *w = &job->work;
    if (job->run.is_sparse) substitute_rows(w, right, width);
    else dense_solve_rows(w->matrix, w->pivots, right, w->n, width, w->sums);
}
