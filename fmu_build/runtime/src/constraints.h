/* Constraints between states, which give some that are states no more from those that were chosen. */
#ifndef CONSTRAINTS_H
#define CONSTRAINTS_H

#include "instance.h"

/* Discard, logged, where the states no longer determine the others: a pendulum's height says little of where it is near
   its lowest point, and nothing at it. */
Status constraints_check(Instance *s);

#endif
