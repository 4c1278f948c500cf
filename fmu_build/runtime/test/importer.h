/* An FMI 2 importer's common moves, for the test programs. */
#ifndef IMPORTER_H
#define IMPORTER_H

#include <stdarg.h>
#include <string.h>

#include "check.h"
#include "fmi2Functions.h"
#include "model.h"

static char last_message[2048];
static int messages; /* of any category */

static void keep_message(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                         fmi2String format, ...) {
    (void)environment, (void)name, (void)status, (void)category;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(last_message, sizeof last_message, format, arguments);
    va_end(arguments);
    messages++;
}

static const fmi2CallbackFunctions callbacks = {keep_message, NULL, NULL, NULL, NULL};

/* True if the last call left a message that holds `part`. */
static inline int logged(const char *part) {
    if (strstr(last_message, part)) return 1;
    fprintf(stderr, "last message: %s\n", last_message);
    return 0;
}

static inline fmi2Component instantiate(fmi2Type type) {
    fmi2Component c = fmi2Instantiate("test", type, model.token, NULL, &callbacks, fmi2False, fmi2False);
    CHECK(c);
    return c;
}

static inline void initialise_from(fmi2Component c, double start, double tolerance) {
    CHECK(fmi2SetupExperiment(c, tolerance > 0.0, tolerance, start, fmi2False, 0.0) == fmi2OK);
    CHECK(fmi2EnterInitializationMode(c) == fmi2OK);
    CHECK(fmi2ExitInitializationMode(c) == fmi2OK);
}

static inline fmi2ValueReference reference(const char *name) {
    for (size_t k = 0; k < model.n_variables; k++)
        if (strcmp(model.variables[k].name, name) == 0) return (fmi2ValueReference)k;
    fprintf(stderr, "no variable %s\n", name);
    exit(1);
}

static inline double get(fmi2Component c, const char *name) {
    const fmi2ValueReference vr = reference(name);
    double value = NAN;
    if (fmi2GetReal(c, &vr, 1, &value) != fmi2OK) fprintf(stderr, "%s: %s\n", name, last_message), exit(1);
    return value;
}

static inline fmi2Status set(fmi2Component c, const char *name, double value) {
    const fmi2ValueReference vr = reference(name);
    return fmi2SetReal(c, &vr, 1, &value);
}

static inline int get_integer(fmi2Component c, const char *name) {
    const fmi2ValueReference vr = reference(name);
    int value = -1;
    CHECK(fmi2GetInteger(c, &vr, 1, &value) == fmi2OK);
    return value;
}

/* Steps of `size` from `start` to `stop`, with times computed, not added up. */
static inline void run_steps(fmi2Component c, double start, double stop, double size) {
    const long n = lround((stop - start) / size);
    for (long k = 0; k < n; k++) {
        const double here = start + (double)k * size, next = k + 1 < n ? start + (double)(k + 1) * size : stop;
        CHECK(fmi2DoStep(c, here, next - here, fmi2True) == fmi2OK);
    }
}

/* Model exchange: event iteration, then continuous-time mode. */
static inline fmi2EventInfo handle_event(fmi2Component c) {
    fmi2EventInfo info = {0};
    CHECK(fmi2NewDiscreteStates(c, &info) <= fmi2Warning);
    CHECK(!info.newDiscreteStatesNeeded);
    CHECK(fmi2EnterContinuousTimeMode(c) == fmi2OK);
    return info;
}

#endif
