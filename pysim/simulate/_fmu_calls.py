"""The FMI functions of one instance, for native code: where they are, and how FMI 2 and FMI 3 call them."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate._native import call, inlined, native

# fmi2Status and fmi3Status agree as far as they matter here.
OK, WARNING, DISCARD, ERROR, FATAL = 0, 1, 2, 3, 4

# Address of each function, beside the instance they are called for and the version that rules how.
FMU = np.dtype(
    [
        (name, np.int64)
        for name in (
            "fmi",
            "instance",
            "needs_completed_step",
            "set_time",
            "set_states",
            "get_states",
            "get_nominals",
            "get_derivatives",
            "get_indicators",
            "set_reals",
            "get_reals",
            "get_directional",
            "completed_step",
            "enter_event_mode",
            "update_discrete",
            "enter_continuous_mode",
        )
    ]
)

# What an FMU may ask for after a step or an event.
ASKS = np.dtype(
    [
        ("again", np.int64),  # another round of the event iteration
        ("event", np.int64),  # event mode
        ("terminate", np.int64),
        ("nominals", np.int64),  # they changed
        ("states", np.int64),  # they changed
        ("next_time", np.float64),  # of the next time event; infinite where there is none
    ]
)


@inlined
def set_time(fmu: Any, t: float) -> int:
    return call(fmu.set_time, (fmu.instance, t))


@inlined
def set_states(fmu: Any, x: Any) -> int:
    return call(fmu.set_states, (fmu.instance, x, x.size)) if x.size > 0 else OK


@inlined
def get_derivatives(fmu: Any, dx: Any) -> int:
    return call(fmu.get_derivatives, (fmu.instance, dx, dx.size)) if dx.size > 0 else OK


@native
def get_states(fmu: Any, x: Any) -> int:
    return call(fmu.get_states, (fmu.instance, x, x.size)) if x.size > 0 else OK


@native
def get_nominals(fmu: Any, nominal: Any) -> int:
    return call(fmu.get_nominals, (fmu.instance, nominal, nominal.size)) if nominal.size > 0 else OK


@native
def get_indicators(fmu: Any, z: Any) -> int:
    return call(fmu.get_indicators, (fmu.instance, z, z.size)) if z.size > 0 else OK


@inlined
def set_reals(fmu: Any, references: Any, values: Any) -> int:
    if fmu.fmi == 2:
        return call(fmu.set_reals, (fmu.instance, references, references.size, values))
    return call(fmu.set_reals, (fmu.instance, references, references.size, values, values.size))


@native
def get_values(fmu: Any, getter: int, references: Any, values: Any) -> int:
    """Read variables through one of the typed getters; `values` holds as many items of its type."""
    if fmu.fmi == 2:
        return call(getter, (fmu.instance, references, references.size, values))
    return call(getter, (fmu.instance, references, references.size, values, references.size))


@native
def get_directional(fmu: Any, unknowns: Any, knowns: Any, seed: Any, sensitivity: Any) -> int:
    """sensitivity = d unknowns / d knowns times seed, at the point last set."""
    n_unknowns, n_knowns = unknowns.size, knowns.size
    if fmu.fmi == 2:
        return call(fmu.get_directional, (fmu.instance, unknowns, n_unknowns, knowns, n_knowns, seed, sensitivity))
    return call(
        fmu.get_directional,
        (fmu.instance, unknowns, n_unknowns, knowns, n_knowns, seed, n_knowns, sensitivity, n_unknowns),
    )


@native
def completed_step(fmu: Any, asks: Any, flags: Any) -> int:
    """Tell the FMU that it stands at an accepted point; fills asks.event and asks.terminate."""
    asks.event = asks.terminate = 0
    if fmu.needs_completed_step == 0:
        return OK
    flags[:] = 0
    # The two answers are int in FMI 2 and one byte in FMI 3; in either case they fit the 8 bytes set aside for each.
    status = call(fmu.completed_step, (fmu.instance, np.int32(1), flags[0:8], flags[8:16]))
    asks.event, asks.terminate = _any(flags[0:8]), _any(flags[8:16])
    return status


@native
def _any(flag: Any) -> int:
    for byte in flag:
        if byte != 0:
            return 1
    return 0


@native
def enter_event_mode(fmu: Any) -> int:
    return call(fmu.enter_event_mode, (fmu.instance,))


@native
def enter_continuous_mode(fmu: Any) -> int:
    return call(fmu.enter_continuous_mode, (fmu.instance,))


@native
def update_discrete(fmu: Any, asks: Any, flags: Any, time: Any) -> int:
    """One round of the event iteration; fills all of `asks` but `event`."""
    flags[:] = 0
    if fmu.fmi == 2:  # struct fmi2EventInfo: five ints, padding, one double
        status = call(fmu.update_discrete, (fmu.instance, flags))
        words, time[0] = flags[:20].view(np.int32), flags[24:32].view(np.float64)[0]
        asks.again, asks.terminate, asks.nominals, asks.states, defined = words[0], words[1], words[2], words[3], words[4]
    else:
        again, terminate, nominals, states, defined_ = flags[0:1], flags[1:2], flags[2:3], flags[3:4], flags[4:5]
        status = call(fmu.update_discrete, (fmu.instance, again, terminate, nominals, states, defined_, time))
        asks.again, asks.terminate, asks.nominals, asks.states, defined = flags[0], flags[1], flags[2], flags[3], flags[4]
    asks.next_time = time[0] if defined != 0 else np.inf
    return status
