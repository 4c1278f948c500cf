/* The stiff van der Pol oscillator, y'' = ((1 - y^2) y' - y) / eps, as in E. Hairer, G. Wanner, Solving Ordinary
   Differential Equations II, Section IV.10; it counts its evaluations. */
#include "van_der_pol.h"

#include "model_by_hand.h"

int derivative_calls, jacobian_calls;

FUNCTION(start) {
    if (res[0]) res[0][0] = arg[ARG_X][0], res[0][1] = arg[ARG_X][1];
}

FUNCTION(derivatives) {
    const double y = arg[ARG_X][0], v = arg[ARG_X][1];
    derivative_calls++;
    if (res[0]) res[0][0] = v, res[0][1] = ((1.0 - y * y) * v - y) / *arg[ARG_P];
}

FUNCTION(jacobian) {
    const double y = arg[ARG_X][0], v = arg[ARG_X][1], eps = *arg[ARG_P];
    jacobian_calls++;
    if (res[0]) res[0][0] = 0.0, res[0][1] = (-2.0 * y * v - 1.0) / eps, res[0][2] = 1.0, res[0][3] = (1.0 - y * y) / eps;
    if (res[3]) res[3][0] = res[3][1] = 0.0;
}

static const ModelVariable variables[] = {
    {"time", 0, VECTOR_T, TYPE_REAL, INDEPENDENT, CONTINUOUS, INITIAL_NONE},
    {"y", 0, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"v", 1, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"der(y)", 0, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"der(v)", 1, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"eps", 0, VECTOR_P, TYPE_REAL, PARAMETER, FIXED, INITIAL_EXACT},
};
static const double start_x[] = {2.0, 0.0}, start_p[] = {1e-6}, nominal_x[] = {1.0, 1.0};

const Model model = {
    .name = "VanDerPol",
    .token = "{vanderpol}",
    .n_x = 2,
    .n_p = 1,
    BASICS,
    .start_p = start_p,
    .tolerance = 1e-6,
    .jacobian = jacobian,
};
