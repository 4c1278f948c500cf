/* Events at times known in advance: sample() clocks, relations of time alone, delayed breaks. */
#ifndef TIMEEVENTS_H
#define TIMEEVENTS_H

#include "instance.h"

/* Sets the flag of each clock that ticks after the last event and not after now. */
Status time_events_tick(Instance *s, bool *any);

/* The next time event after now, s; infinite if there is none. */
Status time_events_next(Instance *s, double *time);

#endif
