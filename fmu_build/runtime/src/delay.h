/* delay(): the history of each delayed expression, and its value some time ago. */
#ifndef DELAY_H
#define DELAY_H

#include "instance.h"

/* Takes over delay times after parameters changed; Discard with a log line if one is not in [0, maximum]. */
Status delay_times_update(Instance *s);

/* Sets v from the histories. True if some delayed time lies after the end of its history: those v hold the newest
   value, and delay_values_complete must follow once q is known. */
bool delay_values_update(Instance *s);
Status delay_values_complete(Instance *s);

/* Starts all histories at the present time and value; before it, the value was the same. */
Status delay_start(Instance *s);

/* Adds the present point, whose v and q are up to date, to all histories. `is_break`: something changed abruptly here. */
Status delay_record(Instance *s, bool is_break);

/* Lets delayed values go past the breaks that they have reached. True if one was passed. */
bool delay_pass_breaks(Instance *s, double slack);

/* Time at which a delayed value reaches its next break, s; infinite if there is none. */
double delay_next_break(const Instance *s);

/* Smallest positive delay time, s; infinite if there is none. */
double delay_smallest(const Instance *s);

/* dv/dt at the present time, for v that come from the history (n_v). */
void delay_rates(const Instance *s, double *rates);

#endif
