/* FMI 3.0: model exchange. */
#include "evaluate.h"
#include "exchange.h"
#include "fmi3_front.h"
#include "vector.h"

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    Instance *s = fmi3_enter_exchange(instance, PHASE_EVENT, "fmi3EnterContinuousTimeMode");
    if (!s) return fmi3Error;
    set_phase(s, PHASE_CONTINUOUS);
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation) {
    static const char *const here = "fmi3CompletedIntegratorStep";
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *s = fmi3_enter_exchange(instance, PHASE_CONTINUOUS, here);
    if (!s || !instance_no_null(s, here, enterEventMode) || !instance_no_null(s, here, terminateSimulation)) return fmi3Error;
    const Status status = completed_step(s, enterEventMode);
    *terminateSimulation = s->memory->is_terminated != 0;
    return (fmi3Status)status;
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    Instance *s = fmi3_enter_exchange(instance, PHASE_EVENT | PHASE_CONTINUOUS, "fmi3SetTime");
    return s ? (fmi3Status)set_time(s, "fmi3SetTime", time) : fmi3Error;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
    static const char *const here = "fmi3SetContinuousStates";
    Instance *s = fmi3_enter_exchange(instance, PHASE_CONTINUOUS, here);
    if (!s || !instance_is_array(s, here, continuousStates, nContinuousStates, s->model->n_x)) return fmi3Error;
    copy(s->x, continuousStates, nContinuousStates);
    changed_point(s);
    return fmi3OK;
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates) {
    static const char *const here = "fmi3GetContinuousStateDerivatives";
    Instance *s = fmi3_enter_exchange(instance, IN_VALUES, here);
    if (!s || !instance_is_array(s, here, derivatives, nContinuousStates, s->model->n_x)) return fmi3Error;
    const Status status = current_derivatives(s);
    if (status == STATUS_OK) copy(derivatives, s->dx, nContinuousStates);
    return (fmi3Status)status;
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[], size_t nEventIndicators) {
    static const char *const here = "fmi3GetEventIndicators";
    Instance *s = fmi3_enter_exchange(instance, IN_VALUES, here);
    if (!s || !instance_is_array(s, here, eventIndicators, nEventIndicators, s->n_state_relations)) return fmi3Error;
    return (fmi3Status)current_indicators(s, eventIndicators);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[], size_t nContinuousStates) {
    static const char *const here = "fmi3GetContinuousStates";
    Instance *s = fmi3_enter_exchange(instance, IN_VALUES, here);
    if (!s || !instance_is_array(s, here, continuousStates, nContinuousStates, s->model->n_x)) return fmi3Error;
    const Status status = current_states(s);
    if (status == STATUS_OK) copy(continuousStates, s->x, nContinuousStates);
    return (fmi3Status)status;
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t nContinuousStates) {
    static const char *const here = "fmi3GetNominalsOfContinuousStates";
    Instance *s = fmi3_enter_exchange(instance, IN_STATE, here);
    if (!s || !instance_is_array(s, here, nominals, nContinuousStates, s->model->n_x)) return fmi3Error;
    copy(nominals, s->model->nominal_x, nContinuousStates);
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
    static const char *const here = "fmi3GetNumberOfEventIndicators";
    Instance *s = fmi3_enter_exchange(instance, IN_STATE, here);
    if (!s || !instance_no_null(s, here, nEventIndicators)) return fmi3Error;
    *nEventIndicators = s->n_state_relations;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
    static const char *const here = "fmi3GetNumberOfContinuousStates";
    Instance *s = fmi3_enter_exchange(instance, IN_STATE, here);
    if (!s || !instance_no_null(s, here, nContinuousStates)) return fmi3Error;
    *nContinuousStates = s->model->n_x;
    return fmi3OK;
}
