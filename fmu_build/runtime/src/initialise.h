/* The initial problem: calculated parameters, start values of states and discrete variables, first relations. */
#ifndef INITIALISE_H
#define INITIALISE_H

#include "instance.h"

/* Solves it if anything changed since the last time. Discard or Error, with a log line, if that fails. */
Status initialise(Instance *s);

#endif
