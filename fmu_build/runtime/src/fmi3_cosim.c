/* FMI 3.0: co-simulation. */
#include "cosim.h"
#include "fmi3_front.h"

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    Instance *s = fmi3_enter_cosim(instance, PHASE_EVENT, "fmi3EnterStepMode");
    if (!s) return fmi3Error;
    set_phase(s, PHASE_STEP);
    return fmi3OK;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t nValues) {
    (void)valueReferences, (void)nValueReferences, (void)orders, (void)values, (void)nValues;
    return fmi3_no_ability(instance, "fmi3GetOutputDerivatives");
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
    static const char *const here = "fmi3DoStep";
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *s = fmi3_enter_cosim(instance, PHASE_STEP, here);
    if (!s) return fmi3Error;
    const void *const pointers[] = {eventHandlingNeeded, terminateSimulation, earlyReturn, lastSuccessfulTime};
    for (size_t k = 0; k < sizeof pointers / sizeof pointers[0]; k++)
        if (!instance_no_null(s, here, pointers[k])) return fmi3Error;
    StepResult result;
    const Status status = cosim_step(s, here, currentCommunicationPoint, communicationStepSize, &result);
    *eventHandlingNeeded = result.event_needed;
    *terminateSimulation = result.terminate;
    *earlyReturn = result.early && s->early_return_allowed; /* else only the model's end stops a step early */
    *lastSuccessfulTime = result.time;
    return (fmi3Status)status;
}
