/* For models written by hand: the generated functions' signature, without its unused arguments. */
#ifndef MODEL_BY_HAND_H
#define MODEL_BY_HAND_H

#include <math.h>

#include "model.h"

#define FUNCTION(name)                                                                         \
    static void name##_body(const double **arg, double **res);                                 \
    static int name(const double **arg, double **res, int *iw, double *w, int mem) {           \
        (void)iw, (void)w, (void)mem;                                                          \
        name##_body(arg, res);                                                                 \
        return 0;                                                                              \
    }                                                                                          \
    static void name##_body(const double **arg, double **res)

#define LENGTH(array) (sizeof(array) / sizeof((array)[0]))

#endif
