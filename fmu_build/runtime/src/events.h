/* Events: the iteration over discrete equations, and the checks made at events and after steps. */
#ifndef EVENTS_H
#define EVENTS_H

#include "instance.h"

typedef struct {
    bool x_changed;   /* a state was reinitialised */
    bool terminate;   /* terminate() was called */
    double next_time; /* the next time event, s; infinite if there is none */
} EventResult;

/* Everything that happens at the present time, repeated until nothing changes. */
Status events_update(Instance *s, EventResult *result);

/* The same with initial() true, as a part of the initial problem: clocks do not tick, no checks are made. */
Status events_initial(Instance *s);

/* With terminal() true, for the last time. */
Status events_terminal(Instance *s);

/* assert(): Error where one fails, Warning where one of level warning begins to. */
Status events_check(Instance *s);

#endif
