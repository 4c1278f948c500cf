/* As test_abuse, for FMI 3: any function in any state with any argument gives a status. */
#include <string.h>

#include "check.h"
#include "fmi3Functions.h"
#include "model.h"

static uint64_t state = 11u;

static uint32_t draw(uint32_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u; /* Knuth's MMIX generator */
    return (uint32_t)(state >> 33) % below;
}

static double any_number(void) {
    static const double numbers[] = {0.0, 1.0, -1.0, 0.5, 1e-3, 1e40, -1e300, 1e-300, INFINITY, NAN, 3.0, 0.25};
    return numbers[draw(COUNT(numbers))];
}

/* Now and then a null pointer. */
static void *maybe(void *pointer) { return draw(20) ? pointer : NULL; }

enum { ROOM = 16, INSTANCES = 500, CALLS = 200 }; /* 100,000 calls of either kind */
static fmi3ValueReference references[ROOM];
static double reals[ROOM];
static int32_t integers[ROOM];
static bool booleans[ROOM];
static size_t count;
static fmi3FMUState saved;
static fmi3Byte *bytes;
static size_t size;

static void ignore(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment, (void)status, (void)category;
    CHECK(message && strlen(message) > 0);
}

enum kind { MODEL_EXCHANGE, CO_SIMULATION };

static fmi3Instance instance_of(enum kind kind) {
    if (kind == MODEL_EXCHANGE)
        return fmi3InstantiateModelExchange("abuse", model.token, NULL, false, false, NULL, ignore);
    return fmi3InstantiateCoSimulation("abuse", model.token, NULL, false, false, draw(2), draw(2), NULL, 0, NULL, ignore,
                                       NULL);
}

static void fill(void) {
    count = draw(4);
    for (size_t k = 0; k < ROOM; k++) {
        references[k] = draw((uint32_t)model.n_variables + 2);
        reals[k] = any_number();
        integers[k] = (int32_t)draw(4) - 1;
        booleans[k] = draw(2) != 0;
    }
}

static fmi3Status access_values(fmi3Instance c) {
    const size_t n = draw(10) ? count : draw(6);
    switch (draw(8)) {
        case 0: return fmi3GetFloat64(c, maybe(references), count, maybe(reals), n);
        case 1: return fmi3GetInt32(c, maybe(references), count, maybe(integers), n);
        case 2: return fmi3GetBoolean(c, maybe(references), count, maybe(booleans), n);
        case 3: return fmi3SetFloat64(c, maybe(references), count, maybe(reals), n);
        case 4: return fmi3SetInt32(c, maybe(references), count, maybe(integers), n);
        case 5: return fmi3SetBoolean(c, maybe(references), count, maybe(booleans), n);
        case 6: return fmi3GetString(c, NULL, count, NULL, n);
        default:
            return fmi3GetDirectionalDerivative(c, maybe(references), count, references + 4, draw(3), reals, draw(4),
                                                reals + 8, draw(4));
    }
}

static fmi3Status change_state(fmi3Instance c) {
    bool more, end, nominals, values, defined;
    double next;
    switch (draw(11)) {
        case 0: return fmi3EnterInitializationMode(c, draw(2), any_number(), any_number(), draw(2), any_number());
        case 1: return fmi3ExitInitializationMode(c);
        case 2: return fmi3EnterEventMode(c);
        case 3: return fmi3UpdateDiscreteStates(c, maybe(&more), &end, maybe(&nominals), &values, &defined, maybe(&next));
        case 4: return fmi3EnterContinuousTimeMode(c);
        case 5: return fmi3EnterStepMode(c);
        case 6: return fmi3CompletedIntegratorStep(c, true, maybe(&more), maybe(&end));
        case 7: return draw(10) ? fmi3OK : fmi3Terminate(c);
        case 8: return draw(5) ? fmi3OK : fmi3Reset(c);
        case 9: return fmi3SetDebugLogging(c, draw(2), draw(2), NULL);
        default: return fmi3EnterConfigurationMode(c);
    }
}

static fmi3Status compute(fmi3Instance c) {
    double t = 0.0, last;
    bool event, end, early;
    const fmi3ValueReference time = 0;
    switch (draw(7)) {
        case 0: return fmi3SetTime(c, any_number());
        case 1: return fmi3SetContinuousStates(c, maybe(reals), draw(4));
        case 2: return fmi3GetContinuousStateDerivatives(c, maybe(reals), draw(4));
        case 3: return fmi3GetEventIndicators(c, maybe(reals), draw(3));
        case 4: return fmi3GetContinuousStates(c, maybe(reals), draw(4));
        case 5: return fmi3GetNominalsOfContinuousStates(c, maybe(reals), draw(4));
        default:
            if (fmi3GetFloat64(c, &time, 1, &t, 1) != fmi3OK) t = 0.0;
            return fmi3DoStep(c, draw(5) ? t : any_number(), draw(4) ? 1e-3 * draw(30) : 0.1, true, maybe(&event), &end,
                              maybe(&early), &last);
    }
}

static fmi3Status keep(fmi3Instance c) {
    switch (draw(6)) {
        case 0: return fmi3GetFMUState(c, maybe(&saved));
        case 1: return fmi3SetFMUState(c, saved);
        case 2: return draw(4) ? fmi3OK : fmi3FreeFMUState(c, maybe(&saved));
        case 3: return fmi3SerializedFMUStateSize(c, saved, &size);
        case 4:
            if (size == 0) return fmi3OK;
            bytes = realloc(bytes, size);
            memset(bytes, (int)draw(256), size);
            return fmi3SerializeFMUState(c, saved, bytes, size);
        default: {
            fmi3FMUState fresh = NULL;
            if (!bytes || size == 0) return fmi3OK;
            if (draw(2)) bytes[draw((uint32_t)size)] ^= (fmi3Byte)draw(256);
            const fmi3Status status = fmi3DeserializeFMUState(c, bytes, size, &fresh);
            if (fresh) (void)fmi3SetFMUState(c, fresh), (void)fmi3FreeFMUState(c, &fresh);
            return status;
        }
    }
}

static void abuse(enum kind of) {
    int outcomes[6] = {0};
    for (int round = 0; round < INSTANCES; round++) {
        fmi3Instance c = instance_of(of);
        CHECK(c);
        for (int n = 0; n < CALLS; n++) {
            fill();
            const uint32_t kind = draw(10);
            const fmi3Status status = kind < 3   ? access_values(c)
                                      : kind < 6 ? change_state(c)
                                      : kind < 9 ? compute(c)
                                                 : keep(c);
            CHECK(status >= fmi3OK && status <= fmi3Error);
            outcomes[status]++;
        }
        CHECK(fmi3FreeFMUState(c, &saved) == fmi3OK);
        fmi3FreeInstance(c);
    }
    printf("ok %d, warning %d, discard %d, error %d\n", outcomes[0], outcomes[1], outcomes[2], outcomes[3]);
    CHECK(outcomes[fmi3OK] > 10000 && outcomes[fmi3Error] > 10000);
}

int main(void) {
    abuse(MODEL_EXCHANGE);
    abuse(CO_SIMULATION);
    free(bytes);
    return 0;
}
