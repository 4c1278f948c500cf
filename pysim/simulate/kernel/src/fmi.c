#include "fmi.h"

#include <math.h>
#include <stdbool.h>

/* Signatures of FMI 2.0.4 and FMI 3.0.1; where both agree but for the names, one stands for both. */
typedef int Plain(void *);
typedef int SetTime(void *, double);
typedef int SetVector(void *, const double *, size_t);
typedef int GetVector(void *, double *, size_t);
typedef int Set2(void *, const uint32_t *, size_t, const double *);
typedef int Set3(void *, const uint32_t *, size_t, const double *, size_t);
typedef int Get2(void *, const uint32_t *, size_t, void *);
typedef int Get3(void *, const uint32_t *, size_t, void *, size_t);
typedef int Directional2(void *, const uint32_t *, size_t, const uint32_t *, size_t, const double *, double *);
typedef int Directional3(void *, const uint32_t *, size_t, const uint32_t *, size_t, const double *, size_t, double *,
                         size_t);
typedef int Matrices(void *, const double **, const double **);
typedef int Completed2(void *, int, int *, int *);
typedef int Completed3(void *, bool, bool *, bool *);
typedef struct {
    int again, terminate, nominals_changed, states_changed, next_defined;
    double next_time;
} EventInfo2;
typedef int Update2(void *, EventInfo2 *);
typedef int Update3(void *, bool *, bool *, bool *, bool *, bool *, double *);

int fmi_set_time(const Fmu *fmu, double t) { return ((SetTime *)fmu->set_time)(fmu->instance, t); }

int fmi_set_states(const Fmu *fmu, const double *x, int64_t n) {
    return n > 0 ? ((SetVector *)fmu->set_states)(fmu->instance, x, (size_t)n) : OK;
}

int fmi_get_states(const Fmu *fmu, double *x, int64_t n) {
    return n > 0 ? ((GetVector *)fmu->get_states)(fmu->instance, x, (size_t)n) : OK;
}

int fmi_get_derivatives(const Fmu *fmu, double *dx, int64_t n) {
    return n > 0 ? ((GetVector *)fmu->get_derivatives)(fmu->instance, dx, (size_t)n) : OK;
}

int fmi_get_indicators(const Fmu *fmu, double *z, int64_t n) {
    return n > 0 ? ((GetVector *)fmu->get_indicators)(fmu->instance, z, (size_t)n) : OK;
}

int fmi_get_nominals(const Fmu *fmu, double *nominal, int64_t n) {
    const int status = n > 0 ? ((GetVector *)fmu->get_nominals)(fmu->instance, nominal, (size_t)n) : OK;
    for (int64_t i = 0; i < n; i++) {
        const double size = fabs(nominal[i]);
        nominal[i] = size > 0.0 && size < INFINITY ? size : 1.0;
    }
    return status;
}

int fmi_set_reals(const Fmu *fmu, const uint32_t *references, const double *values, int64_t n) {
    if (fmu->version == 2) return ((Set2 *)fmu->set_reals)(fmu->instance, references, (size_t)n, values);
    return ((Set3 *)fmu->set_reals)(fmu->instance, references, (size_t)n, values, (size_t)n);
}

int fmi_get_values(const Fmu *fmu, Function *getter, const uint32_t *references, void *values, int64_t n) {
    if (fmu->version == 2) return ((Get2 *)getter)(fmu->instance, references, (size_t)n, values);
    return ((Get3 *)getter)(fmu->instance, references, (size_t)n, values, (size_t)n);
}

int fmi_get_directional(const Fmu *fmu, const uint32_t *unknowns, int64_t n_unknowns, const uint32_t *knowns,
                        int64_t n_knowns, const double *seed, double *result) {
    const size_t n_u = (size_t)n_unknowns, n_k = (size_t)n_knowns;
    if (fmu->version == 2)
        return ((Directional2 *)fmu->get_directional)(fmu->instance, unknowns, n_u, knowns, n_k, seed, result);
    return ((Directional3 *)fmu->get_directional)(fmu->instance, unknowns, n_u, knowns, n_k, seed, n_k, result, n_u);
}

int fmi_get_matrices(const Fmu *fmu, const double **by_states, const double **by_parameters) {
    return ((Matrices *)fmu->get_matrices)(fmu->instance, by_states, by_parameters);
}

int fmi_completed_step(Fmu *fmu) {
    fmu->event = fmu->terminate = 0;
    if (!fmu->needs_completed_step) return OK;
    int status;
    if (fmu->version == 2) {
        int event = 0, terminate = 0;
        status = ((Completed2 *)fmu->completed_step)(fmu->instance, 1, &event, &terminate);
        fmu->event = event, fmu->terminate = terminate;
    } else {
        bool event = false, terminate = false;
        status = ((Completed3 *)fmu->completed_step)(fmu->instance, true, &event, &terminate);
        fmu->event = event, fmu->terminate = terminate;
    }
    return status;
}

int fmi_enter_event_mode(const Fmu *fmu) { return ((Plain *)fmu->enter_event_mode)(fmu->instance); }

int fmi_enter_continuous_mode(const Fmu *fmu) { return ((Plain *)fmu->enter_continuous_mode)(fmu->instance); }

int fmi_update_discrete(Fmu *fmu) {
    int status;
    if (fmu->version == 2) {
        EventInfo2 info = {0};
        status = ((Update2 *)fmu->update_discrete)(fmu->instance, &info);
        fmu->again = info.again, fmu->terminate = info.terminate;
        fmu->nominals_changed = info.nominals_changed, fmu->states_changed = info.states_changed;
        fmu->next_time = info.next_defined ? info.next_time : INFINITY;
    } else {
        bool again = false, terminate = false, nominals = false, states = false, defined = false;
        double next = 0.0;
        status = ((Update3 *)fmu->update_discrete)(fmu->instance, &again, &terminate, &nominals, &states, &defined, &next);
        fmu->again = again, fmu->terminate = terminate;
        fmu->nominals_changed = nominals, fmu->states_changed = states;
        fmu->next_time = defined ? next : INFINITY;
    }
    return status;
}
