/* Saved states: one block with everything that decides how a run goes on. */
#ifndef STATE_H
#define STATE_H

#include "instance.h"

typedef struct SavedState SavedState;

/* Copies the instance's state into *state, which is allocated if null. */
Status state_save(Instance *s, const char *function, SavedState **state);
Status state_restore(Instance *s, const char *function, const SavedState *state);
void state_free(SavedState *state);

/* As bytes, for this model in any process on a machine with the same floating-point format. */
size_t state_size(const Instance *s);
Status state_serialise(Instance *s, const char *function, const SavedState *state, char *bytes, size_t size);
Status state_deserialise(Instance *s, const char *function, const char *bytes, size_t size, SavedState **state);

#endif
