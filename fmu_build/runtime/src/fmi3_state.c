/* FMI 3.0: saved states and partial derivatives. */
#include "fmi3_front.h"
#include "sensitivity.h"
#include "state.h"

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    static const char *const here = "fmi3GetFMUState";
    Instance *s = fmi3_enter(instance, IN_STATE, here);
    if (!s || !instance_no_null(s, here, FMUState)) return fmi3Error;
    SavedState *state = *FMUState;
    const Status status = state_save(s, here, &state);
    *FMUState = state;
    return (fmi3Status)status;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
    static const char *const here = "fmi3SetFMUState";
    Instance *s = fmi3_enter(instance, IN_STATE, here);
    if (!s || !instance_no_null(s, here, FMUState)) return fmi3Error;
    return (fmi3Status)state_restore(s, here, FMUState);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    if (!fmi3_enter(instance, IN_ANY, "fmi3FreeFMUState")) return fmi3Error;
    if (!FMUState) return fmi3OK;
    state_free(*FMUState);
    *FMUState = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
    static const char *const here = "fmi3SerializedFMUStateSize";
    Instance *s = fmi3_enter(instance, IN_ANY, here);
    if (!s || !instance_no_null(s, here, FMUState) || !instance_no_null(s, here, size)) return fmi3Error;
    *size = state_size(s);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[],
                                 size_t size) {
    static const char *const here = "fmi3SerializeFMUState";
    Instance *s = fmi3_enter(instance, IN_ANY, here);
    if (!s || !instance_no_null(s, here, FMUState) || !instance_no_null(s, here, serializedState)) return fmi3Error;
    return (fmi3Status)state_serialise(s, here, FMUState, (char *)serializedState, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState) {
    static const char *const here = "fmi3DeserializeFMUState";
    Instance *s = fmi3_enter(instance, IN_ANY, here);
    if (!s || !instance_no_null(s, here, serializedState) || !instance_no_null(s, here, FMUState)) return fmi3Error;
    SavedState *state = NULL;
    const Status status = state_deserialise(s, here, (const char *)serializedState, size, &state);
    if (status == STATUS_OK) *FMUState = state;
    return (fmi3Status)status;
}

typedef Status DerivativeFunction(Instance *s, const char *function, const Partials *partials, const double *seed,
                                  double *change);

/* `n_seed` and `n_change` must be the lengths that the references imply. */
static fmi3Status partial_derivative(fmi3Instance instance, const char *here, DerivativeFunction *derivative,
                                     const Partials *partials, const double *seed, size_t n_seed, double *change,
                                     size_t n_change) {
    const bool forward = derivative == directional_derivative;
    Instance *s = fmi3_enter(instance, IN_VALUES, here);
    if (!s || !instance_is_array(s, here, seed, n_seed, forward ? partials->n_knowns : partials->n_unknowns) ||
        !instance_is_array(s, here, change, n_change, forward ? partials->n_unknowns : partials->n_knowns))
        return fmi3Error;
    if ((partials->n_unknowns > 0 && !instance_no_null(s, here, partials->unknowns)) ||
        (partials->n_knowns > 0 && !instance_no_null(s, here, partials->knowns)))
        return fmi3Error;
    return (fmi3Status)derivative(s, here, partials, seed, change);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                        size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity) {
    const Partials partials = {unknowns, knowns, nUnknowns, nKnowns};
    return partial_derivative(instance, "fmi3GetDirectionalDerivative", directional_derivative, &partials, seed, nSeed,
                              sensitivity, nSensitivity);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                    const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                    size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity) {
    const Partials partials = {unknowns, knowns, nUnknowns, nKnowns};
    return partial_derivative(instance, "fmi3GetAdjointDerivative", adjoint_derivative, &partials, seed, nSeed,
                              sensitivity, nSensitivity);
}
