"""The FMI functions that the kernel calls."""

from __future__ import annotations

# Field of the table below -> function, FMI 2 and FMI 3.
FUNCTIONS = {
    "set_time": ("fmi2SetTime", "fmi3SetTime"),
    "set_states": ("fmi2SetContinuousStates", "fmi3SetContinuousStates"),
    "get_states": ("fmi2GetContinuousStates", "fmi3GetContinuousStates"),
    "get_nominals": ("fmi2GetNominalsOfContinuousStates", "fmi3GetNominalsOfContinuousStates"),
    "get_derivatives": ("fmi2GetDerivatives", "fmi3GetContinuousStateDerivatives"),
    "get_indicators": ("fmi2GetEventIndicators", "fmi3GetEventIndicators"),
    "set_reals": ("fmi2SetReal", "fmi3SetFloat64"),
    "get_directional": ("fmi2GetDirectionalDerivative", "fmi3GetDirectionalDerivative"),
    "completed_step": ("fmi2CompletedIntegratorStep", "fmi3CompletedIntegratorStep"),
    "enter_event_mode": ("fmi2EnterEventMode", "fmi3EnterEventMode"),
    "update_discrete": ("fmi2NewDiscreteStates", "fmi3UpdateDiscreteStates"),
    "enter_continuous_mode": ("fmi2EnterContinuousTimeMode", "fmi3EnterContinuousTimeMode"),
}
