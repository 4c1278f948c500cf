/* The moment within a step at which a relation changes. */
#ifndef CROSSING_H
#define CROSSING_H

#include "instance.h"

enum { CROSSING_LOOKS = 4 }; /* per step, after its begin: as many as the degree of the dense output */

/* Looks through the step tried last. If a relation changes in it, `found` is set and the instance is moved to just
   after the first such moment; else it stays at the end of the step. */
Status crossing_locate(Instance *s, bool *found);

#endif
