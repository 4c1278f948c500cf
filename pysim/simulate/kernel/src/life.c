/* The life of an instance up to its first event. */
#include <stdbool.h>

#include "fmi.h"

enum { MODEL_EXCHANGE = 0 }; /* fmi2Type */

typedef int Plain(void *);
typedef void Free(void *);
typedef void *Instantiate2(const char *, int, const char *, const char *, const void *, int, int);
typedef void *Instantiate3(const char *, const char *, const char *, bool, bool, void *,
                           void (*)(void *, int, const char *, const char *));
typedef int Set2(void *, const uint32_t *, size_t, const void *);
typedef int Set3(void *, const uint32_t *, size_t, const void *, size_t);
typedef int Setup2(void *, int, double, double, int, double);
typedef int Enter3(void *, bool, double, double, bool, double);

void fmi_release(Fmu *fmu) {
    if (fmu->instance && fmu->status < FATAL) ((Free *)fmu->free_instance)(fmu->instance);
    fmu->instance = NULL;
}

static void *instantiate(const Fmu *fmu) {
    if (fmu->version == 2)
        return ((Instantiate2 *)fmu->instantiate)(fmu->name, MODEL_EXCHANGE, fmu->token, fmu->resources, fmu->callbacks, 0, 0);
    return ((Instantiate3 *)fmu->instantiate)(fmu->name, fmu->token, fmu->resources, false, false, fmu->log, fmi_log_3);
}

int fmi_renew(Fmu *fmu) {
    const bool may_reset = fmu->instance && fmu->status < ERROR && !fmu->refuses_reset;
    fmu->log->count = 0;
    if (may_reset) {
        fmu->status = OK;
        if (((Plain *)fmu->reset)(fmu->instance) <= WARNING) return OK;
        fmu->refuses_reset = 1;
    }
    fmi_release(fmu);
    fmu->log->count = 0;
    fmu->status = OK;
    fmu->instance = instantiate(fmu);
    return fmu->instance ? OK : ERROR;
}

int fmi_set_values(const Fmu *fmu, Function *setter, const uint32_t *references, const void *values, int64_t n) {
    if (fmu->version == 2) return ((Set2 *)setter)(fmu->instance, references, (size_t)n, values);
    return ((Set3 *)setter)(fmu->instance, references, (size_t)n, values, (size_t)n);
}

int fmi_setup(const Fmu *fmu, double tolerance, double start, double stop) {
    if (fmu->version != 2) return OK;
    return ((Setup2 *)fmu->setup_experiment)(fmu->instance, tolerance > 0.0, tolerance, start, 1, stop);
}

int fmi_enter_initialisation(const Fmu *fmu, double tolerance, double start, double stop) {
    if (fmu->version == 2) return ((Plain *)fmu->enter_initialisation)(fmu->instance);
    return ((Enter3 *)fmu->enter_initialisation)(fmu->instance, tolerance > 0.0, tolerance, start, true, stop);
}

int fmi_exit_initialisation(const Fmu *fmu) { return ((Plain *)fmu->exit_initialisation)(fmu->instance); }
