/* Values by value reference, with FMI's rules on who may be set when. */
#ifndef VARIABLES_H
#define VARIABLES_H

#include "instance.h"

/* Both check the reference and that the variable is of `type`; `function` is the caller, for the log. */
Status variable_get(Instance *s, const char *function, uint32_t reference, ScalarType type, double *value);
Status variable_set(Instance *s, const char *function, uint32_t reference, ScalarType type, double value);

/* The variable behind a reference, or null (it is logged). */
const ModelVariable *variable_find(Instance *s, const char *function, uint32_t reference);

#endif
