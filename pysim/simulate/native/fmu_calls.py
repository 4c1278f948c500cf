"""The FMI functions of one instance, for native code: where they are, and how FMI 2 and FMI 3 call them."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.native.compiled import call, doubles, ints, native, octets

# fmi2Status and fmi3Status agree as far as they matter here.
OK, WARNING, DISCARD, ERROR, FATAL = 0, 1, 2, 3, 4

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

# Addresses of the functions, and the instance they are called for.
FMU = np.dtype(
    [
        ("version", np.int64),  # 2 | 3
        ("instance", np.int64),
        ("needs_completed_step", np.int64),
        *((name, np.int64) for name in FUNCTIONS),
        ("answers", np.int64),  # (4,) of 8 bytes: where the FMU writes what follows
        # What the FMU asked for after the last step or event.
        ("again", np.int64),  # another round of the event iteration
        ("event", np.int64),  # event mode
        ("terminate", np.int64),
        ("nominals_changed", np.int64),
        ("states_changed", np.int64),
        ("next_time", np.float64),  # of its next time event, s; infinite where there is none
    ]
)


@native
def set_time(fmu: Any, t: float) -> int:
    return call(fmu.set_time, (fmu.instance, t))


@native
def set_states(fmu: Any, x: int, n: int) -> int:
    return call(fmu.set_states, (fmu.instance, x, n)) if n > 0 else OK


@native
def get_states(fmu: Any, x: int, n: int) -> int:
    return call(fmu.get_states, (fmu.instance, x, n)) if n > 0 else OK


@native
def get_nominals(fmu: Any, nominal: int, n: int) -> int:
    """Sizes (n,) of the states, all positive: the sign says nothing, and 1 stands for a size that cannot be one."""
    status, sizes = OK, doubles(nominal)
    if n > 0:
        status = call(fmu.get_nominals, (fmu.instance, nominal, n))
    for i in range(n):
        sizes[i] = abs(sizes[i]) if 0.0 < abs(sizes[i]) < np.inf else 1.0
    return status


@native
def get_derivatives(fmu: Any, dx: int, n: int) -> int:
    return call(fmu.get_derivatives, (fmu.instance, dx, n)) if n > 0 else OK


@native
def get_indicators(fmu: Any, z: int, n: int) -> int:
    return call(fmu.get_indicators, (fmu.instance, z, n)) if n > 0 else OK


@native
def set_reals(fmu: Any, references: int, values: int, n: int) -> int:
    if fmu.version == 2:
        return call(fmu.set_reals, (fmu.instance, references, n, values))
    return call(fmu.set_reals, (fmu.instance, references, n, values, n))


@native
def get_values(fmu: Any, getter: int, references: int, values: int, n: int) -> int:
    """Read n variables of one type; `values` is the address of as many items of that type."""
    if fmu.version == 2:
        return call(getter, (fmu.instance, references, n, values))
    return call(getter, (fmu.instance, references, n, values, n))


@native
def get_directional(
    fmu: Any, unknowns: int, n_unknowns: int, knowns: int, n_knowns: int, seed: int, result: int
) -> int:
    """result (n_unknowns,) = d unknowns / d knowns times seed (n_knowns,), at the point last set."""
    if fmu.version == 2:
        return call(fmu.get_directional, (fmu.instance, unknowns, n_unknowns, knowns, n_knowns, seed, result))
    return call(
        fmu.get_directional, (fmu.instance, unknowns, n_unknowns, knowns, n_knowns, seed, n_knowns, result, n_unknowns)
    )


@native
def completed_step(fmu: Any) -> int:
    """Tell the FMU that it stands at an accepted point; fills `event` and `terminate`."""
    fmu.event = fmu.terminate = 0
    if fmu.needs_completed_step == 0:
        return OK
    event, terminate = fmu.answers, fmu.answers + 8
    _clear(fmu)
    status = call(fmu.completed_step, (fmu.instance, np.int32(1), event, terminate))
    # The answers are int in FMI 2 and bool, one byte, in FMI 3; all bytes around them are zero.
    fmu.event, fmu.terminate = ints(event)[0], ints(terminate)[0]
    return status


@native
def enter_event_mode(fmu: Any) -> int:
    return call(fmu.enter_event_mode, (fmu.instance,))


@native
def enter_continuous_mode(fmu: Any) -> int:
    return call(fmu.enter_continuous_mode, (fmu.instance,))


@native
def update_discrete(fmu: Any) -> int:
    """One round of the event iteration; fills what the FMU asks for."""
    _clear(fmu)
    start, time = fmu.answers, fmu.answers + 24
    if fmu.version == 2:  # struct fmi2EventInfo: five ints, padding, one double
        status = call(fmu.update_discrete, (fmu.instance, start))
        info = ints(start)
        _understand(fmu, info[0], info[1], info[2], info[3], info[4])
    else:  # five bools and one double
        status = call(fmu.update_discrete, (fmu.instance, start, start + 1, start + 2, start + 3, start + 4, time))
        flags = octets(start)
        _understand(fmu, flags[0], flags[1], flags[2], flags[3], flags[4])
    return status


@native
def _understand(fmu: Any, again: int, terminate: int, nominals: int, states: int, defined: int) -> None:
    fmu.again, fmu.terminate, fmu.nominals_changed, fmu.states_changed = again, terminate, nominals, states
    fmu.next_time = doubles(fmu.answers)[3] if defined != 0 else np.inf


@native
def _clear(fmu: Any) -> None:
    answers = doubles(fmu.answers)
    for i in range(4):
        answers[i] = 0.0
