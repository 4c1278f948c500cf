/* The history is interpolated by polynomials through up to NODES neighbouring points. Where an expression jumped or
   bent, at an event, its point is stored twice: no polynomial crosses such a break. A delayed value stops at the next
   break until an event, like a relation, so that an integrator sees a smooth function up to the very end of its step. */
#include "delay.h"

#include <math.h>

/* Points closer than this part of the maximum delay replace each other, so that the ring never runs short. */
static const double CLOSEST = 2.0 / (double)DELAY_CAPACITY;
enum { NODES = 6 };
static const double MOST_UNEQUAL = 10.0;
static const double SAME_VALUE = 1e-10; /* relative difference below which a value did not jump */

typedef struct {
    const double *times, *values;
    uint32_t first, count;
} History;

static History history(const Instance *s, size_t k) {
    return (History){s->delay_times + k * DELAY_CAPACITY, s->delay_values + k * DELAY_CAPACITY, s->delays[k].first,
                     s->delays[k].count};
}

static uint32_t slot(uint32_t first, uint32_t j) { return (first + j) % DELAY_CAPACITY; }
static double time_at(const History *h, uint32_t j) { return h->times[slot(h->first, j)]; }
static double value_at(const History *h, uint32_t j) { return h->values[slot(h->first, j)]; }

/* Last point j >= 1 that begins an interval holding `time`; of equal times the later one. */
static uint32_t find_interval(const History *h, double time) {
    uint32_t low = 0, high = h->count - 1;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (time_at(h, middle) <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

typedef struct {
    double value, rate;
} Sample;

/* True if the interval from point j to the next may support a polynomial over another one of `length`: it is no break
   and not so much shorter or longer that the rounding errors of its ends would be blown up. */
static bool is_usable(const History *h, uint32_t j, double length) {
    const double own = time_at(h, j + 1) - time_at(h, j);
    return own > length / MOST_UNEQUAL && own < length * MOST_UNEQUAL;
}

/* Widens the interval that begins at *first to at most NODES points, evenly to both sides; returns their number. */
static uint32_t choose_nodes(const History *h, uint32_t *first) {
    const uint32_t middle = *first;
    const double length = time_at(h, middle + 1) - time_at(h, middle);
    uint32_t last = middle + 1;
    while (last - *first + 1 < NODES) {
        const bool left = *first > 0 && is_usable(h, *first - 1, length);
        const bool right = last + 1 < h->count && is_usable(h, last, length);
        if (!left && !right) break;
        if (left && (!right || middle - *first <= last - middle - 1))
            --*first;
        else
            ++last;
    }
    return last - *first + 1;
}

/* Newton's interpolation formula over the points around interval j. */
static Sample interpolate(const History *h, uint32_t j, double time) {
    if (!(time_at(h, j + 1) > time_at(h, j))) return (Sample){value_at(h, j + 1), 0.0};
    const uint32_t n = choose_nodes(h, &j);
    double differences[NODES];
    for (uint32_t k = 0; k < n; k++) differences[k] = value_at(h, j + k);
    for (uint32_t order = 1; order < n; order++)
        for (uint32_t k = n - 1; k >= order; k--)
            differences[k] = (differences[k] - differences[k - 1]) / (time_at(h, j + k) - time_at(h, j + k - order));
    Sample sample = {differences[n - 1], 0.0};
    for (uint32_t k = n - 1; k-- > 0;) {
        const double distance = time - time_at(h, j + k);
        sample.rate = sample.rate * distance + sample.value;
        sample.value = sample.value * distance + differences[k];
    }
    return sample;
}

/* Value of the left piece where it ends at the break `limit`. */
static Sample at_limit(const History *h, double limit) {
    uint32_t j = find_interval(h, limit);
    while (j > 0 && time_at(h, j) >= limit) j--;
    const uint32_t end = j + 1 < h->count && time_at(h, j + 1) <= limit ? j + 1 : j;
    return (Sample){value_at(h, end), 0.0};
}

static Sample look_back(const Instance *s, size_t k, double time) {
    const History h = history(s, k);
    const DelayState *state = &s->delays[k];
    time = fmax(time, state->passed);
    if (time >= state->limit) return at_limit(&h, state->limit);
    if (h.count < 2 || time <= time_at(&h, 0)) return (Sample){value_at(&h, 0), 0.0};
    if (time >= time_at(&h, h.count - 1)) return (Sample){value_at(&h, h.count - 1), 0.0};
    return interpolate(&h, find_interval(&h, time), time);
}

static double newest_time(const Instance *s, size_t k) {
    const History h = history(s, k);
    return time_at(&h, h.count - 1);
}

static bool is_late(const Instance *s, size_t k) {
    const DelayState *state = &s->delays[k];
    const double time = *s->t - state->time;
    if (state->count == 0) return false;
    return state->time == 0.0 || (time > newest_time(s, k) && time < state->limit);
}

Status delay_times_update(Instance *s) {
    const size_t n = s->model->n_v;
    if (n == 0) return STATUS_OK;
    double *times = s->event.delay_time, *maxima = s->event.delay_maximum;
    double *res[] = {NULL, times, maxima};
    Status status = call_model(s, s->model->delays, res);
    for (size_t k = 0; k < n && status == STATUS_OK; k++) {
        s->delays[k].time = times[k];
        s->delays[k].maximum = maxima[k];
        if (times[k] >= 0.0 && times[k] <= maxima[k] && isfinite(maxima[k])) continue;
        log_message(s, LOG_DISCARD, "delay() number %zu: the delay time %.16g s is not between 0 and its maximum %.16g s.",
                    k + 1, times[k], maxima[k]);
        status = STATUS_DISCARD;
    }
    return status;
}

bool delay_values_update(Instance *s) {
    bool late = false;
    for (size_t k = 0; k < s->model->n_v; k++) {
        if (s->delays[k].count == 0) continue; /* not started: v is as delay_start sets it */
        s->v[k] = look_back(s, k, *s->t - s->delays[k].time).value;
        late = late || is_late(s, k);
    }
    return late;
}

Status delay_values_complete(Instance *s) {
    double *source = s->event.delay_source;
    double *res[] = {source, NULL, NULL};
    if (call_model(s, s->model->delays, res) != STATUS_OK) return STATUS_DISCARD;
    for (size_t k = 0; k < s->model->n_v; k++) {
        if (!is_late(s, k)) continue;
        const double end = newest_time(s, k), delay = s->delays[k].time;
        const double part = delay > 0.0 ? (*s->t - delay - end) / (*s->t - end) : 1.0;
        s->v[k] += part * (source[k] - s->v[k]);
    }
    return STATUS_OK;
}

Status delay_start(Instance *s) {
    const size_t n = s->model->n_v;
    if (n == 0) return STATUS_OK;
    double *source = s->event.delay_source;
    double *res[] = {source, NULL, NULL};
    if (call_model(s, s->model->delays, res) != STATUS_OK) return STATUS_DISCARD;
    for (size_t k = 0; k < n; k++) {
        s->delays[k].first = 0;
        s->delays[k].count = 1;
        s->delays[k].passed = -INFINITY;
        s->delays[k].limit = s->delays[k].time > 0.0 ? *s->t : INFINITY; /* the history bends where it begins */
        s->delay_times[k * DELAY_CAPACITY] = *s->t;
        s->delay_values[k * DELAY_CAPACITY] = source[k];
        s->v[k] = source[k];
    }
    return STATUS_OK;
}

static void append(Instance *s, size_t k, double value) {
    DelayState *state = &s->delays[k];
    if (state->count == DELAY_CAPACITY) {
        state->first = slot(state->first, 1);
        state->count--;
        const History h = history(s, k);
        if (time_at(&h, 0) > *s->t - state->time)
            log_message(s, LOG_WARNING, "delay() number %zu: too many events for its buffer; at time %.16g s its past is cut off.",
                        k + 1, *s->t);
    }
    const size_t at = k * DELAY_CAPACITY + slot(state->first, state->count++);
    s->delay_times[at] = *s->t;
    s->delay_values[at] = value;
}

static void replace_newest(Instance *s, size_t k, double value) {
    const size_t at = k * DELAY_CAPACITY + slot(s->delays[k].first, s->delays[k].count - 1);
    s->delay_times[at] = *s->t;
    s->delay_values[at] = value;
}

/* True if the newest point may move to the present time without a visible loss. */
static bool is_crowded(const Instance *s, size_t k) {
    const History h = history(s, k);
    if (h.count < 3) return false;
    const double before = time_at(&h, h.count - 2), newest = time_at(&h, h.count - 1);
    return newest > before && *s->t - before < CLOSEST * s->delays[k].maximum;
}

static bool jumped(double from, double to) { return fabs(to - from) > SAME_VALUE * fmax(fabs(from), fabs(to)); }

static void record_one(Instance *s, size_t k, double value, bool is_break) {
    DelayState *state = &s->delays[k];
    while (state->count > 1 && newest_time(s, k) > *s->t) state->count--; /* the host went back in time */
    const History h = history(s, k);
    const bool same_time = newest_time(s, k) >= *s->t;
    if (!same_time) {
        if (is_crowded(s, k))
            replace_newest(s, k, value);
        else
            append(s, k, value);
        return;
    }
    const bool is_double = state->count > 1 && time_at(&h, state->count - 2) >= *s->t;
    const bool at_start = state->count == 1 && state->limit == *s->t;
    if (is_double || at_start || !(is_break || jumped(value_at(&h, state->count - 1), value))) {
        replace_newest(s, k, value);
    } else {
        append(s, k, value);
        if (isinf(state->limit)) state->limit = *s->t;
    }
}

Status delay_record(Instance *s, bool is_break) {
    const size_t n = s->model->n_v;
    double *source = s->event.delay_source;
    double *res[] = {source, NULL, NULL};
    if (call_model(s, s->model->delays, res) != STATUS_OK) return STATUS_DISCARD;
    for (size_t k = 0; k < n; k++) record_one(s, k, source[k], is_break);
    return STATUS_OK;
}

static double next_limit(const Instance *s, size_t k, double after) {
    const History h = history(s, k);
    for (uint32_t j = 0; j + 1 < h.count; j++)
        if (time_at(&h, j) > after && time_at(&h, j) == time_at(&h, j + 1)) return time_at(&h, j);
    return INFINITY;
}

bool delay_pass_breaks(Instance *s, double slack) {
    bool passed = false;
    for (size_t k = 0; k < s->model->n_v; k++) {
        DelayState *state = &s->delays[k];
        while (state->limit + state->time <= *s->t + slack) {
            state->passed = state->limit;
            state->limit = next_limit(s, k, state->passed);
            passed = true;
        }
    }
    return passed;
}

double delay_next_break(const Instance *s) {
    double next = INFINITY;
    for (size_t k = 0; k < s->model->n_v; k++) next = fmin(next, s->delays[k].limit + s->delays[k].time);
    return next;
}

double delay_smallest(const Instance *s) {
    double smallest = INFINITY;
    for (size_t k = 0; k < s->model->n_v; k++)
        if (s->delays[k].time > 0.0) smallest = fmin(smallest, s->delays[k].time);
    return smallest;
}

void delay_rates(const Instance *s, double *rates) {
    for (size_t k = 0; k < s->model->n_v; k++) rates[k] = look_back(s, k, *s->t - s->delays[k].time).rate;
}
