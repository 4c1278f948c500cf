/* The sums of rows.h; included once for each kind of processor, which names them by PREFIX. */
#include "rows.h"

typedef double Four __attribute__((vector_size(32)));

#define JOIN(a, b) a##b
#define NAMED(a, b) JOIN(a, b)
#define OWN(name) NAMED(PREFIX, name)

static inline Four load(const double *p) {
    Four v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}

static inline void store(double *p, Four v) { __builtin_memcpy(p, &v, sizeof v); }

static inline Four spread(double x) { return (Four){x, x, x, x}; }

static inline Four sum_at(const double *base, const double *rows, const double *weights, int64_t count, double scale,
                          int64_t j, int64_t n) {
    Four total = load(base + j);
    for (int64_t i = 0; i < count; i++) total += spread(scale * weights[i]) * load(rows + i * n + j);
    return total;
}

static inline double last_sum(const double *base, const double *rows, const double *weights, int64_t count, double scale,
                              int64_t j, int64_t n) {
    double total = base[j];
    for (int64_t i = 0; i < count; i++) total += scale * weights[i] * rows[i * n + j];
    return total;
}

static void add_rows(const double *base, const double *rows, const double *weights, int64_t count, double scale,
                     double *result, int64_t n) {
    int64_t j = 0;
    for (; j + 4 <= n; j += 4) store(result + j, sum_at(base, rows, weights, count, scale, j, n));
    for (; j < n; j++) result[j] = last_sum(base, rows, weights, count, scale, j, n);
}

/* Sixteen columns at a time, so that four sums do not wait for each other. */
static void add_rows_and_scale(const double *base, const double *rows, const double *weights, int64_t count, double scale,
                               double *result, double factor, double *scaled, int64_t n) {
    const Four f = spread(factor);
    int64_t j = 0;
    for (; j + 16 <= n; j += 16) {
        Four a = load(base + j), b = load(base + j + 4), c = load(base + j + 8), d = load(base + j + 12);
        const double *row = rows + j;
        for (int64_t i = 0; i < count; i++, row += n) {
            const Four weight = spread(scale * weights[i]);
            a += weight * load(row);
            b += weight * load(row + 4);
            c += weight * load(row + 8);
            d += weight * load(row + 12);
        }
        store(result + j, a), store(result + j + 4, b), store(result + j + 8, c), store(result + j + 12, d);
        store(scaled + j, f * a), store(scaled + j + 4, f * b), store(scaled + j + 8, f * c), store(scaled + j + 12, f * d);
    }
    for (; j + 4 <= n; j += 4) {
        const Four total = sum_at(base, rows, weights, count, scale, j, n);
        store(result + j, total);
        store(scaled + j, f * total);
    }
    for (; j < n; j++) {
        result[j] = last_sum(base, rows, weights, count, scale, j, n);
        scaled[j] = factor * result[j];
    }
}

static void scale_difference(const double *a, const double *b, double factor, double *result, int64_t n) {
    int64_t j = 0;
    for (; j + 4 <= n; j += 4) store(result + j, spread(factor) * (load(a + j) - load(b + j)));
    for (; j < n; j++) result[j] = factor * (a[j] - b[j]);
}

static inline double magnitude(double x) { return x < 0.0 ? -x : x; }
static inline double larger(double a, double b) { return a > b ? a : b; }

static inline double weighted(double value, double nominal, double x, double y, double absolute, double relative) {
    return value / (absolute * nominal + relative * larger(magnitude(x), magnitude(y)));
}

static double weighted_square(const double *values, const double *nominal, const double *x, const double *y,
                              double absolute, double relative, int64_t n) {
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    int64_t j = 0;
    for (; j + 4 <= n; j += 4) {
        double share[4];
        for (int i = 0; i < 4; i++)
            share[i] = weighted(values[j + i], nominal[j + i], x[j + i], y[j + i], absolute, relative);
        for (int i = 0; i < 4; i++) sums[i] += share[i] * share[i];
    }
    for (; j < n; j++) {
        const double share = weighted(values[j], nominal[j], x[j], y[j], absolute, relative);
        sums[0] += share * share;
    }
    return sums[0] + sums[1] + sums[2] + sums[3];
}

static void add_row(double *target, const double *source, double factor, int64_t n) {
    int64_t j = 0;
    for (; j + 4 <= n; j += 4) store(target + j, load(target + j) + spread(factor) * load(source + j));
    for (; j < n; j++) target[j] += factor * source[j];
}

static void reduce_row(double *row, double factor, const double *weights, const int64_t *numbers, int64_t count,
                       const double *rows, int64_t width) {
    int64_t j = 0;
    for (; j + 16 <= width; j += 16) {
        Four a = spread(factor) * load(row + j), b = spread(factor) * load(row + j + 4);
        Four c = spread(factor) * load(row + j + 8), d = spread(factor) * load(row + j + 12);
        for (int64_t i = 0; i < count; i++) {
            const double *source = rows + numbers[i] * width + j;
            const Four weight = spread(weights[i]);
            a -= weight * load(source);
            b -= weight * load(source + 4);
            c -= weight * load(source + 8);
            d -= weight * load(source + 12);
        }
        store(row + j, a);
        store(row + j + 4, b);
        store(row + j + 8, c);
        store(row + j + 12, d);
    }
    for (; j + 4 <= width; j += 4) {
        Four a = spread(factor) * load(row + j);
        for (int64_t i = 0; i < count; i++) a -= spread(weights[i]) * load(rows + numbers[i] * width + j);
        store(row + j, a);
    }
}

const RowSums OWN(row_sums) = {add_rows, add_rows_and_scale, scale_difference, weighted_square, add_row, reduce_row};
