/* The sums of rows.h; included once for each kind of processor, which names them by PREFIX. */
#include <string.h>

#include "rows.h"

typedef double Four __attribute__((vector_size(32)));

#define JOIN(a, b) a##b
#define NAMED(a, b) JOIN(a, b)
#define OWN(name) NAMED(PREFIX, name)

static inline Four load(const double *p) {
    Four v;
    memcpy(&v, p, sizeof v);
    return v;
}

static inline void store(double *p, Four v) { memcpy(p, &v, sizeof v); }

static inline Four spread(double x) { return (Four){x, x, x, x}; }

static void add_rows(const double *base, const double *rows, const double *weights, int64_t count, double scale,
                     double *result, int64_t n) {
    int64_t j = 0;
    for (; j + 8 <= n; j += 8) {
        Four first = load(base + j), second = load(base + j + 4);
        const double *row = rows + j;
        for (int64_t i = 0; i < count; i++, row += n) {
            const Four weight = spread(scale * weights[i]);
            first += weight * load(row);
            second += weight * load(row + 4);
        }
        store(result + j, first);
        store(result + j + 4, second);
    }
    for (; j < n; j++) {
        double total = base[j];
        for (int64_t i = 0; i < count; i++) total += scale * weights[i] * rows[i * n + j];
        result[j] = total;
    }
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

const RowSums OWN(row_sums) = {add_rows, add_row, reduce_row};
