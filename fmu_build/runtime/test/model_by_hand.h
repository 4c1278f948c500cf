/* For models written by hand: the generated functions' signature, without its return value. */
#ifndef MODEL_BY_HAND_H
#define MODEL_BY_HAND_H

#include <math.h>

#include "model.h"

#define FUNCTION(name)                                         \
    static void name##_body(const double **arg, double **res); \
    static int name(const double **arg, double **res) {        \
        name##_body(arg, res);                                 \
        return 0;                                              \
    }                                                          \
    static void name##_body(const double **arg, double **res)

#define LENGTH(array) (sizeof(array) / sizeof((array)[0]))

/* Fields of `model` that are called as what they hold: those of every model, ... */
#define BASICS                                                                                             \
    .n_variables = LENGTH(variables), .variables = variables, .start_x = start_x, .nominal_x = nominal_x, \
    .start = start, .derivatives = derivatives
/* ... and those of a model that gives its partial derivatives. */
#define PARTIALS .jacobian = jacobian, .forward = forward, .reverse = reverse

#endif
