/* x' = -x(t - T), whose solution is a polynomial on each interval of length T, and y' = u(t - T). */
#include "model_by_hand.h"

FUNCTION(start) {
    if (res[0]) res[0][0] = arg[ARG_X][0], res[0][1] = arg[ARG_X][1];
}

FUNCTION(derivatives) {
    if (res[0]) res[0][0] = -arg[ARG_V][0], res[0][1] = arg[ARG_V][1];
}

FUNCTION(delays) {
    if (res[0]) res[0][0] = arg[ARG_X][0], res[0][1] = arg[ARG_U][0];
    if (res[1]) res[1][0] = res[1][1] = arg[ARG_P][0];
    if (res[2]) res[2][0] = res[2][1] = 5.0;
}

FUNCTION(jacobian) {
    (void)arg;
    if (res[0])
        for (int k = 0; k < 4; k++) res[0][k] = 0.0;
    if (res[3]) res[3][0] = res[3][1] = 0.0;
}

FUNCTION(forward) {
    if (res[0]) res[0][0] = -arg[ARG_SEED_V][0], res[0][1] = arg[ARG_SEED_V][1];
}

FUNCTION(reverse) {
    for (int k = 0; k < 3; k++)
        if (res[k]) res[k][0] = 0.0;
    if (res[0]) res[0][1] = 0.0;
    if (res[4]) res[4][0] = -arg[ARG_WEIGHT_DX][0], res[4][1] = arg[ARG_WEIGHT_DX][1];
}

static const ModelVariable variables[] = {
    {"time", 0, VECTOR_T, TYPE_REAL, INDEPENDENT, CONTINUOUS, INITIAL_NONE},
    {"x", 0, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"y", 1, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"der(x)", 0, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"der(y)", 1, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"u", 0, VECTOR_U, TYPE_REAL, INPUT, CONTINUOUS, INITIAL_EXACT},
    {"T", 0, VECTOR_P, TYPE_REAL, PARAMETER, FIXED, INITIAL_EXACT},
};
static const double start_x[] = {1.0, 0.0}, start_u[] = {0.0}, start_p[] = {1.0}, nominal_x[] = {1.0, 1.0};

const Model model = {
    .name = "Delayed",
    .token = "{delayed}",
    .n_x = 2,
    .n_u = 1,
    .n_p = 1,
    .n_v = 2,
    BASICS,
    .start_u = start_u,
    .start_p = start_p,
    .tolerance = 1e-8,
    .delays = delays,
    PARTIALS,
};
