/* FMI 2.0: model exchange. */
#include <math.h>

#include "evaluate.h"
#include "exchange.h"
#include "fmi2_front.h"
#include "vector.h"

fmi2Status fmi2EnterEventMode(fmi2Component c) {
    Instance *s = fmi2_enter_exchange(c, RUNNING_ME, "fmi2EnterEventMode");
    return s ? (fmi2Status)enter_event_mode(s) : fmi2Error;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
    static const char *const here = "fmi2NewDiscreteStates";
    Instance *s = fmi2_enter_exchange(c, PHASE_EVENT, here);
    if (!s || !instance_no_null(s, here, info)) return fmi2Error;
    EventResult result;
    const Status status = update_discrete_states(s, &result);
    info->newDiscreteStatesNeeded = fmi2False;
    info->terminateSimulation = result.terminate;
    info->nominalsOfContinuousStatesChanged = fmi2False;
    info->valuesOfContinuousStatesChanged = result.x_changed;
    info->nextEventTimeDefined = isfinite(result.next_time) ? fmi2True : fmi2False;
    info->nextEventTime = result.next_time;
    return (fmi2Status)status;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
    Instance *s = fmi2_enter_exchange(c, PHASE_EVENT, "fmi2EnterContinuousTimeMode");
    if (!s) return fmi2Error;
    set_phase(s, PHASE_CONTINUOUS);
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation) {
    static const char *const here = "fmi2CompletedIntegratorStep";
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *s = fmi2_enter_exchange(c, PHASE_CONTINUOUS, here);
    if (!s || !instance_no_null(s, here, enterEventMode) || !instance_no_null(s, here, terminateSimulation)) return fmi2Error;
    bool event = false;
    const Status status = completed_step(s, &event);
    *enterEventMode = event;
    *terminateSimulation = s->memory->is_terminated != 0;
    return (fmi2Status)status;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
    Instance *s = fmi2_enter_exchange(c, RUNNING_ME, "fmi2SetTime");
    return s ? (fmi2Status)set_time(s, "fmi2SetTime", time) : fmi2Error;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx) {
    static const char *const here = "fmi2SetContinuousStates";
    Instance *s = fmi2_enter_exchange(c, PHASE_CONTINUOUS, here);
    if (!s || !instance_is_array(s, here, x, nx, s->model->n_x)) return fmi2Error;
    copy(s->x, x, nx);
    changed_point(s);
    return fmi2OK;
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx) {
    static const char *const here = "fmi2GetDerivatives";
    Instance *s = fmi2_enter_exchange(c, IN_VALUES_ME, here);
    if (!s || !instance_is_array(s, here, derivatives, nx, s->model->n_x)) return fmi2Error;
    const Status status = current_derivatives(s);
    if (status == STATUS_OK) copy(derivatives, s->dx, nx);
    return (fmi2Status)status;
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t ni) {
    static const char *const here = "fmi2GetEventIndicators";
    Instance *s = fmi2_enter_exchange(c, IN_VALUES_ME, here);
    if (!s || !instance_is_array(s, here, indicators, ni, s->n_state_relations)) return fmi2Error;
    return (fmi2Status)current_indicators(s, indicators);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx) {
    static const char *const here = "fmi2GetContinuousStates";
    Instance *s = fmi2_enter_exchange(c, IN_VALUES_ME, here);
    if (!s || !instance_is_array(s, here, x, nx, s->model->n_x)) return fmi2Error;
    const Status status = current_states(s);
    if (status == STATUS_OK) copy(x, s->x, nx);
    return (fmi2Status)status;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[], size_t nx) {
    static const char *const here = "fmi2GetNominalsOfContinuousStates";
    Instance *s = fmi2_enter_exchange(c, IN_ANY, here);
    if (!s || !instance_is_array(s, here, x_nominal, nx, s->model->n_x)) return fmi2Error;
    copy(x_nominal, s->model->nominal_x, nx);
    return fmi2OK;
}
