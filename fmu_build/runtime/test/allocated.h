/* Bytes that this program holds, where an address sanitizer counts them; 0 elsewhere, so that no growth is seen. */
#ifndef ALLOCATED_H
#define ALLOCATED_H

#include <stddef.h>

#if defined(__SANITIZE_ADDRESS__)
#define COUNTED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define COUNTED 1
#endif
#endif

#ifdef COUNTED
size_t __sanitizer_get_current_allocated_bytes(void);
static inline size_t allocated(void) { return __sanitizer_get_current_allocated_bytes(); }
#else
static inline size_t allocated(void) { return 0; }
#endif

#endif
