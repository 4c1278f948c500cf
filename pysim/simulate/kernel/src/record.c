/* Recording: rows of variables at the requested times. */
#include "kernel.h"

static double converted(int64_t kind, const void *buffer, int64_t i) {
    switch (kind) {
        case KIND_SINGLE: return (double)((const float *)buffer)[i];
        case KIND_INT: return (double)((const int32_t *)buffer)[i];
        case KIND_LONG: return (double)((const int64_t *)buffer)[i];
        case KIND_OCTET: return (double)((const uint8_t *)buffer)[i];
        case KIND_INT8: return (double)((const int8_t *)buffer)[i];
        case KIND_UINT8: return (double)((const uint8_t *)buffer)[i];
        case KIND_INT16: return (double)((const int16_t *)buffer)[i];
        case KIND_UINT16: return (double)((const uint16_t *)buffer)[i];
        case KIND_UINT32: return (double)((const uint32_t *)buffer)[i];
        case KIND_UINT64: return (double)((const uint64_t *)buffer)[i];
        default: return ((const double *)buffer)[i];
    }
}

/* One row, at the point last set. */
int read_row(Job *job) {
    Rows *rows = &job->rows;
    double *row = rows->values + (rows->next - rows->first) * rows->columns;
    const Access *a = rows->access;
    for (int64_t g = 0; g < a->groups; g++) {
        const int64_t first = a->first[g], count = a->first[g + 1] - first;
        const int status = fmi_get_values(job->fmu, a->functions[g], a->references + first, rows->buffer, count);
        if (status > WARNING) return status;
        for (int64_t i = 0; i < count; i++) row[a->places[first + i]] = converted(a->kinds[g], rows->buffer, i);
    }
    rows->next++;
    return OK;
}

/* Derivatives of the rows in memory go where they are asked for, and the rows to whoever takes them. */
void hand_over(Job *job) {
    Rows *rows = &job->rows;
    const Variation *v = &job->variation;
    const int64_t count = rows->next - rows->first, from = v->from_start ? v->by_start : 0; /* those of an offset stay */
    const int64_t kept = v->by_start - from + v->parameters;
    for (int64_t r = 0; r < count * rows->columns; r++) copy(rows->slopes + r * kept, v->rows + r * v->columns + from, kept);
    if (!rows->take) return;
    ((Take *)rows->take)(rows->number, rows->first, count);
    rows->first = rows->next;
}

/* Every row before t_end (s) in the step of length h from run.t; work.dense is filled. */
int record_inside(Job *job, double h, double t_end) {
    Rows *rows = &job->rows;
    while (rows->next < rows->count && rows->times[rows->next] < t_end) {
        const double t = rows->times[rows->next];
        interpolate(job, (t - job->run.t) / h);
        int status = set_point(job, t, job->work.x_try);
        if (status <= WARNING) status = read_row(job);
        if (status > WARNING) return status;
    }
    return OK;
}

/* The row that falls on run.t, if there is one. */
int record_here(Job *job) {
    const Rows *rows = &job->rows;
    if (rows->next >= rows->count || rows->times[rows->next] > job->run.t) return OK;
    const int status = set_point(job, job->run.t, job->work.x);
    return status > WARNING ? status : read_row(job);
}
