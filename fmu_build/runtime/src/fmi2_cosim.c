/* FMI 2.0: co-simulation. */
#include "cosim.h"
#include "fmi2_front.h"

static fmi2Status no_interpolation(fmi2Component c, const char *function) {
    Instance *s = fmi2_enter_cosim(c, IN_ANY, function);
    if (s) log_message(s, LOG_ERROR, "%s: this FMU has no such ability, as its description says.", function);
    return fmi2Error;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    return no_interpolation(c, "fmi2SetRealInputDerivatives");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    return no_interpolation(c, "fmi2GetRealOutputDerivatives");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    static const char *const here = "fmi2DoStep";
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *s = fmi2_enter_cosim(c, PHASE_STEP, here);
    if (!s) return fmi2Error;
    StepResult result;
    Status status = cosim_step(s, here, currentCommunicationPoint, communicationStepSize, &result);
    if (status == STATUS_DISCARD) set_phase(s, PHASE_STEP_FAILED);
    if (status <= STATUS_WARNING && result.terminate) status = STATUS_DISCARD; /* how FMI 2 reports the end */
    return (fmi2Status)status;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    Instance *s = fmi2_enter_cosim(c, IN_ANY, "fmi2CancelStep");
    if (s) log_message(s, LOG_ERROR, "fmi2CancelStep: steps do not run asynchronously.");
    return fmi2Error;
}

static fmi2Status no_status(Instance *s, const char *function) {
    log_message(s, LOG_ERROR, "%s: there is no such status; steps do not run asynchronously.", function);
    return fmi2Discard;
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
    static const char *const here = "fmi2GetStatus";
    Instance *s = fmi2_enter_cosim(c, IN_STATUS, here);
    if (!s || !instance_no_null(s, here, value)) return fmi2Error;
    if (kind != fmi2DoStepStatus) return no_status(s, here);
    *value = s->memory->phase == PHASE_STEP_FAILED ? fmi2Discard : fmi2OK;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
    static const char *const here = "fmi2GetRealStatus";
    Instance *s = fmi2_enter_cosim(c, IN_STATUS, here);
    if (!s || !instance_no_null(s, here, value)) return fmi2Error;
    if (kind != fmi2LastSuccessfulTime) return no_status(s, here);
    *value = *s->t; /* a step that failed was undone */
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
    static const char *const here = "fmi2GetBooleanStatus";
    Instance *s = fmi2_enter_cosim(c, IN_STATUS, here);
    if (!s || !instance_no_null(s, here, value)) return fmi2Error;
    if (kind != fmi2Terminated) return no_status(s, here);
    *value = s->memory->is_terminated ? fmi2True : fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
    (void)kind, (void)value;
    Instance *s = fmi2_enter_cosim(c, IN_STATUS, "fmi2GetIntegerStatus");
    return s ? no_status(s, "fmi2GetIntegerStatus") : fmi2Error;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
    (void)kind, (void)value;
    Instance *s = fmi2_enter_cosim(c, IN_STATUS, "fmi2GetStringStatus");
    return s ? no_status(s, "fmi2GetStringStatus") : fmi2Error;
}
