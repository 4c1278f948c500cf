/* The few things a test program needs: checks that say where they failed, and models filled in by hand. */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define CHECK(condition)                                                         \
    do {                                                                         \
        if (!(condition)) {                                                      \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);      \
            exit(1);                                                             \
        }                                                                        \
    } while (0)

#define CHECK_NEAR(value, expected, tolerance)                                                                   \
    do {                                                                                                         \
        const double got_ = (value), want_ = (expected), most_ = (tolerance);                                    \
        if (!(fabs(got_ - want_) <= most_)) {                                                                    \
            fprintf(stderr, "%s:%d: %s = %.17g, expected %.17g (off by %.3g, allowed %.3g)\n", __FILE__, __LINE__, \
                    #value, got_, want_, fabs(got_ - want_), most_);                                             \
            exit(1);                                                                                             \
        }                                                                                                        \
    } while (0)

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
