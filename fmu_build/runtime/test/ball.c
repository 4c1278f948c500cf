/* A bouncing ball: h'' = -g; when h <= 0 then v = -e v and one more bounce is counted. It ends the simulation at the
   last bounce, warns when it is slow and does not bear a negative gravity. */
#include "model_by_hand.h"

enum { H, V };
enum { G, E, LAST };

FUNCTION(start) {
    if (res[0]) res[0][H] = arg[ARG_X][H], res[0][V] = arg[ARG_X][V];
    if (res[1]) res[1][0] = arg[ARG_D][0];
}

FUNCTION(derivatives) {
    if (res[0]) res[0][H] = arg[ARG_X][V], res[0][V] = -arg[ARG_P][G];
}

FUNCTION(outputs) {
    if (res[0]) res[0][0] = arg[ARG_P][G] * arg[ARG_X][H] + 0.5 * arg[ARG_X][V] * arg[ARG_X][V];
}

FUNCTION(indicators) {
    if (res[0]) res[0][0] = -arg[ARG_X][H];
}

FUNCTION(update) {
    const double bounces = arg[ARG_R][0] > 0.5 && arg[ARG_PRE_B][0] < 0.5;
    const double count = arg[ARG_PRE_D][0] + bounces;
    if (res[0]) res[0][0] = count;
    if (res[1]) res[1][0] = arg[ARG_R][0];
    if (res[2]) {
        res[2][H] = arg[ARG_X][H];
        res[2][V] = bounces > 0.5 ? -arg[ARG_P][E] * arg[ARG_X][V] : arg[ARG_X][V];
    }
    if (res[3]) res[3][0] = count >= arg[ARG_P][LAST];
}

FUNCTION(check) {
    if (res[0]) res[0][0] = fabs(arg[ARG_X][V]) < 100.0, res[0][1] = arg[ARG_P][G] >= 0.0;
}

FUNCTION(jacobian) {
    (void)arg;
    if (res[0]) res[0][0] = res[0][1] = res[0][3] = 0.0, res[0][2] = 1.0;
    if (res[3]) res[3][H] = res[3][V] = 0.0;
}

static const ModelVariable variables[] = {
    {"time", 0, VECTOR_T, TYPE_REAL, INDEPENDENT, CONTINUOUS, INITIAL_NONE},
    {"h", H, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"v", V, VECTOR_X, TYPE_REAL, OUTPUT, CONTINUOUS, INITIAL_EXACT},
    {"der(h)", H, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"der(v)", V, VECTOR_DX, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
    {"g", G, VECTOR_P, TYPE_REAL, PARAMETER, TUNABLE, INITIAL_EXACT},
    {"e", E, VECTOR_P, TYPE_REAL, PARAMETER, FIXED, INITIAL_EXACT},
    {"last", LAST, VECTOR_P, TYPE_REAL, PARAMETER, FIXED, INITIAL_EXACT},
    {"bounces", 0, VECTOR_D, TYPE_INTEGER, OUTPUT, DISCRETE, INITIAL_EXACT},
    {"energy", 0, VECTOR_W, TYPE_REAL, LOCAL, CONTINUOUS, INITIAL_CALCULATED},
};
static const ModelState states[] = {{1, 0}, {2, 1}};
static const double start_x[] = {1.0, 0.0}, start_p[] = {9.81, 0.7, 1e9}, start_d[] = {0.0}, nominal_x[] = {1.0, 1.0};
static const ModelRelation relations[] = {{.strict = 0, .of_time = 0}};
static const ModelCheck checks[] = {{"The ball is faster than 100 m/s.", 1}, {"Gravity is negative.", 0}};
static const char *const terminations[] = {"The last bounce."};

const Model model = {
    .name = "BouncingBall",
    .token = "{ball}",
    .n_x = 2,
    .n_p = 3,
    .n_d = 1,
    .n_r = 1,
    .n_b = 1,
    .n_w = 1,
    BASICS,
    .n_checks = LENGTH(checks),
    .n_terminations = 1,
    .start_p = start_p,
    .start_d = start_d,
    .states = states,
    .relations = relations,
    .checks = checks,
    .terminations = terminations,
    .tolerance = 1e-8,
    .outputs = outputs,
    .indicators = indicators,
    .update = update,
    .check = check,
    .jacobian = jacobian,
};
