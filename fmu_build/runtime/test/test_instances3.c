/* As test_instances, for FMI 3: 2,000 instances of either kind, ended in every way there is; not a byte stays. */
#include <string.h>

#include "allocated.h"
#include "check.h"
#include "fmi3Functions.h"
#include "model.h"

enum { INSTANCES = 2000 };
enum kind { MODEL_EXCHANGE, CO_SIMULATION };

static void ignore(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
    (void)environment, (void)status, (void)category, (void)message;
}

static fmi3Instance instance_of(enum kind kind, fmi3String token) {
    if (kind == MODEL_EXCHANGE)
        return fmi3InstantiateModelExchange("test", token, NULL, false, false, NULL, ignore);
    return fmi3InstantiateCoSimulation("test", token, NULL, false, false, false, false, NULL, 0, NULL, ignore, NULL);
}

static void initialise_from(fmi3Instance c, double start) {
    CHECK(fmi3EnterInitializationMode(c, false, 0.0, start, false, 0.0) == fmi3OK);
    CHECK(fmi3ExitInitializationMode(c) == fmi3OK);
}

/* A saved state, its bytes, and a state made from them. */
static void save(fmi3Instance c) {
    fmi3FMUState state = NULL, copy = NULL;
    size_t size = 0;
    CHECK(fmi3GetFMUState(c, &state) == fmi3OK);
    CHECK(fmi3SerializedFMUStateSize(c, state, &size) == fmi3OK);
    fmi3Byte *bytes = calloc(1, size);
    CHECK(fmi3DeserializeFMUState(c, bytes, size, &copy) == fmi3Error && !copy); /* zeros are no state */
    CHECK(fmi3SerializeFMUState(c, state, bytes, size) == fmi3OK);
    CHECK(fmi3DeserializeFMUState(c, bytes, size, &copy) == fmi3OK && copy);
    CHECK(fmi3GetFMUState(c, &copy) == fmi3OK); /* into one that is there */
    CHECK(fmi3FreeFMUState(c, &state) == fmi3OK && fmi3FreeFMUState(c, &copy) == fmi3OK);
    free(bytes);
}

/* How far it is taken differs from one to the next. */
static void live(enum kind kind, int turn) {
    bool event, end, early;
    double last;
    fmi3Instance c = instance_of(kind, model.token);
    CHECK(c);
    if (turn % 2) initialise_from(c, 0.0), save(c);
    if (turn % 4 == 3 && kind == CO_SIMULATION) (void)fmi3DoStep(c, 0.0, 1e-2, true, &event, &end, &early, &last);
    if (turn % 8 == 7) (void)fmi3Terminate(c);
    if (turn % 16 == 15) {
        CHECK(fmi3Reset(c) == fmi3OK);
        initialise_from(c, 1.0);
    }
    fmi3FreeInstance(c);
    CHECK(!instance_of(kind, "of another model"));
}

static void none_stays(enum kind kind) {
    for (int turn = 0; turn < 16; turn++) live(kind, turn); /* what a library keeps, it keeps from the first on */
    const size_t before = allocated();
    for (int turn = 0; turn < INSTANCES; turn++) live(kind, turn);
    CHECK(allocated() == before);
}

int main(void) {
    none_stays(MODEL_EXCHANGE);
    none_stays(CO_SIMULATION);
    return 0;
}
