/* 2,000 instances of either kind, ended in every way there is, for any model: not a byte stays. */
#include "allocated.h"
#include "importer.h"

enum { INSTANCES = 2000 };

/* A saved state, its bytes, and a state made from them. */
static void save(fmi2Component c) {
    fmi2FMUstate state = NULL, copy = NULL;
    size_t size = 0;
    CHECK(fmi2GetFMUstate(c, &state) == fmi2OK);
    CHECK(fmi2SerializedFMUstateSize(c, state, &size) == fmi2OK);
    char *bytes = calloc(1, size);
    CHECK(fmi2DeSerializeFMUstate(c, bytes, size, &copy) == fmi2Error && !copy); /* zeros are no state */
    CHECK(fmi2SerializeFMUstate(c, state, bytes, size) == fmi2OK);
    CHECK(fmi2DeSerializeFMUstate(c, bytes, size, &copy) == fmi2OK && copy);
    CHECK(fmi2GetFMUstate(c, &copy) == fmi2OK); /* into one that is there */
    CHECK(fmi2FreeFMUstate(c, &state) == fmi2OK && fmi2FreeFMUstate(c, &copy) == fmi2OK);
    free(bytes);
}

/* How far it is taken differs from one to the next. */
static void live(fmi2Type type, int turn) {
    fmi2Component c = instantiate(type);
    if (turn % 2) initialise_from(c, 0.0, 1e-6), save(c);
    if (turn % 4 == 3 && type == fmi2CoSimulation) (void)fmi2DoStep(c, 0.0, 1e-2, fmi2True);
    if (turn % 8 == 7) (void)fmi2Terminate(c);
    if (turn % 16 == 15) {
        CHECK(fmi2Reset(c) == fmi2OK);
        initialise_from(c, 1.0, 0.0);
    }
    fmi2FreeInstance(c);
    CHECK(!fmi2Instantiate("test", type, "of another model", NULL, &callbacks, fmi2False, fmi2False));
}

static void none_stays(fmi2Type type) {
    for (int turn = 0; turn < 16; turn++) live(type, turn); /* what a library keeps, it keeps from the first on */
    const size_t before = allocated();
    for (int turn = 0; turn < INSTANCES; turn++) live(type, turn);
    CHECK(allocated() == before);
}

int main(void) {
    none_stays(fmi2ModelExchange);
    none_stays(fmi2CoSimulation);
    return 0;
}
