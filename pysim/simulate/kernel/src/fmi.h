/* The FMI functions of one instance, FMI 2 and FMI 3 alike. Each returns the FMU's status; a vector of no numbers is
   not asked for. */
#ifndef FMI_H
#define FMI_H

#include "job.h"

/* Makes the instance as new: reset, which the standard defines to give what a new one is, or instantiated anew where it
   refuses that or reported an error. */
int fmi_renew(Fmu *fmu);
void fmi_release(Fmu *fmu);

/* n values of one type, as many items of it. */
int fmi_set_values(const Fmu *fmu, Function *setter, const uint32_t *references, const void *values, int64_t n);

/* Times in s; no tolerance (0) where the steps are fixed. */
int fmi_setup(const Fmu *fmu, double tolerance, double start, double stop);
int fmi_enter_initialisation(const Fmu *fmu, double tolerance, double start, double stop);
int fmi_exit_initialisation(const Fmu *fmu);

/* The logger's two faces; `environment` is a Log. */
void fmi_log_2(void *environment, const char *instance, int status, const char *category, const char *format, ...);
void fmi_log_3(void *environment, int status, const char *category, const char *message);

int fmi_set_time(const Fmu *fmu, double t);
int fmi_set_states(const Fmu *fmu, const double *x, int64_t n);
int fmi_get_states(const Fmu *fmu, double *x, int64_t n);
int fmi_get_derivatives(const Fmu *fmu, double *dx, int64_t n);
int fmi_get_indicators(const Fmu *fmu, double *z, int64_t n);

/* Sizes (n,) of the states, all positive: the sign says nothing, and 1 stands for a size that cannot be one. */
int fmi_get_nominals(const Fmu *fmu, double *nominal, int64_t n);

int fmi_set_reals(const Fmu *fmu, const uint32_t *references, const double *values, int64_t n);

/* n variables of one type; `values` holds as many items of that type. */
int fmi_get_values(const Fmu *fmu, Function *getter, const uint32_t *references, void *values, int64_t n);

/* result (n_unknowns,) = d unknowns / d knowns times seed (n_knowns,), at the point last set. */
int fmi_get_directional(const Fmu *fmu, const uint32_t *unknowns, int64_t n_unknowns, const uint32_t *knowns,
                        int64_t n_knowns, const double *seed, double *result);

/* Where an FMU of ours keeps the derivatives by the states and by all parameters, column after column. */
int fmi_get_matrices(const Fmu *fmu, const double **by_states, const double **by_parameters);

/* Tells the FMU that it stands at an accepted point; fills `event` and `terminate`. */
int fmi_completed_step(Fmu *fmu);

int fmi_enter_event_mode(const Fmu *fmu);
int fmi_enter_continuous_mode(const Fmu *fmu);

/* One round of the event iteration; fills what the FMU asks for. */
int fmi_update_discrete(Fmu *fmu);

#endif
