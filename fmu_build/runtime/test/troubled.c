/* A model that can be asked for trouble: 1: discrete equations that never rest; 2: a derivative that is not a number
   where x < 0.5; 3: a non-linear equation without a solution where x < 0.5; 4: a discrete variable that becomes
   infinite; 6: a derivative that changes faster than any step can follow. The output reciprocal is 1/(x - 0.75), the calculated parameter share is 1/(trouble - 5). */
#include "model_by_hand.h"

enum { QUIET, RESTLESS, NOT_A_NUMBER, NO_SOLUTION, INFINITE, NO_SHARE, ROUGH };

static int is_trouble(const double **arg, int kind) { return (int)*arg[ARG_P] == kind; }

FUNCTION(calculated) {
    if (res[0]) res[0][0] = 1.0 / (arg[ARG_P][0] - 5.0);
}

FUNCTION(start) {
    if (res[0]) res[0][0] = arg[ARG_X][0];
    if (res[1]) res[1][0] = arg[ARG_D][0];
    if (res[2]) res[2][0] = 1.0;
}

FUNCTION(derivatives) {
    if (res[0]) res[0][0] = is_trouble(arg, NOT_A_NUMBER) ? -sqrt(arg[ARG_X][0] - 0.5) - 1.0 : -1.0;
    if (res[0] && is_trouble(arg, ROUGH)) res[0][0] += 1e6 * sin(1e9 * arg[ARG_T][0]);
}

FUNCTION(residual) {
    const double q = arg[ARG_Q][0], wanted = is_trouble(arg, NO_SOLUTION) ? arg[ARG_X][0] - 0.5 : 1.0;
    if (res[0]) res[0][0] = q * q - wanted;
    if (res[1]) res[1][0] = 2.0 * q;
}

FUNCTION(outputs) {
    if (res[0]) res[0][0] = arg[ARG_Q][0], res[0][1] = 1.0 / (arg[ARG_X][0] - 0.75);
}

FUNCTION(update) {
    if (res[0]) res[0][0] = is_trouble(arg, RESTLESS) ? 1.0 - arg[ARG_PRE_D][0] : arg[ARG_PRE_D][0];
    if (res[0] && is_trouble(arg, INFINITE)) res[0][0] = INFINITY;
    if (res[2]) res[2][0] = arg[ARG_X][0];
}

FUNCTION(jacobian) {
    (void)arg;
    for (int k = 0; k < 5; k++)
        if (res[k]) res[k][0] = 0.0;
}

static const ModelVariable variables[] = {
    {"time", 0, VECTOR_T, TYPE_REAL, INDEPENDENT, CONTINUOUS, INITIAL_NONE},
    {"x", 0, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"trouble", 0, VECTOR_P, TYPE_INTEGER, PARAMETER, TUNABLE, INITIAL_EXACT},
    {"d", 0, VECTOR_D, TYPE_REAL, LOCAL, DISCRETE, INITIAL_EXACT},
    {"q", 0, VECTOR_W, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_CALCULATED},
    {"reciprocal", 1, VECTOR_W, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_CALCULATED},
    {"share", 0, VECTOR_C, TYPE_REAL, CALCULATED_PARAMETER, FIXED, INITIAL_CALCULATED},
    {"der(x)", 0, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
};
static const char *const unknowns[] = {"q"};
static const double start_x[] = {1.0}, start_p[] = {0.0}, start_d[] = {0.0}, nominal_x[] = {1.0};

const Model model = {
    .name = "Troubled",
    .token = "{troubled}",
    .n_x = 1,
    .n_p = 1,
    .n_d = 1,
    .n_c = 1,
    .n_q = 1,
    .n_w = 2,
    BASICS,
    .start_p = start_p,
    .start_d = start_d,
    .unknowns = unknowns,
    .tolerance = 1e-6,
    .calculated = calculated,
    .residual = residual,
    .outputs = outputs,
    .update = update,
    .jacobian = jacobian,
};
