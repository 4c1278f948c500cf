#include "relations.h"

#include <float.h>
#include <math.h>

#include "evaluate.h"

static const double HYSTERESIS = 1e-10; /* of the largest value that the indicator has shown */
static const double TIME_SLACK = 1e-12; /* of the time, or of 1 s */

double time_slack(const Instance *s) { return TIME_SLACK * fmax(1.0, fabs(*s->t)); }

static bool holds(const ModelRelation *relation, double z) { return relation->strict ? z > 0.0 : z >= 0.0; }

static void widen_scale(Instance *s) {
    for (size_t k = 0; k < s->model->n_r; k++)
        if (isfinite(s->z[k])) s->z_scale[k] = fmax(s->z_scale[k], fabs(s->z[k]));
}

static Status set_relation(Instance *s, size_t k, double z, bool *changed) {
    if (isnan(z)) {
        log_message(s, LOG_DISCARD, "Relation number %zu compares something that is not a number at time %.16g s.", k + 1,
                    *s->t);
        return STATUS_DISCARD;
    }
    const double value = holds(&s->model->relations[k], z) ? 1.0 : 0.0;
    if (value != s->r[k]) *changed = true;
    s->r[k] = value;
    return STATUS_OK;
}

/* `time > 1` is set at its event, at time 1: what counts is the interval that begins there. Before the first event,
   while the model is initialised, it is the start itself: `when time > 0` has its event there. */
static Status update_relations_of_time(Instance *s, bool *changed) {
    if (s->n_state_relations == s->model->n_r) return STATUS_OK;
    const double now = *s->t;
    if (s->memory->phase != PHASE_INITIALIZATION) *s->t = now + 2.0 * time_slack(s);
    double *res[] = {s->z};
    Status status = call_model(s, s->model->indicators, res);
    *s->t = now;
    clear_computed(s, HAS_Z);
    for (size_t k = 0; k < s->model->n_r && status == STATUS_OK; k++)
        if (s->model->relations[k].of_time) status = set_relation(s, k, s->z[k], changed);
    return status;
}

Status relations_update(Instance *s, bool *changed) {
    *changed = false;
    if (s->model->n_r == 0) return STATUS_OK;
    if (evaluate_indicators(s) != STATUS_OK) return STATUS_DISCARD;
    widen_scale(s);
    Status status = STATUS_OK;
    for (size_t k = 0; k < s->n_state_relations && status == STATUS_OK; k++)
        status = set_relation(s, s->state_relations[k], s->z[s->state_relations[k]], changed);
    if (status == STATUS_OK) status = update_relations_of_time(s, changed);
    if (*changed) changed_discrete(s);
    return status;
}

Status relations_indicators(Instance *s, double *z) {
    if (s->n_state_relations == 0) return STATUS_OK;
    if (evaluate_indicators(s) != STATUS_OK) return STATUS_DISCARD;
    for (size_t k = 0; k < s->n_state_relations; k++) {
        const size_t relation = s->state_relations[k];
        const double shift = HYSTERESIS * s->z_scale[relation] + DBL_MIN;
        z[k] = s->z[relation] + (s->r[relation] > 0.5 ? shift : -shift);
    }
    return STATUS_OK;
}

bool relation_is_crossed(const Instance *s, size_t k, double z) {
    return s->r[s->state_relations[k]] > 0.5 ? z < 0.0 : z > 0.0;
}

Status relations_are_crossed(Instance *s, bool *crossed) {
    *crossed = false;
    double *z = s->event.indicators;
    if (relations_indicators(s, z) != STATUS_OK) return STATUS_DISCARD;
    for (size_t k = 0; k < s->n_state_relations; k++) *crossed = *crossed || relation_is_crossed(s, k, z[k]);
    if (s->n_state_relations > 0) widen_scale(s);
    return STATUS_OK;
}
