/* What Python calls. */
#include "kernel.h"

#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

EXPORT int64_t kernel_job_size(void) { return (int64_t)sizeof(Job); }
EXPORT const RowSums *kernel_row_sums(void) { return row_sums(); }
EXPORT const RowSums *kernel_plain_row_sums(void) { return plainest_row_sums(); }
EXPORT int kernel_integrate(Job *job, int64_t budget) { return integrate(job, budget); }
EXPORT int kernel_integrate_variations(Job *job, int64_t budget) { return integrate_variations(job, budget); }
EXPORT int kernel_factorise(Job *job, double shift) { return factorise_shifted(job, shift); }
EXPORT void kernel_solve(Job *job, double *right) { solve_shifted(job, right); }
EXPORT void kernel_solve_rows(Job *job, double *right, int64_t width) { solve_shifted_rows(job, right, width); }
