/* For any model: any function in any state with any argument gives a status. What would crash, a sanitizer catches. */
#include "importer.h"

static uint64_t state = 7u;

static uint32_t draw(uint32_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u; /* Knuth's MMIX generator */
    return (uint32_t)(state >> 33) % below;
}

static double any_number(void) {
    static const double numbers[] = {0.0, 1.0, -1.0, 0.5, 1e-3, 1e300, -1e300, 1e-300, INFINITY, NAN, 3.0, 0.25};
    return numbers[draw(COUNT(numbers))];
}

/* Now and then a null pointer. */
static void *maybe(void *pointer) { return draw(20) ? pointer : NULL; }

enum { ROOM = 16, INSTANCES = 500, CALLS = 200 }; /* 100,000 calls of either kind */
static fmi2ValueReference references[ROOM];
static double reals[ROOM];
static int integers[ROOM];
static size_t count;
static fmi2FMUstate saved;
static char *bytes;
static size_t size;

static void fill(void) {
    count = draw(4);
    for (size_t k = 0; k < ROOM; k++) {
        references[k] = draw((uint32_t)model.n_variables + 2);
        reals[k] = any_number();
        integers[k] = (int)draw(4) - 1;
    }
}

static fmi2Status access_values(fmi2Component c) {
    switch (draw(8)) {
        case 0: return fmi2GetReal(c, maybe(references), count, maybe(reals));
        case 1: return fmi2GetInteger(c, maybe(references), count, maybe(integers));
        case 2: return fmi2GetBoolean(c, maybe(references), count, maybe(integers));
        case 3: return fmi2SetReal(c, maybe(references), count, maybe(reals));
        case 4: return fmi2SetInteger(c, maybe(references), count, maybe(integers));
        case 5: return fmi2SetBoolean(c, maybe(references), count, maybe(integers));
        case 6: return fmi2GetString(c, NULL, count, NULL);
        default:
            return fmi2GetDirectionalDerivative(c, maybe(references), count, references + 4, draw(3), reals, reals + 8);
    }
}

static fmi2Status change_state(fmi2Component c) {
    fmi2EventInfo info;
    fmi2Boolean a, b;
    switch (draw(12)) {
        case 0: return fmi2SetupExperiment(c, (int)draw(2), any_number(), any_number(), (int)draw(2), any_number());
        case 1: return fmi2EnterInitializationMode(c);
        case 2: return fmi2ExitInitializationMode(c);
        case 3: return fmi2EnterEventMode(c);
        case 4: return fmi2NewDiscreteStates(c, maybe(&info));
        case 5: return fmi2EnterContinuousTimeMode(c);
        case 6: return fmi2CompletedIntegratorStep(c, fmi2True, maybe(&a), maybe(&b));
        case 7: return draw(10) ? fmi2OK : fmi2Terminate(c);
        case 8: return draw(5) ? fmi2OK : fmi2Reset(c);
        case 9: return fmi2SetDebugLogging(c, (int)draw(2), draw(2), NULL);
        case 10: return fmi2GetRealStatus(c, (fmi2StatusKind)draw(5), maybe(reals));
        default: return fmi2CancelStep(c);
    }
}

static fmi2Status compute(fmi2Component c) {
    double t = 0.0;
    const fmi2ValueReference time = 0;
    switch (draw(6)) {
        case 0: return fmi2SetTime(c, any_number());
        case 1: return fmi2SetContinuousStates(c, maybe(reals), draw(4));
        case 2: return fmi2GetDerivatives(c, maybe(reals), draw(4));
        case 3: return fmi2GetEventIndicators(c, maybe(reals), draw(3));
        case 4: return fmi2GetContinuousStates(c, maybe(reals), draw(4));
        default:
            if (fmi2GetReal(c, &time, 1, &t) != fmi2OK) t = 0.0;
            return fmi2DoStep(c, draw(5) ? t : any_number(), draw(4) ? 1e-3 * draw(30) : 0.1 - any_number() * 0.0, 1);
    }
}

static fmi2Status keep(fmi2Component c) {
    switch (draw(6)) {
        case 0: return fmi2GetFMUstate(c, maybe(&saved));
        case 1: return fmi2SetFMUstate(c, saved);
        case 2: return draw(4) ? fmi2OK : fmi2FreeFMUstate(c, maybe(&saved));
        case 3: return fmi2SerializedFMUstateSize(c, saved, &size);
        case 4:
            if (size == 0) return fmi2OK;
            bytes = realloc(bytes, size);
            memset(bytes, (int)draw(256), size);
            return fmi2SerializeFMUstate(c, saved, bytes, size);
        default: {
            fmi2FMUstate fresh = NULL;
            if (!bytes || size == 0) return fmi2OK;
            if (draw(2)) bytes[draw((uint32_t)size)] ^= (char)draw(256);
            const fmi2Status status = fmi2DeSerializeFMUstate(c, bytes, size, &fresh);
            if (fresh) (void)fmi2SetFMUstate(c, fresh), (void)fmi2FreeFMUstate(c, &fresh);
            return status;
        }
    }
}

static void abuse(fmi2Type type) {
    int outcomes[6] = {0};
    for (int round = 0; round < INSTANCES; round++) {
        fmi2Component c = instantiate(type);
        for (int n = 0; n < CALLS; n++) {
            fill();
            const uint32_t kind = draw(10);
            const fmi2Status status = kind < 3   ? access_values(c)
                                      : kind < 6 ? change_state(c)
                                      : kind < 9 ? compute(c)
                                                 : keep(c);
            CHECK(status >= fmi2OK && status <= fmi2Error);
            outcomes[status]++;
        }
        CHECK(fmi2FreeFMUstate(c, &saved) == fmi2OK);
        fmi2FreeInstance(c);
    }
    printf("ok %d, warning %d, discard %d, error %d\n", outcomes[0], outcomes[1], outcomes[2], outcomes[3]);
    CHECK(outcomes[fmi2OK] > 10000 && outcomes[fmi2Error] > 10000);
}

int main(void) {
    abuse(fmi2ModelExchange);
    abuse(fmi2CoSimulation);
    free(bytes);
    return 0;
}
