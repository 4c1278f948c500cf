/* FMI 2.0: getting and setting values. */
#include <math.h>

#include "fmi2_front.h"
#include "variables.h"

/* Get and set for each type: the loop is the same, the C type of the values is not. */
#define GET(Type, type_code, from_double)                                                                     \
    fmi2Status fmi2Get##Type(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2##Type value[]) { \
        static const char *const here = "fmi2Get" #Type;                                                      \
        Instance *s = fmi2_enter(c, IN_GET, here);                                                                 \
        if (!s || !fmi2_are_arrays(s, here, vr, value, nvr)) return fmi2Error;                                     \
        for (size_t k = 0; k < nvr; k++) {                                                                    \
            double x = 0.0;                                                                                   \
            const Status status = variable_get(s, here, vr[k], type_code, &x);                                \
            if (status != STATUS_OK) return (fmi2Status)status;                                               \
            value[k] = from_double;                                                                           \
        }                                                                                                     \
        return fmi2OK;                                                                                        \
    }

#define SET(Type, type_code, phases, to_double)                                                                     \
    fmi2Status fmi2Set##Type(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2##Type value[]) { \
        static const char *const here = "fmi2Set" #Type;                                                            \
        Instance *s = fmi2_enter(c, phases, here);                                                                       \
        if (!s || !fmi2_are_arrays(s, here, vr, value, nvr)) return fmi2Error;                                           \
        for (size_t k = 0; k < nvr; k++) {                                                                          \
            const Status status = variable_set(s, here, vr[k], type_code, to_double);                               \
            if (status != STATUS_OK) return (fmi2Status)status;                                                     \
        }                                                                                                           \
        return fmi2OK;                                                                                              \
    }

GET(Real, TYPE_REAL, x)
GET(Integer, TYPE_INTEGER, (fmi2Integer)lround(x))
GET(Boolean, TYPE_BOOLEAN, x > 0.5 ? fmi2True : fmi2False)
SET(Real, TYPE_REAL, IN_SET, value[k])
SET(Integer, TYPE_INTEGER, IN_SET_DISCRETE, (double)value[k])
SET(Boolean, TYPE_BOOLEAN, IN_SET_DISCRETE, value[k] ? 1.0 : 0.0)

static fmi2Status no_strings(fmi2Component c, const char *function, size_t nvr) {
    Instance *s = fmi2_enter(c, IN_ANY, function);
    if (!s) return fmi2Error;
    if (nvr == 0) return fmi2OK;
    log_message(s, LOG_ERROR, "%s: the model has no String variables.", function);
    return fmi2Error;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[]) {
    (void)vr;
    (void)value;
    return no_strings(c, "fmi2GetString", nvr);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[]) {
    (void)vr;
    (void)value;
    return no_strings(c, "fmi2SetString", nvr);
}
