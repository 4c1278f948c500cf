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
EXPORT void kernel_work(Pass *pass, Job *job) { work(pass, job); }
EXPORT int kernel_renew(Fmu *fmu) { return fmi_renew(fmu); }
EXPORT int kernel_set_values(const Fmu *fmu, const Access *access, const double *values, void *buffer) {
    return set_values(fmu, access, values, buffer);
}
EXPORT int kernel_enter_initialisation(Fmu *fmu, double tolerance, double start, double stop) {
    return enter_initialisation(fmu, tolerance, start, stop);
}
EXPORT int kernel_exit_initialisation(const Fmu *fmu) { return fmi_exit_initialisation(fmu); }
EXPORT void kernel_release(Fmu *fmu) { fmi_release(fmu); }
EXPORT Function *kernel_log_2(void) { return (Function *)fmi_log_2; }
EXPORT double kernel_solve_least(Job *job, double *solved, int64_t m, double least) {
    double left = 0.0;
    solve_least(&job->shooting, solved, job->work.n, m, least, &left, job->work.sums);
    return left;
}
EXPORT int kernel_factorise(Job *job, double shift) { return factorise_shifted(job, shift); }
EXPORT void kernel_solve(Job *job, double *right) { solve_shifted(job, right); }
EXPORT void kernel_solve_rows(Job *job, double *right, int64_t width) { solve_shifted_rows(job, right, width); }
