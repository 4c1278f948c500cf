/* Not of the FMI standard: whole matrices of partial derivatives in one call, for an importer that knows our FMUs. One
   that does not asks for them column by column. */
#include "linearise.h"

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

EXPORT int htbMatrices(void *instance, const double **by_states, const double **by_parameters);
EXPORT int64_t htbParameterColumn(void *instance, uint32_t reference);

/* At the present point, the derivatives by the states (n_x, n_x) and by the parameters (n_x, n_p), column after column;
   they stay where they are. `by_parameters` may be null, and null is left there where the model has no such matrix. */
int htbMatrices(void *instance, const double **by_states, const double **by_parameters) {
    Instance *s = instance;
    if (!s || !by_states || !instance_in_phase(s, PHASE_EVENT | PHASE_CONTINUOUS, "htbMatrices")) return STATUS_ERROR;
    const bool both = by_parameters && has_by_parameters(s->model);
    if ((both ? evaluate_matrices(s) : evaluate_jacobian(s)) != STATUS_OK) return STATUS_DISCARD;
    *by_states = s->jacobian.xx;
    if (by_parameters) *by_parameters = both ? s->jacobian.xp : NULL;
    return STATUS_OK;
}

/* Which column of `by_parameters` belongs to a variable; -1 where none does. */
int64_t htbParameterColumn(void *instance, uint32_t reference) {
    const Instance *s = instance;
    if (!s || !has_by_parameters(s->model) || reference >= s->model->n_variables) return -1;
    const ModelVariable *v = &s->model->variables[reference];
    return v->vector == VECTOR_P && v->type == TYPE_REAL ? (int64_t)v->index : -1;
}
