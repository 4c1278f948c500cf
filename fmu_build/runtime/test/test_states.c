/* Saved states, for any model: a restored run repeats bit for bit, also from bytes and in another instance. */
#include "importer.h"

enum { STEPS = 200, SAVED_AT = 83 };

typedef struct {
    double values[STEPS][32];
} Trace;

static void read_all(fmi2Component c, double *values) {
    for (size_t k = 0; k < model.n_variables && k < 32; k++) {
        const fmi2ValueReference vr = (fmi2ValueReference)k;
        int number = 0;
        if (model.variables[k].type == TYPE_REAL) CHECK(fmi2GetReal(c, &vr, 1, values + k) == fmi2OK);
        if (model.variables[k].type == TYPE_INTEGER) CHECK(fmi2GetInteger(c, &vr, 1, &number) == fmi2OK);
        if (model.variables[k].type == TYPE_INTEGER) values[k] = number;
    }
}

/* Steps of 0.01 s with an input that wanders, where there is one. */
static void run(fmi2Component c, int from, int to, Trace *trace) {
    for (int n = from; n < to; n++) {
        for (size_t k = 0; k < model.n_variables; k++) {
            const fmi2ValueReference vr = (fmi2ValueReference)k;
            const double u = 1.0 + sin(0.1 * n);
            if (model.variables[k].causality == INPUT && model.variables[k].type == TYPE_REAL)
                CHECK(fmi2SetReal(c, &vr, 1, &u) == fmi2OK);
        }
        CHECK(fmi2DoStep(c, n * 0.01, 0.01, fmi2False) == fmi2OK);
        read_all(c, trace->values[n]);
    }
}

static Trace first, second; /* zero: what a model has not stays equal */

static void repeats(fmi2Component c, int from) {
    for (int n = from; n < STEPS; n++) memset(second.values[n], 0, sizeof second.values[n]);
    run(c, from, STEPS, &second);
    CHECK(memcmp(first.values[from], second.values[from], (STEPS - (size_t)from) * sizeof first.values[0]) == 0);
}

int main(void) {
    fmi2Component c = instantiate(fmi2CoSimulation), other = instantiate(fmi2CoSimulation);
    fmi2FMUstate state = NULL, copy = NULL;
    size_t size = 0;
    initialise_from(c, 0.0, 1e-7);
    run(c, 0, SAVED_AT, &first);
    CHECK(fmi2GetFMUstate(c, &state) == fmi2OK && state);
    run(c, SAVED_AT, STEPS, &first);
    CHECK(fmi2SetFMUstate(c, state) == fmi2OK);
    repeats(c, SAVED_AT);

    CHECK(fmi2SerializedFMUstateSize(c, state, &size) == fmi2OK && size > 0);
    char *bytes = malloc(size);
    CHECK(fmi2SerializeFMUstate(c, state, bytes, size) == fmi2OK);
    CHECK(fmi2DeSerializeFMUstate(other, bytes, size, &copy) == fmi2OK && copy);
    CHECK(fmi2SetFMUstate(other, copy) == fmi2OK);
    repeats(other, SAVED_AT);

    CHECK(fmi2GetFMUstate(c, &state) == fmi2OK); /* into the same block: now the end */
    CHECK(fmi2SerializeFMUstate(c, state, bytes, size - 1) == fmi2Error && logged("bytes"));
    bytes[0] ^= 1;
    fmi2FMUstate damaged = NULL;
    CHECK(fmi2DeSerializeFMUstate(c, bytes, size, &damaged) == fmi2Error && !damaged && logged("not a state"));
    CHECK(fmi2SetFMUstate(c, NULL) == fmi2Error);
    fmi2Component exchange = instantiate(fmi2ModelExchange);
    CHECK(fmi2SetFMUstate(exchange, state) == fmi2Error && logged("same interface"));

    free(bytes);
    CHECK(fmi2FreeFMUstate(c, &state) == fmi2OK && !state && fmi2FreeFMUstate(c, &copy) == fmi2OK);
    fmi2FreeInstance(exchange);
    fmi2FreeInstance(other);
    fmi2FreeInstance(c);
    return 0;
}
