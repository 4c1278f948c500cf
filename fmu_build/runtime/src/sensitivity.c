#include "sensitivity.h"

#include "evaluate.h"
#include "initialise.h"
#include "linear.h"
#include "linearise.h"
#include "variables.h"
#include "vector.h"

/* Seeds and weights are zero whenever nobody works with them. */
static void clear_seeds(Instance *s) {
    const Model *m = s->model;
    DerivativeWork *w = &s->derivative;
    clear(w->seed_x, m->n_x);
    clear(w->seed_u, m->n_u);
    clear(w->seed_p, m->n_p);
    clear(w->seed_q, m->n_q);
    clear(w->weight_dx, m->n_x);
    clear(w->weight_w, m->n_w);
    clear(w->weight_g, m->n_q);
}

/* Entry of a variable in arrays given per vector; null if the vector has none. */
typedef struct {
    double *x, *u, *p, *dx, *w;
} Entries;

static double *entry(const Entries *entries, const ModelVariable *v) {
    double *values = NULL;
    switch (v->vector) {
        case VECTOR_X: values = entries->x; break;
        case VECTOR_U: values = entries->u; break;
        case VECTOR_P: values = entries->p; break;
        case VECTOR_DX: values = entries->dx; break;
        case VECTOR_W: values = entries->w; break;
        default: break;
    }
    return values ? values + v->index : NULL;
}

/* Checks all references before anything is computed. */
static Status check_references(Instance *s, const char *function, const uint32_t *references, size_t n,
                               const Entries *entries, const char *role) {
    for (size_t k = 0; k < n; k++) {
        const ModelVariable *v = variable_find(s, function, references[k]);
        if (!v) return STATUS_ERROR;
        if (v->type == TYPE_REAL && (entry(entries, v) || v->vector == VECTOR_D)) continue;
        log_message(s, LOG_ERROR, "%s: %s cannot be %s of a partial derivative.", function, v->name, role);
        return STATUS_ERROR;
    }
    return STATUS_OK;
}

static void add_seeds(Instance *s, const uint32_t *references, size_t n, const Entries *entries, const double *seed) {
    for (size_t k = 0; k < n; k++) {
        double *place = entry(entries, &s->model->variables[references[k]]);
        if (place) *place += seed[k];
    }
}

static void read_results(const Instance *s, const uint32_t *references, size_t n, const Entries *entries, double *result) {
    for (size_t k = 0; k < n; k++) {
        const double *place = entry(entries, &s->model->variables[references[k]]);
        result[k] = place ? *place : 0.0; /* discrete variables are constant between events */
    }
}

/* While the model is initialised, states may depend on parameters through the initial problem, which `forward` does
   not know of. */
static Status prepare(Instance *s, const char *function) {
    if (s->memory->phase == PHASE_INITIALIZATION) {
        bool fixed_start = s->model->n_i == 0;
        for (size_t k = 0; k < s->model->n_variables; k++) {
            const ModelVariable *v = &s->model->variables[k];
            if ((v->vector == VECTOR_X || v->vector == VECTOR_D) && v->initial != INITIAL_EXACT) fixed_start = false;
        }
        if (!fixed_start) {
            log_message(s, LOG_ERROR, "%s: in initialization mode only for a model whose start values are all given.",
                        function);
            return STATUS_ERROR;
        }
        const Status status = initialise(s);
        if (status != STATUS_OK) return status;
    }
    return evaluate_unknowns(s);
}

static void negate(double *values, size_t n) {
    for (size_t k = 0; k < n; k++) values[k] = -values[k];
}

static bool all_in(const Instance *s, const uint32_t *references, size_t n, Vector vector) {
    for (size_t k = 0; k < n; k++)
        if (references[k] >= s->model->n_variables || s->model->variables[references[k]].vector != vector) return false;
    return true;
}

static bool all_real_parameters(const Instance *s, const Partials *partials) {
    for (size_t k = 0; k < partials->n_knowns; k++)
        if (!all_in(s, partials->knowns + k, 1, VECTOR_P) ||
            s->model->variables[partials->knowns[k]].type != TYPE_REAL)
            return false;
    return true;
}

/* Derivatives of dx by states or by parameters, as an integrator asks for them one by one: all come from one matrix. */
static Status jacobian_times(Instance *s, bool by_states, const Partials *partials, const double *seed, double *change) {
    const ModelVariable *variables = s->model->variables;
    const double *matrix = by_states ? s->jacobian.xx : s->jacobian.xp;
    if ((by_states ? evaluate_jacobian(s) : evaluate_by_parameters(s)) != STATUS_OK) return STATUS_DISCARD;
    for (size_t i = 0; i < partials->n_unknowns; i++) {
        const double *row = matrix + variables[partials->unknowns[i]].index;
        double sum = 0.0;
        for (size_t j = 0; j < partials->n_knowns; j++)
            sum += row[variables[partials->knowns[j]].index * s->model->n_x] * seed[j];
        change[i] = sum;
    }
    return STATUS_OK;
}

/* Outputs and all that is kept with them cost more than the derivatives: their tangents only if one is asked for. */
static bool any_in(const Instance *s, const uint32_t *references, size_t n, Vector vector) {
    for (size_t k = 0; k < n; k++)
        if (s->model->variables[references[k]].vector == vector) return true;
    return false;
}

/* Tangents of dx, and of w if wanted, for the seeds of x, u and p; first those of q, from g(q) = 0. */
static Status tangents(Instance *s, bool with_w) {
    DerivativeWork *w = &s->derivative;
    const size_t n_q = s->model->n_q;
    if (n_q > 0) {
        double *res_g[] = {NULL, NULL, w->out_g};
        if (factor_blocks(s) != STATUS_OK) return STATUS_DISCARD;
        if (call_model(s, s->model->forward, res_g) != STATUS_OK) return STATUS_DISCARD;
        copy(w->seed_q, w->out_g, n_q);
        lu_solve(n_q, s->jacobian.qq, s->jacobian.pivot, w->seed_q);
        negate(w->seed_q, n_q);
    }
    double *res[] = {w->out_dx, with_w ? w->out_w : NULL, NULL};
    return call_model(s, s->model->forward, res);
}

/* Weights of x, u and p for those of dx and w; first those of g. */
static Status weights(Instance *s) {
    DerivativeWork *w = &s->derivative;
    const size_t n_q = s->model->n_q;
    if (n_q > 0) {
        double *res_q[] = {NULL, NULL, NULL, w->out_q, NULL};
        if (factor_blocks(s) != STATUS_OK) return STATUS_DISCARD;
        if (call_model(s, s->model->reverse, res_q) != STATUS_OK) return STATUS_DISCARD;
        copy(w->weight_g, w->out_q, n_q);
        lu_solve_transposed(n_q, s->jacobian.qq, s->jacobian.pivot, w->weight_g);
        negate(w->weight_g, n_q);
    }
    double *res[] = {w->out_x, w->out_u, w->out_p, NULL, NULL};
    return call_model(s, s->model->reverse, res);
}

Status directional_derivative(Instance *s, const char *function, const Partials *partials, const double *seed,
                              double *change) {
    DerivativeWork *w = &s->derivative;
    const Entries seeds = {w->seed_x, w->seed_u, w->seed_p, NULL, NULL};
    const Entries results = {w->seed_x, w->seed_u, w->seed_p, w->out_dx, w->out_w};
    const bool of_dx = all_in(s, partials->unknowns, partials->n_unknowns, VECTOR_DX);
    const bool by_states = of_dx && all_in(s, partials->knowns, partials->n_knowns, VECTOR_X);
    const bool is_jacobian = by_states || (of_dx && has_by_parameters(s->model) && all_real_parameters(s, partials));
    Status status = STATUS_OK;
    if (!is_jacobian) status = check_references(s, function, partials->knowns, partials->n_knowns, &seeds, "a known");
    if (!is_jacobian && status == STATUS_OK)
        status = check_references(s, function, partials->unknowns, partials->n_unknowns, &results, "an unknown");
    if (status == STATUS_OK) status = prepare(s, function);
    if (status != STATUS_OK) return status;
    if (is_jacobian) return jacobian_times(s, by_states, partials, seed, change);
    add_seeds(s, partials->knowns, partials->n_knowns, &seeds, seed);
    status = tangents(s, any_in(s, partials->unknowns, partials->n_unknowns, VECTOR_W));
    if (status == STATUS_OK) read_results(s, partials->unknowns, partials->n_unknowns, &results, change);
    clear_seeds(s);
    return status;
}

Status adjoint_derivative(Instance *s, const char *function, const Partials *partials, const double *seed,
                          double *change) {
    DerivativeWork *w = &s->derivative;
    /* An unknown that is itself a state, an input or a parameter weighs on that directly. */
    const Entries seeds = {w->seed_x, w->seed_u, w->seed_p, w->weight_dx, w->weight_w};
    const Entries results = {w->out_x, w->out_u, w->out_p, NULL, NULL};
    Status status = check_references(s, function, partials->knowns, partials->n_knowns, &results, "a known");
    if (status == STATUS_OK)
        status = check_references(s, function, partials->unknowns, partials->n_unknowns, &seeds, "an unknown");
    if (status == STATUS_OK) status = prepare(s, function);
    if (status != STATUS_OK) return status;
    add_seeds(s, partials->unknowns, partials->n_unknowns, &seeds, seed);
    status = weights(s);
    for (size_t k = 0; k < s->model->n_x; k++) w->out_x[k] += w->seed_x[k];
    for (size_t k = 0; k < s->model->n_u; k++) w->out_u[k] += w->seed_u[k];
    for (size_t k = 0; k < s->model->n_p; k++) w->out_p[k] += w->seed_p[k];
    if (status == STATUS_OK) read_results(s, partials->knowns, partials->n_knowns, &results, change);
    clear_seeds(s);
    return status;
}
