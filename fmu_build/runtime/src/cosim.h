/* One communication step of co-simulation. */
#ifndef COSIM_H
#define COSIM_H

#include "instance.h"

typedef struct {
    double time;       /* reached, s */
    bool event_needed; /* stopped at an event that the importer has to handle */
    bool terminate;    /* the model asked for the end, in this step or before it */
    bool early;        /* stopped before the end of the step */
} StepResult;

/* Integrates from `point` over `size`. After Discard the instance is as it was before the call. */
Status cosim_step(Instance *s, const char *function, double point, double size, StepResult *result);

/* First event iteration of a co-simulation whose importer does not handle events. */
Status cosim_start(Instance *s);

#endif
