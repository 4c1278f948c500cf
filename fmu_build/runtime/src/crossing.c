#include "crossing.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "relations.h"
#include "rodas.h"

enum { MAX_ITERATIONS = 100, BISECT_EVERY = 3, GRID = 32 };

/* A polynomial of degree 4 through CROSSING_LOOKS + 1 = 5 evenly spaced values exceeds their range by at most this part of it
   (half of Lebesgue's constant, 2.2, less one). */
static const double EXCESS = 0.61;

static Status indicators_at(Instance *s, double part, double *z) {
    rodas_move(s, part);
    return relations_indicators(s, z);
}

static bool any_crossed(const Instance *s, const double *z) {
    for (size_t k = 0; k < s->n_state_relations; k++)
        if (relation_is_crossed(s, k, z[k])) return true;
    return false;
}

/* Earliest zero of the straight lines from `before` to `after`, among the relations that changed. */
static double earliest_zero(const Instance *s, double before, double after) {
    const IntegratorWork *w = &s->integrator;
    double earliest = after;
    for (size_t k = 0; k < s->n_state_relations; k++) {
        if (!relation_is_crossed(s, k, w->z_after[k])) continue;
        const double part = w->z_before[k] / (w->z_before[k] - w->z_after[k]);
        if (part >= 0.0 && part <= 1.0) earliest = fmin(earliest, before + part * (after - before));
    }
    return earliest;
}

/* A trial strictly inside (before, after): the secant's zero, pushed a little beyond so that both ends move in, and
   now and then the middle. */
static double trial(const Instance *s, double before, double after, int iteration) {
    const double length = after - before;
    if (iteration % BISECT_EVERY == BISECT_EVERY - 1) return before + 0.5 * length;
    const double zero = earliest_zero(s, before, after) + (iteration % 2 == 0 ? 1e-3 : -1e-3) * length;
    return fmin(after - 1e-2 * length, fmax(before + 1e-2 * length, zero));
}

/* Narrows (before, after], at whose end a relation has changed and at whose begin none has. */
static Status narrow(Instance *s, double before, double after) {
    IntegratorWork *w = &s->integrator;
    const double step = w->end - w->begin;
    const double enough = fmax(0.1 * time_slack(s), 4.0 * DBL_EPSILON * fabs(w->end)) / step;
    for (int iteration = 0; after - before > enough && iteration < MAX_ITERATIONS; iteration++) {
        const double between = trial(s, before, after, iteration);
        if (indicators_at(s, between, w->z_between) != STATUS_OK) return STATUS_DISCARD;
        const bool crossed = any_crossed(s, w->z_between);
        double *z = crossed ? w->z_after : w->z_before;
        memcpy(z, w->z_between, s->n_state_relations * sizeof *z);
        *(crossed ? &after : &before) = between;
    }
    rodas_move(s, after);
    return STATUS_OK;
}

/* True if the relation might change and change back between the looks: z comes near zero compared with its variation. */
static bool is_suspicious(const Instance *s, size_t k) {
    const double *z = s->integrator.z_looks + k;
    double low = z[0], high = z[0];
    for (int look = 1; look <= CROSSING_LOOKS; look++) {
        low = fmin(low, z[(size_t)look * s->n_state_relations]);
        high = fmax(high, z[(size_t)look * s->n_state_relations]);
    }
    return low - EXCESS * (high - low) <= 0.0 && high + EXCESS * (high - low) >= 0.0;
}

/* Lagrange's weights of the looks at the fraction `part`. */
static void look_weights(double part, double *weights) {
    for (int i = 0; i <= CROSSING_LOOKS; i++) {
        weights[i] = 1.0;
        for (int j = 0; j <= CROSSING_LOOKS; j++)
            if (j != i) weights[i] *= (part * (double)CROSSING_LOOKS - (double)j) / (double)(i - j);
    }
}

/* True if the polynomial through the looks changes a relation at `part`. */
static bool polynomial_crosses(const Instance *s, double part) {
    double weights[CROSSING_LOOKS + 1];
    look_weights(part, weights);
    for (size_t k = 0; k < s->n_state_relations; k++) {
        double z = 0.0;
        for (int look = 0; look <= CROSSING_LOOKS; look++)
            z += weights[look] * s->integrator.z_looks[(size_t)look * s->n_state_relations + k];
        if (relation_is_crossed(s, k, z)) return true;
    }
    return false;
}

/* Narrows between two points of the grid, if a relation really changes there. */
static Status narrow_between(Instance *s, double before, double after, bool *found) {
    IntegratorWork *w = &s->integrator;
    if (indicators_at(s, after, w->z_after) != STATUS_OK) return STATUS_DISCARD;
    *found = any_crossed(s, w->z_after);
    if (!*found) return STATUS_OK;
    if (indicators_at(s, before, w->z_before) != STATUS_OK) return STATUS_DISCARD;
    return narrow(s, before, after);
}

/* First the dense output's own polynomial, where the looks alone could miss something, then the first look after a
   change. For z linear in x, that polynomial is exact. */
static Status locate_between_looks(Instance *s, double end, bool *found) {
    bool suspicious = end <= 1.0;
    for (size_t k = 0; k < s->n_state_relations; k++) suspicious = suspicious || is_suspicious(s, k);
    Status status = STATUS_OK;
    for (int point = 1; suspicious && point <= GRID && !*found && status == STATUS_OK; point++) {
        const double part = (double)point / (double)GRID;
        if (part > end) break;
        if (part == end || polynomial_crosses(s, part))
            status = narrow_between(s, (double)(point - 1) / (double)GRID, part, found);
    }
    return status;
}

Status crossing_locate(Instance *s, bool *found) {
    const size_t n = s->n_state_relations;
    *found = false;
    if (n == 0) return STATUS_OK;
    double end = 2.0; /* the first look at which a relation has changed; beyond the step: none */
    for (int look = 0; look <= CROSSING_LOOKS; look++) {
        double *z = s->integrator.z_looks + (size_t)look * n;
        if (indicators_at(s, (double)look / (double)CROSSING_LOOKS, z) != STATUS_OK) return STATUS_DISCARD;
        if (look > 0 && end > 1.0 && any_crossed(s, z)) end = (double)look / (double)CROSSING_LOOKS;
    }
    const Status status = locate_between_looks(s, end, found);
    if (status == STATUS_OK && !*found) rodas_move(s, 1.0);
    return status;
}
