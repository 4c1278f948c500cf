/* From an instance of any state to one in event mode at the start of a run. */
#include "kernel.h"

/* n values of one kind, the numbers values[places[i]], into memory of that kind. */
static void convert(int64_t kind, const double *values, const int64_t *places, int64_t n, void *memory) {
    for (int64_t i = 0; i < n; i++) {
        const double value = values[places[i]];
        switch (kind) {
            case KIND_SINGLE: ((float *)memory)[i] = (float)value; break;
            case KIND_INT: ((int32_t *)memory)[i] = (int32_t)value; break;
            case KIND_LONG: ((int64_t *)memory)[i] = (int64_t)value; break;
            case KIND_OCTET: ((uint8_t *)memory)[i] = value != 0.0; break;
            case KIND_INT8: ((int8_t *)memory)[i] = (int8_t)value; break;
            case KIND_UINT8: ((uint8_t *)memory)[i] = (uint8_t)value; break;
            case KIND_INT16: ((int16_t *)memory)[i] = (int16_t)value; break;
            case KIND_UINT16: ((uint16_t *)memory)[i] = (uint16_t)value; break;
            case KIND_UINT32: ((uint32_t *)memory)[i] = (uint32_t)value; break;
            case KIND_UINT64: ((uint64_t *)memory)[i] = (uint64_t)value; break;
            default: ((double *)memory)[i] = value;
        }
    }
}

int set_values(const Fmu *fmu, const Access *a, const double *values, void *buffer) {
    int status = OK;
    for (int64_t g = 0; g < a->groups && status <= WARNING; g++) {
        const int64_t first = a->first[g], count = a->first[g + 1] - first;
        convert(a->kinds[g], values, a->places + first, count, buffer);
        status = worse(status, fmi_set_values(fmu, a->functions[g], a->references + first, buffer, count));
    }
    return status;
}

int enter_initialisation(Fmu *fmu, double tolerance, double start, double stop) {
    const int status = fmi_setup(fmu, tolerance, start, stop);
    return status > WARNING ? status : worse(status, fmi_enter_initialisation(fmu, tolerance, start, stop));
}

void fresh_run(Job *job, double start, double end) {
    fill(job->work.scratch, 0.0, job->work.scratch_size);
    job->run = (Run){.start = start, .end = end, .t = start, .looked_at = start, .segment = -1};
    job->run.inputs_at = job->run.jacobian_at = job->run.offset_at = NAN;
    job->run.leaves = INFINITY;
    for (int64_t i = 0; i < job->inputs.count; i++) job->inputs.cursor[i] = job->inputs.pieces[i];
}

int start_instance(Job *job, const Task *task, double end) {
    Fmu *fmu = job->fmu;
    const double tolerance = job->control.step == 0.0 ? job->control.rtol : 0.0;
    if (fmi_renew(fmu) > WARNING) return PART_INSTANTIATE;
    job->inputs = task->inputs;
    fresh_run(job, task->start, end);
    job->run.horizon = INFINITY; /* an input has the value to the right of a jump at the start */
    int part = PART_SET, status = set_values(fmu, job->rows.set, task->set_values, job->rows.buffer);
    if (status <= WARNING) status = worse(status, set_inputs(job, task->start));
    if (status <= WARNING) part = PART_ENTER, status = enter_initialisation(fmu, tolerance, task->start, end);
    if (status <= WARNING) part = PART_EXIT, status = fmi_exit_initialisation(fmu);
    fmu->status = worse((int)fmu->status, status);
    job->run.status = status;
    return status <= WARNING ? PART_NONE : part;
}
