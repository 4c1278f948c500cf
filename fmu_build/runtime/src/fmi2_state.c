/* FMI 2.0: saved states and partial derivatives. */
#include "fmi2_front.h"
#include "sensitivity.h"
#include "state.h"

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    static const char *const here = "fmi2GetFMUstate";
    Instance *s = fmi2_enter(c, IN_ANY, here);
    if (!s || !instance_no_null(s, here, FMUstate)) return fmi2Error;
    SavedState *state = *FMUstate;
    const Status status = state_save(s, here, &state);
    *FMUstate = state;
    return (fmi2Status)status;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
    static const char *const here = "fmi2SetFMUstate";
    Instance *s = fmi2_enter(c, IN_ANY, here);
    if (!s || !instance_no_null(s, here, FMUstate)) return fmi2Error;
    return (fmi2Status)state_restore(s, here, FMUstate);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    if (!fmi2_enter(c, IN_ANY, "fmi2FreeFMUstate")) return fmi2Error;
    if (!FMUstate) return fmi2OK;
    state_free(*FMUstate);
    *FMUstate = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
    static const char *const here = "fmi2SerializedFMUstateSize";
    Instance *s = fmi2_enter(c, IN_ANY, here);
    if (!s || !instance_no_null(s, here, FMUstate) || !instance_no_null(s, here, size)) return fmi2Error;
    *size = state_size(s);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte bytes[], size_t size) {
    static const char *const here = "fmi2SerializeFMUstate";
    Instance *s = fmi2_enter(c, IN_ANY, here);
    if (!s || !instance_no_null(s, here, FMUstate) || !instance_no_null(s, here, bytes)) return fmi2Error;
    return (fmi2Status)state_serialise(s, here, FMUstate, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *FMUstate) {
    static const char *const here = "fmi2DeSerializeFMUstate";
    Instance *s = fmi2_enter(c, IN_ANY, here);
    if (!s || !instance_no_null(s, here, bytes) || !instance_no_null(s, here, FMUstate)) return fmi2Error;
    SavedState *state = NULL;
    const Status status = state_deserialise(s, here, bytes, size, &state);
    if (status == STATUS_OK) *FMUstate = state;
    return (fmi2Status)status;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
    static const char *const here = "fmi2GetDirectionalDerivative";
    Instance *s = fmi2_enter(c, IN_PARTIALS, here);
    if (!s || !fmi2_are_arrays(s, here, vUnknown_ref, dvUnknown, nUnknown) ||
        !fmi2_are_arrays(s, here, vKnown_ref, dvKnown, nKnown))
        return fmi2Error;
    const Partials partials = {vUnknown_ref, vKnown_ref, nUnknown, nKnown};
    return (fmi2Status)directional_derivative(s, here, &partials, dvKnown, dvUnknown);
}
