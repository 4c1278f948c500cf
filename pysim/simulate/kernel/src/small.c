/* The small dense system of a periodic orbit. */
#include "kernel.h"

enum { SWEEPS = 60 };

static double dot(const double *a, const double *b, int64_t n) {
    double sum = 0.0;
    for (int64_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Whether the inverse, (n, n) by rows, was found and shows that no direction is lost: a tenth of the time of the singular
   values that tell for sure. */
static bool invert(Shooting *s, int64_t n, double least, const RowSums *sums) {
    copy(s->factors, s->matrix, n * n);
    if (!dense_factorise(s->factors, s->pivots, n)) return false;
    fill(s->inverse, 0.0, n * n);
    for (int64_t i = 0; i < n; i++) s->inverse[i * n + i] = 1.0;
    dense_solve_rows(s->factors, s->pivots, s->inverse, n, n, sums);
    const double size = sqrt(dot(s->inverse, s->inverse, n * n)), own = sqrt(dot(s->matrix, s->matrix, n * n));
    return size * least * larger(1.0, own) < 1.0;
}

static void rotate(double *a, double *b, double cosine, double sine, int64_t n) {
    for (int64_t i = 0; i < n; i++) {
        const double first = a[i], second = b[i];
        a[i] = cosine * first - sine * second;
        b[i] = sine * first + cosine * second;
    }
}

/* Rotates the columns of A until they are perpendicular: A V = W, the lengths of whose columns are the singular values
   (one-sided Jacobi; Golub, Van Loan, Matrix Computations, 8.6.3). W replaces A, V goes into `inverse`. */
static void decompose(Shooting *s, int64_t n) {
    double *w = s->matrix, *v = s->inverse;
    fill(v, 0.0, n * n);
    for (int64_t i = 0; i < n; i++) v[i * n + i] = 1.0;
    bool turned = true;
    for (int sweep = 0; turned && sweep < SWEEPS; sweep++) {
        turned = false;
        for (int64_t p = 0; p < n; p++)
            for (int64_t q = p + 1; q < n; q++) {
                double *a = w + p * n, *b = w + q * n;
                const double aa = dot(a, a, n), bb = dot(b, b, n), ab = dot(a, b, n);
                if (!(fabs(ab) > EPS * sqrt(aa * bb))) continue;
                const double zeta = (bb - aa) / (2.0 * ab);
                const double t = (zeta < 0.0 ? -1.0 : 1.0) / (fabs(zeta) + sqrt(1.0 + zeta * zeta));
                const double cosine = 1.0 / sqrt(1.0 + t * t);
                rotate(a, b, cosine, t * cosine, n);
                rotate(v + p * n, v + q * n, cosine, t * cosine, n);
                turned = true;
            }
    }
}

/* solved = V diag(1 / sigma) U^T right over the directions that are held; `factors` takes what is left of right. */
static void solve_held(Shooting *s, double *solved, int64_t n, int64_t m, double least, double *left) {
    double longest = 1.0;
    for (int64_t j = 0; j < n; j++) longest = larger(longest, sqrt(dot(s->matrix + j * n, s->matrix + j * n, n)));
    fill(solved, 0.0, n * m);
    double *rest = s->factors;
    for (int64_t i = 0; i < n; i++) rest[i] = s->right[i * m];
    for (int64_t j = 0; j < n; j++) {
        const double *w = s->matrix + j * n, *v = s->inverse + j * n;
        const double square = dot(w, w, n);
        if (!(sqrt(square) > least * longest)) continue;
        for (int64_t c = 0; c < m; c++) {
            double share = 0.0;
            for (int64_t i = 0; i < n; i++) share += w[i] * s->right[i * m + c];
            share /= square;
            for (int64_t i = 0; i < n; i++) solved[i * m + c] += share * v[i];
            if (c == 0)
                for (int64_t i = 0; i < n; i++) rest[i] -= share * w[i];
        }
    }
    *left = 0.0;
    for (int64_t i = 0; i < n; i++) *left = larger(*left, fabs(rest[i]));
}

void solve_least(Shooting *s, double *solved, int64_t n, int64_t m, double least, double *left, const RowSums *sums) {
    *left = 0.0;
    if (!invert(s, n, least, sums)) {
        decompose(s, n);
        solve_held(s, solved, n, m, least, left);
        return;
    }
    fill(solved, 0.0, n * m);
    for (int64_t i = 0; i < n; i++)
        for (int64_t j = 0; j < n; j++) sums->add_row(solved + i * m, s->right + j * m, s->inverse[i * n + j], m);
}
