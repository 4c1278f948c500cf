/* A sampled integrator: x' = a, and at each tick of sample(start, interval) a = -gain x and n counts; y' = 1 from the
   instant t_step on; z' is 1 while the Boolean input is on. `initial` counts initial() as 1, terminal() as 10. */
#include "model_by_hand.h"

enum { X, Y, Z };
enum { GAIN, START, INTERVAL, T_STEP };
enum { A, N, INITIAL };

FUNCTION(start) {
    if (res[0])
        for (int k = 0; k < 3; k++) res[0][k] = arg[ARG_X][k];
    if (res[1])
        for (int k = 0; k < 3; k++) res[1][k] = arg[ARG_D][k];
}

FUNCTION(derivatives) {
    if (res[0]) res[0][X] = arg[ARG_D][A], res[0][Y] = arg[ARG_R][0], res[0][Z] = arg[ARG_U][0];
}

FUNCTION(indicators) {
    if (res[0]) res[0][0] = *arg[ARG_T] - arg[ARG_P][T_STEP];
}

FUNCTION(instants) {
    if (res[0]) res[0][0] = arg[ARG_P][T_STEP];
    if (res[1]) res[1][0] = arg[ARG_P][START];
    if (res[2]) res[2][0] = arg[ARG_P][INTERVAL];
}

FUNCTION(update) {
    const double ticks = arg[ARG_E][2] > 0.5 && arg[ARG_PRE_B][0] < 0.5;
    const double begins = arg[ARG_E][0] > 0.5 && arg[ARG_PRE_B][1] < 0.5;
    const double ends = arg[ARG_E][1] > 0.5 && arg[ARG_PRE_B][2] < 0.5;
    if (res[0]) {
        res[0][A] = ticks > 0.5 ? -arg[ARG_P][GAIN] * arg[ARG_X][X] : arg[ARG_PRE_D][A];
        res[0][N] = arg[ARG_PRE_D][N] + ticks;
        res[0][INITIAL] = arg[ARG_PRE_D][INITIAL] + begins + 10.0 * ends;
    }
    if (res[1]) res[1][0] = arg[ARG_E][2], res[1][1] = arg[ARG_E][0], res[1][2] = arg[ARG_E][1];
    if (res[2])
        for (int k = 0; k < 3; k++) res[2][k] = arg[ARG_X][k];
}

FUNCTION(jacobian) {
    (void)arg;
    if (res[0])
        for (int k = 0; k < 9; k++) res[0][k] = 0.0;
    if (res[3])
        for (int k = 0; k < 3; k++) res[3][k] = 0.0;
}

static const ModelVariable variables[] = {
    {"time", 0, VECTOR_T, TYPE_REAL, INDEPENDENT, CONTINUOUS, INITIAL_NONE},
    {"x", X, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"y", Y, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"z", Z, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"a", A, VECTOR_D, TYPE_REAL, LOCAL, DISCRETE, INITIAL_EXACT},
    {"n", N, VECTOR_D, TYPE_INTEGER, OUTPUT, DISCRETE, INITIAL_EXACT},
    {"initial", INITIAL, VECTOR_D, TYPE_INTEGER, OUTPUT, DISCRETE, INITIAL_EXACT},
    {"gain", GAIN, VECTOR_P, TYPE_REAL, PARAMETER, TUNABLE, INITIAL_EXACT},
    {"start", START, VECTOR_P, TYPE_REAL, PARAMETER, FIXED, INITIAL_EXACT},
    {"interval", INTERVAL, VECTOR_P, TYPE_REAL, PARAMETER, TUNABLE, INITIAL_EXACT},
    {"t_step", T_STEP, VECTOR_P, TYPE_REAL, PARAMETER, FIXED, INITIAL_EXACT},
    {"on", 0, VECTOR_U, TYPE_BOOLEAN, INPUT, DISCRETE, INITIAL_EXACT},
};
static const double start_x[] = {1.0, 0.0, 0.0}, start_u[] = {0.0}, start_p[] = {2.0, 0.0, 0.1, 0.25};
static const double start_d[] = {0.0, 0.0, 0.0}, nominal_x[] = {1.0, 1.0, 1.0};
static const ModelRelation relations[] = {{.strict = 1, .of_time = 1}};

const Model model = {
    .name = "Sampled",
    .token = "{sampled}",
    .n_x = 3,
    .n_u = 1,
    .n_p = 4,
    .n_d = 3,
    .n_r = 1,
    .n_b = 3,
    .n_s = 1,
    BASICS,
    .start_u = start_u,
    .start_p = start_p,
    .start_d = start_d,
    .relations = relations,
    .tolerance = 1e-6,
    .indicators = indicators,
    .instants = instants,
    .update = update,
    .jacobian = jacobian,
};
