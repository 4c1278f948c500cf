/* FMI 3.0: getting and setting values. Real variables are Float64, Integer ones Int32 or, as enumerations are
   declared, Int64; there are no others. */
#include <math.h>

#include "fmi3_front.h"
#include "variables.h"

static Instance *enter_access(fmi3Instance instance, unsigned phases, const char *function,
                              const fmi3ValueReference *references, size_t n_references, const void *values,
                              size_t n_values) {
    Instance *s = fmi3_enter(instance, phases, function);
    if (!s || !instance_is_array(s, function, values, n_values, n_references)) return NULL;
    return n_references == 0 || instance_no_null(s, function, references) ? s : NULL;
}

/* The loops are the same for each type, the C type of the values is not. */
#define GET(Type, type_code, from_double)                                                                             \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                       \
                             size_t nValueReferences, fmi3##Type values[], size_t nValues) {                          \
        static const char *const here = "fmi3Get" #Type;                                                              \
        Instance *s = enter_access(instance, IN_ANY, here, valueReferences, nValueReferences, values, nValues);       \
        if (!s) return fmi3Error;                                                                                     \
        for (size_t k = 0; k < nValues; k++) {                                                                        \
            double x = 0.0;                                                                                           \
            const Status status = variable_get(s, here, valueReferences[k], type_code, &x);                           \
            if (status != STATUS_OK) return (fmi3Status)status;                                                       \
            values[k] = from_double;                                                                                  \
        }                                                                                                             \
        return fmi3OK;                                                                                                \
    }

#define SET(Type, type_code, phases, to_double)                                                                       \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                       \
                             size_t nValueReferences, const fmi3##Type values[], size_t nValues) {                    \
        static const char *const here = "fmi3Set" #Type;                                                              \
        Instance *s = enter_access(instance, phases, here, valueReferences, nValueReferences, values, nValues);       \
        if (!s) return fmi3Error;                                                                                     \
        for (size_t k = 0; k < nValues; k++) {                                                                        \
            const Status status = variable_set(s, here, valueReferences[k], type_code, to_double);                    \
            if (status != STATUS_OK) return (fmi3Status)status;                                                       \
        }                                                                                                             \
        return fmi3OK;                                                                                                \
    }

GET(Float64, TYPE_REAL, x)
GET(Int32, TYPE_INTEGER, (fmi3Int32)lround(x))
GET(Int64, TYPE_INTEGER, (fmi3Int64)llround(x))
GET(Boolean, TYPE_BOOLEAN, x > 0.5)
SET(Float64, TYPE_REAL, IN_SET, values[k])
SET(Int32, TYPE_INTEGER, IN_SET_DISCRETE, (double)values[k])
SET(Int64, TYPE_INTEGER, IN_SET_DISCRETE, (double)values[k])
SET(Boolean, TYPE_BOOLEAN, IN_SET_DISCRETE, values[k] ? 1.0 : 0.0)

static fmi3Status no_variables(fmi3Instance instance, size_t n, const char *function) {
    Instance *s = fmi3_enter(instance, IN_ANY, function);
    if (!s) return fmi3Error;
    if (n == 0) return fmi3OK;
    log_message(s, LOG_ERROR, "%s: the model has no variables of this type.", function);
    return fmi3Error;
}

#define NO_VARIABLES(Type)                                                                                           \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                       \
                             size_t nValueReferences, fmi3##Type values[], size_t nValues) {                          \
        (void)valueReferences, (void)values, (void)nValues;                                                           \
        return no_variables(instance, nValueReferences, "fmi3Get" #Type);                                             \
    }                                                                                                                 \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference valueReferences[],                       \
                             size_t nValueReferences, const fmi3##Type values[], size_t nValues) {                    \
        (void)valueReferences, (void)values, (void)nValues;                                                           \
        return no_variables(instance, nValueReferences, "fmi3Set" #Type);                                             \
    }

NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(UInt32)
NO_VARIABLES(UInt64)
NO_VARIABLES(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         size_t valueSizes[], fmi3Binary values[], size_t nValues) {
    (void)valueReferences, (void)valueSizes, (void)values, (void)nValues;
    return no_variables(instance, nValueReferences, "fmi3GetBinary");
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         const size_t valueSizes[], const fmi3Binary values[], size_t nValues) {
    (void)valueReferences, (void)valueSizes, (void)values, (void)nValues;
    return no_variables(instance, nValueReferences, "fmi3SetBinary");
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Clock values[]) {
    (void)valueReferences, (void)values;
    return no_variables(instance, nValueReferences, "fmi3GetClock");
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        const fmi3Clock values[]) {
    (void)valueReferences, (void)values;
    return no_variables(instance, nValueReferences, "fmi3SetClock");
}
