#include "variables.h"

#include <math.h>

#include "evaluate.h"
#include "initialise.h"

static const unsigned BEFORE_START = PHASE_INSTANTIATED | PHASE_INITIALIZATION;
static const char *const type_names[] = {"Real", "Integer", "Boolean"};

const ModelVariable *variable_find(Instance *s, const char *function, uint32_t reference) {
    if (reference < s->model->n_variables) return &s->model->variables[reference];
    log_message(s, LOG_ERROR, "%s: there is no variable with value reference %lu; the largest is %lu.", function,
                (unsigned long)reference, (unsigned long)s->model->n_variables - 1);
    return NULL;
}

static const ModelVariable *find_of_type(Instance *s, const char *function, uint32_t reference, ScalarType type) {
    const ModelVariable *variable = variable_find(s, function, reference);
    if (!variable || variable->type == type) return variable;
    log_message(s, LOG_ERROR, "%s: %s is of type %s, not %s.", function, variable->name, type_names[variable->type],
                type_names[type]);
    return NULL;
}

/* Where the values of a vector are kept; null for an unknown vector. */
static double *values_of(Instance *s, uint8_t vector) {
    const bool before_start = s->memory->phase == PHASE_INSTANTIATED;
    switch (vector) {
        case VECTOR_T: return s->t;
        case VECTOR_P: return s->p;
        case VECTOR_C: return s->c;
        case VECTOR_X: return before_start ? s->user_x : s->x;
        case VECTOR_DX: return s->dx;
        case VECTOR_U: return s->u;
        case VECTOR_D: return before_start ? s->user_d : s->d;
        case VECTOR_W: return s->w;
        default: return NULL;
    }
}

static Status evaluate_vector(Instance *s, uint8_t vector) {
    switch (vector) {
        case VECTOR_C: return evaluate_calculated(s);
        case VECTOR_DX: return evaluate_derivatives(s);
        case VECTOR_W: return evaluate_outputs(s);
        default: return STATUS_OK;
    }
}

static bool has_start_value(const ModelVariable *v) {
    return v->vector != VECTOR_C && v->vector != VECTOR_DX && v->vector != VECTOR_W;
}

static Status bring_up_to_date(Instance *s, const char *function, const ModelVariable *v) {
    if (s->memory->phase == PHASE_INSTANTIATED) {
        if (has_start_value(v)) return STATUS_OK;
        log_message(s, LOG_ERROR, "%s: %s is calculated; it has no value before initialization mode.", function, v->name);
        return STATUS_ERROR;
    }
    if (s->memory->phase == PHASE_INITIALIZATION) {
        const Status status = initialise(s);
        if (status != STATUS_OK) return status;
    }
    return evaluate_vector(s, v->vector);
}

/* Whether the model computes it, so that the importer cannot know of a value that is not finite. evaluate_derivatives
   looks at dx itself. */
static bool may_surprise(const Instance *s, const ModelVariable *v) {
    const bool is_discrete = v->vector == VECTOR_D && s->memory->phase != PHASE_INSTANTIATED;
    return is_discrete || v->vector == VECTOR_C || v->vector == VECTOR_W;
}

Status variable_get(Instance *s, const char *function, uint32_t reference, ScalarType type, double *value) {
    const ModelVariable *v = find_of_type(s, function, reference, type);
    if (!v) return STATUS_ERROR;
    const Status status = bring_up_to_date(s, function, v);
    if (status != STATUS_OK) return status;
    *value = values_of(s, v->vector)[v->index];
    if (isfinite(*value) || !may_surprise(s, v)) return STATUS_OK;
    log_message(s, LOG_DISCARD, "%s: %s is %s at time %.16g s.", function, v->name,
                isnan(*value) ? "not a number" : "infinite", *s->t);
    return STATUS_DISCARD;
}

/* Whether it is a continuous state that may be set by its reference now, after initialization: in model exchange, at
   any point of continuous time, and in event mode where the event itself does not change it. FMI 3.0.2 says so in
   Sections 2.3.5 and 3.2.1; FMI 2.0 allows it in Section 3.1 and draws no such arrow in the state machine of 3.2.3.
   CasADi asks for it: it stays in event mode and sets states and inputs together, by fmi2SetReal or fmi3SetFloat64. */
static bool is_settable_state(const Instance *s, const ModelVariable *v) {
    if (v->vector != VECTOR_X || s->interface != MODEL_EXCHANGE || !s->model->states) return false;
    const ModelState *state = &s->model->states[v->index];
    return v == &s->model->variables[state->row] && (s->memory->phase == PHASE_CONTINUOUS || !state->reinit);
}

/* Why a variable must not be set now; null if it may be. */
static const char *objection(const Instance *s, const ModelVariable *v) {
    const unsigned phase = s->memory->phase;
    const bool is_input = v->causality == INPUT;
    if (v->vector == VECTOR_T || v->vector == VECTOR_C || v->vector == VECTOR_DX || v->vector == VECTOR_W)
        return "it is calculated by the model";
    if (v->variability == CONSTANT) return "it is constant";
    if (phase & BEFORE_START) {
        if (is_input || v->causality == PARAMETER || v->initial == INITIAL_EXACT) return NULL;
        return "its start value is calculated by the model";
    }
    if (is_input && phase == PHASE_CONTINUOUS && v->variability != CONTINUOUS)
        return "a discrete input can only be set in event mode";
    if (is_input || is_settable_state(s, v)) return NULL;
    if (v->causality != PARAMETER)
        return "only inputs and tunable parameters, in model exchange also states, can be set after initialization";
    if (v->variability != TUNABLE) return "a fixed parameter can only be set before initialization";
    return phase == PHASE_CONTINUOUS ? "a tunable parameter can only be set in event mode" : NULL;
}

static void store(Instance *s, const ModelVariable *v, double value) {
    const bool before_start = s->memory->phase & BEFORE_START;
    double *place = values_of(s, v->vector) + v->index;
    if (before_start && v->vector == VECTOR_X) place = s->user_x + v->index;
    if (before_start && v->vector == VECTOR_D) place = s->user_d + v->index;
    if (*place == value) return;
    *place = value;
    s->memory->is_disturbed = 1;
    if (before_start || v->vector == VECTOR_P)
        changed_parameters(s);
    else
        changed_point(s);
}

Status variable_set(Instance *s, const char *function, uint32_t reference, ScalarType type, double value) {
    const ModelVariable *v = find_of_type(s, function, reference, type);
    if (!v) return STATUS_ERROR;
    const char *why = objection(s, v);
    if (why) {
        log_message(s, LOG_ERROR, "%s: %s cannot be set now: %s.", function, v->name, why);
        return STATUS_ERROR;
    }
    if (!isfinite(value)) {
        log_message(s, LOG_ERROR, "%s: %s cannot be set to %g; give it a number.", function, v->name, value);
        return STATUS_ERROR;
    }
    store(s, v, value);
    return STATUS_OK;
}
