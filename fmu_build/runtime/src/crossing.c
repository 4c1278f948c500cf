#include "crossing.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "relations.h"
#include "rodas.h"

enum { LOOKS = 4, MAX_ITERATIONS = 100, BISECT_EVERY = 3 };

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

Status crossing_locate(Instance *s, bool *found) {
    IntegratorWork *w = &s->integrator;
    *found = false;
    if (s->n_state_relations == 0) return STATUS_OK;
    if (indicators_at(s, 0.0, w->z_before) != STATUS_OK) return STATUS_DISCARD;
    for (int look = 1; look <= LOOKS; look++) {
        const double after = (double)look / LOOKS;
        if (indicators_at(s, after, w->z_after) != STATUS_OK) return STATUS_DISCARD;
        if (any_crossed(s, w->z_after)) {
            *found = true;
            return narrow(s, (double)(look - 1) / LOOKS, after);
        }
        memcpy(w->z_before, w->z_after, s->n_state_relations * sizeof *w->z_after);
    }
    return STATUS_OK;
}
