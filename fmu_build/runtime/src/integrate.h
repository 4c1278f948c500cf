/* Error-controlled integration between events. */
#ifndef INTEGRATE_H
#define INTEGRATE_H

#include "instance.h"

/* Makes one accepted step, not beyond time `limit`. `event`: it ended where a relation changes. Discard, logged, where
   no step is small enough; Error or Warning from assert(). */
Status integrate_step(Instance *s, double limit, bool *event);

/* For messages: the state whose error made the last step short. */
const char *integrate_culprit(const Instance *s);

#endif
