/* A driven oscillator, x'' = k (u - x) - damping x', with a tunable stiffness, a fixed damping, the calculated
   frequency sqrt(k) and the output force k (u - x). Its Jacobian and its partial derivatives are written out. */
#include "model_by_hand.h"

enum { X, V };
enum { K, DAMPING };

FUNCTION(calculated) {
    if (res[0]) res[0][0] = sqrt(arg[ARG_P][K]);
}

FUNCTION(start) {
    if (res[0]) {
        res[0][X] = arg[ARG_X][X];
        res[0][V] = arg[ARG_X][V];
    }
}

static double force(const double **arg) { return arg[ARG_P][K] * (arg[ARG_U][0] - arg[ARG_X][X]); }

FUNCTION(derivatives) {
    if (res[0]) {
        res[0][X] = arg[ARG_X][V];
        res[0][V] = force(arg) - arg[ARG_P][DAMPING] * arg[ARG_X][V];
    }
}

FUNCTION(outputs) {
    if (res[0]) res[0][0] = force(arg);
}

FUNCTION(jacobian) {
    if (res[0]) {
        res[0][0] = 0.0, res[0][1] = -arg[ARG_P][K];
        res[0][2] = 1.0, res[0][3] = -arg[ARG_P][DAMPING];
    }
    if (res[3]) res[3][X] = res[3][V] = 0.0;
}

FUNCTION(forward) {
    const double *x = arg[ARG_SEED_X], *p = arg[ARG_SEED_P];
    const double f = arg[ARG_P][K] * (arg[ARG_SEED_U][0] - x[X]) + p[K] * (arg[ARG_U][0] - arg[ARG_X][X]);
    if (res[0]) {
        res[0][X] = x[V];
        res[0][V] = f - arg[ARG_P][DAMPING] * x[V] - p[DAMPING] * arg[ARG_X][V];
    }
    if (res[1]) res[1][0] = f;
}

FUNCTION(reverse) {
    const double *dx = arg[ARG_WEIGHT_DX], f = dx[V] + arg[ARG_WEIGHT_W][0];
    if (res[0]) {
        res[0][X] = -arg[ARG_P][K] * f;
        res[0][V] = dx[X] - arg[ARG_P][DAMPING] * dx[V];
    }
    if (res[1]) res[1][0] = arg[ARG_P][K] * f;
    if (res[2]) {
        res[2][K] = (arg[ARG_U][0] - arg[ARG_X][X]) * f;
        res[2][DAMPING] = -arg[ARG_X][V] * dx[V];
    }
}

static const ModelVariable variables[] = {
    {"time", 0, VECTOR_T, TYPE_REAL, INDEPENDENT, CONTINUOUS, INITIAL_NONE},
    {"x", X, VECTOR_X, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_EXACT},
    {"v", V, VECTOR_X, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_EXACT},
    {"der(x)", X, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"der(v)", V, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"u", 0, VECTOR_U, TYPE_REAL, INPUT, CONTINUOUS, INITIAL_NONE},
    {"k", K, VECTOR_P, TYPE_REAL, PARAMETER, TUNABLE, INITIAL_EXACT},
    {"damping", DAMPING, VECTOR_P, TYPE_REAL, PARAMETER, FIXED, INITIAL_EXACT},
    {"omega", 0, VECTOR_C, TYPE_REAL, CALCULATED_PARAMETER, TUNABLE, INITIAL_CALCULATED},
    {"force", 0, VECTOR_W, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_CALCULATED},
    {"y", X, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_CALCULATED},
};

static const ModelState states[] = {{1, 0}, {2, 0}};
static const double start_x[] = {1.0, 0.0}, start_u[] = {0.0}, start_p[] = {4.0, 0.0}, nominal_x[] = {1.0, 1.0};

const Model model = {
    .name = "Oscillator",
    .token = "{oscillator}",
    .n_x = 2,
    .n_u = 1,
    .n_p = 2,
    .n_c = 1,
    .n_w = 1,
    BASICS,
    .start_u = start_u,
    .start_p = start_p,
    .states = states,
    .tolerance = 1e-6,
    .calculated = calculated,
    .outputs = outputs,
    PARTIALS,
};
