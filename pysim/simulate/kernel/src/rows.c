#include "rows.h"

#include <stdbool.h>

extern const RowSums plain_row_sums;

#ifdef __x86_64__
#include <cpuid.h>

extern const RowSums avx2_row_sums;

/* Intel, Software Developer's Manual, vol. 1, 14.7.1: the processor has AVX2, and the system saves its registers. */
static bool has_avx2(void) {
    unsigned a = 0, b = 0, c = 0, d = 0;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & bit_OSXSAVE) || !(c & bit_AVX)) return false;
    unsigned low = 0, high = 0;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    if ((low & 6u) != 6u) return false;
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & bit_AVX2);
}

const RowSums *row_sums(void) { return has_avx2() ? &avx2_row_sums : &plain_row_sums; }
#else
const RowSums *row_sums(void) { return &plain_row_sums; }
#endif

const RowSums *plainest_row_sums(void) { return &plain_row_sums; }
