/* For x86 processors with AVX2. Elsewhere it is empty. */
#ifdef __x86_64__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#define PREFIX avx2_
#include "rows_body.h"
#pragma clang attribute pop
#else
typedef int Empty;
#endif
