/* Two non-linear equations: a + a^3 = x + s u and b exp(b) = a^2 + time, with x' = -a + u and the output b. Initially
   x' = 0, so that a = u: the initial unknowns are x and a. */
#include "model_by_hand.h"

enum { A, B };

FUNCTION(initial_residual) {
    const double *i = arg[ARG_I], u = *arg[ARG_U], s = *arg[ARG_P];
    if (res[0]) res[0][0] = i[1] + pow(i[1], 3.0) - i[0] - s * u, res[0][1] = u - i[1];
    if (res[1]) res[1][0] = -1.0, res[1][1] = 0.0, res[1][2] = 1.0 + 3.0 * i[1] * i[1], res[1][3] = -1.0;
    if (res[2]) res[2][0] = res[2][1] = 1.0;
}

FUNCTION(start) {
    if (res[0]) res[0][0] = arg[ARG_I][0];
    if (res[2]) res[2][A] = arg[ARG_I][1], res[2][B] = 0.5;
}

FUNCTION(derivatives) {
    if (res[0]) res[0][0] = *arg[ARG_U] - arg[ARG_Q][A];
}

FUNCTION(outputs) {
    if (res[0]) res[0][0] = arg[ARG_Q][B];
}

FUNCTION(residual) {
    const double a = arg[ARG_Q][A], b = arg[ARG_Q][B];
    if (res[0]) {
        res[0][0] = a + a * a * a - *arg[ARG_X] - *arg[ARG_P] * *arg[ARG_U];
        res[0][1] = b * exp(b) - a * a - *arg[ARG_T];
    }
    if (res[1]) res[1][0] = 1.0 + 3.0 * a * a, res[1][1] = -2.0 * a, res[1][2] = 0.0, res[1][3] = (1.0 + b) * exp(b);
}

FUNCTION(jacobian) {
    (void)arg;
    if (res[0]) res[0][0] = 0.0;
    if (res[1]) res[1][A] = -1.0, res[1][B] = 0.0;
    if (res[2]) res[2][0] = -1.0, res[2][1] = 0.0;
    if (res[3]) res[3][0] = 0.0;
    if (res[4]) res[4][0] = 0.0, res[4][1] = -1.0;
}

FUNCTION(forward) {
    const double a = arg[ARG_Q][A], b = arg[ARG_Q][B], *q = arg[ARG_SEED_Q];
    if (res[0]) res[0][0] = *arg[ARG_SEED_U] - q[A];
    if (res[1]) res[1][0] = q[B];
    if (res[2]) {
        res[2][0] = (1.0 + 3.0 * a * a) * q[A] - *arg[ARG_SEED_X] - *arg[ARG_P] * *arg[ARG_SEED_U] -
                    *arg[ARG_SEED_P] * *arg[ARG_U];
        res[2][1] = (1.0 + b) * exp(b) * q[B] - 2.0 * a * q[A];
    }
}

FUNCTION(reverse) {
    const double a = arg[ARG_Q][A], b = arg[ARG_Q][B], *g = arg[ARG_WEIGHT_G], dx = *arg[ARG_WEIGHT_DX];
    if (res[0]) res[0][0] = -g[0];
    if (res[1]) res[1][0] = dx - *arg[ARG_P] * g[0];
    if (res[2]) res[2][0] = -*arg[ARG_U] * g[0];
    if (res[3]) {
        res[3][A] = -dx + (1.0 + 3.0 * a * a) * g[0] - 2.0 * a * g[1];
        res[3][B] = *arg[ARG_WEIGHT_W] + (1.0 + b) * exp(b) * g[1];
    }
}

static const ModelVariable variables[] = {
    {"time", 0, VECTOR_T, TYPE_REAL, INDEPENDENT, CONTINUOUS, INITIAL_NONE},
    {"x", 0, VECTOR_X, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"der(x)", 0, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"u", 0, VECTOR_U, TYPE_REAL, INPUT, CONTINUOUS, INITIAL_EXACT},
    {"s", 0, VECTOR_P, TYPE_REAL, PARAMETER, TUNABLE, INITIAL_EXACT},
    {"b", 0, VECTOR_W, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_CALCULATED},
};
static const double start_u[] = {2.0}, start_p[] = {0.5}, start_x[] = {0.0}, nominal_x[] = {1.0};

const Model model = {
    .name = "Loop",
    .token = "{loop}",
    .n_x = 1,
    .n_u = 1,
    .n_p = 1,
    .n_q = 2,
    .n_i = 2,
    .n_w = 1,
    BASICS,
    .start_u = start_u,
    .start_p = start_p,
    .tolerance = 1e-8,
    .initial_residual = initial_residual,
    .outputs = outputs,
    .residual = residual,
    PARTIALS,
};
