/* x1' = -10 (x1 - sin t) + cos t and x2' = x2 cos t (1 + x1 - sin t), with the solution sin t and exp(sin t). */
#include "model_by_hand.h"

FUNCTION(start) {
    if (res[0]) res[0][0] = arg[ARG_X][0], res[0][1] = arg[ARG_X][1];
}

FUNCTION(derivatives) {
    const double t = *arg[ARG_T], *x = arg[ARG_X], off = x[0] - sin(t);
    if (res[0]) res[0][0] = -10.0 * off + cos(t), res[0][1] = x[1] * cos(t) * (1.0 + off);
}

FUNCTION(jacobian) {
    const double t = *arg[ARG_T], *x = arg[ARG_X], off = x[0] - sin(t);
    if (res[0]) res[0][0] = -10.0, res[0][1] = x[1] * cos(t), res[0][2] = 0.0, res[0][3] = cos(t) * (1.0 + off);
    if (res[3]) {
        res[3][0] = 10.0 * cos(t) - sin(t);
        res[3][1] = -x[1] * sin(t) * (1.0 + off) - x[1] * cos(t) * cos(t);
    }
}

static const ModelVariable variables[] = {
    {"time", 0, VECTOR_T, TYPE_REAL, INDEPENDENT, CONTINUOUS, INITIAL_NONE},
    {"x1", 0, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"x2", 1, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
};
static const double start_x[] = {0.0, 1.0}, nominal_x[] = {1.0, 1.0};

const Model model = {
    .name = "Nonautonomous",
    .token = "{nonautonomous}",
    .n_x = 2,
    BASICS,
    .tolerance = 1e-6,
    .jacobian = jacobian,
};
