#include "state.h"

#include <stdlib.h>
#include <string.h>

#include "evaluate.h"

/* What must agree between a state and the instance that takes it. */
typedef struct {
    uint64_t magic; /* differs on a machine with another byte order */
    uint64_t model; /* hash of the model's token */
    uint64_t size;  /* bytes of memory that follow */
    uint64_t interface;
} Header;

struct SavedState {
    Header header;
    double memory[];
};

static const uint64_t MAGIC = 0x0131746174536d46u; /* "FmStat1", and a 1 for this layout */

enum { PHASES = PHASE_FAILED * 2 - 1 };

/* False for bytes that no instance wrote and that would lead out of the arrays. */
static bool is_plausible(const Instance *s, const double *memory) {
    Memory head;
    memcpy(&head, memory, sizeof head);
    const bool one_phase = head.phase != 0 && (head.phase & (head.phase - 1)) == 0 && head.phase <= PHASES;
    const size_t offset = (size_t)((const char *)s->delays - (const char *)s->memory);
    bool inside = true;
    for (size_t k = 0; k < s->model->n_v; k++) {
        DelayState delay;
        memcpy(&delay, (const char *)memory + offset + k * sizeof delay, sizeof delay);
        inside = inside && delay.first < DELAY_CAPACITY && delay.count <= DELAY_CAPACITY;
    }
    return one_phase && inside;
}

/* FNV-1a */
static uint64_t hash(const char *text) {
    uint64_t value = 14695981039346656037u;
    for (; *text; text++) value = (value ^ (uint64_t)(unsigned char)*text) * 1099511628211u;
    return value;
}

static Header header_of(const Instance *s) {
    return (Header){MAGIC, hash(s->model->token), s->memory_size, (uint64_t)s->interface};
}

static bool fits(Instance *s, const char *function, const Header *header) {
    const Header own = header_of(s);
    if (memcmp(header, &own, sizeof own) == 0) return true;
    log_message(s, LOG_ERROR, "%s: this is not a state of model %s with the same interface and build.", function,
                s->model->name);
    return false;
}

static SavedState *allocate(Instance *s, const char *function) {
    SavedState *state = malloc(sizeof *state + s->memory_size);
    if (!state) log_message(s, LOG_ERROR, "%s: no memory for a state of %zu bytes.", function, s->memory_size);
    return state;
}

Status state_save(Instance *s, const char *function, SavedState **state) {
    if (*state && !fits(s, function, &(*state)->header)) return STATUS_ERROR;
    if (!*state) *state = allocate(s, function);
    if (!*state) return STATUS_ERROR;
    (*state)->header = header_of(s);
    memcpy((*state)->memory, s->memory, s->memory_size);
    return STATUS_OK;
}

Status state_restore(Instance *s, const char *function, const SavedState *state) {
    if (!fits(s, function, &state->header)) return STATUS_ERROR;
    memcpy(s->memory, state->memory, s->memory_size);
    s->memory->computed &= HAS_START | HAS_C | HAS_V | HAS_Q; /* the others do not lie in the block */
    return STATUS_OK;
}

void state_free(SavedState *state) { free(state); }

size_t state_size(const Instance *s) { return sizeof(Header) + s->memory_size; }

static bool check_size(Instance *s, const char *function, size_t size) {
    if (size == state_size(s)) return true;
    log_message(s, LOG_ERROR, "%s: the size is %zu bytes, but a state has %zu.", function, size, state_size(s));
    return false;
}

Status state_serialise(Instance *s, const char *function, const SavedState *state, char *bytes, size_t size) {
    if (!check_size(s, function, size) || !fits(s, function, &state->header)) return STATUS_ERROR;
    memcpy(bytes, &state->header, sizeof state->header);
    memcpy(bytes + sizeof state->header, state->memory, s->memory_size);
    return STATUS_OK;
}

Status state_deserialise(Instance *s, const char *function, const char *bytes, size_t size, SavedState **state) {
    if (!check_size(s, function, size)) return STATUS_ERROR;
    Header header;
    memcpy(&header, bytes, sizeof header);
    if (!fits(s, function, &header)) return STATUS_ERROR;
    SavedState *fresh = allocate(s, function);
    if (!fresh) return STATUS_ERROR;
    fresh->header = header;
    memcpy(fresh->memory, bytes + sizeof header, s->memory_size);
    if (!is_plausible(s, fresh->memory)) {
        log_message(s, LOG_ERROR, "%s: the bytes are damaged.", function);
        free(fresh);
        return STATUS_ERROR;
    }
    *state = fresh; /* what the caller had there may be uninitialised */
    return STATUS_OK;
}
