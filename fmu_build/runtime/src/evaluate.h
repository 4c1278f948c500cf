/* The model's equations, evaluated when somebody asks and only as far as asked. Each function brings its values up
   to date and returns Discard, with a log line, where the model has none. */
#ifndef EVALUATE_H
#define EVALUATE_H

#include "instance.h"

Status evaluate_calculated(Instance *s);  /* c, delay times */
Status evaluate_unknowns(Instance *s);    /* v, q: all that derivatives and outputs need */
Status evaluate_derivatives(Instance *s); /* dx */
Status evaluate_outputs(Instance *s);     /* w */
Status evaluate_indicators(Instance *s);  /* z, as the model gives it */

/* Adds the present point to the histories of delay(), if there are any; `is_break` as for delay_record. */
Status evaluate_history(Instance *s, bool is_break);

/* What a change leaves valid. */
static inline void changed_parameters(Instance *s) { s->memory->computed = 0; }
static inline void changed_point(Instance *s) { s->memory->computed &= HAS_START | HAS_C; }
static inline void changed_discrete(Instance *s) { s->memory->computed &= HAS_START | HAS_C; }

static inline bool is_computed(const Instance *s, Computed what) { return s->memory->computed & (uint32_t)what; }
static inline void set_computed(Instance *s, Computed what) { s->memory->computed |= (uint32_t)what; }
static inline void clear_computed(Instance *s, Computed what) { s->memory->computed &= ~(uint32_t)what; }

/* Name of the first variable kept at `index` of a vector, for messages. */
const char *variable_name(const Instance *s, Vector vector, size_t index);

#endif
