"""Step a co-simulation FMU with FMPy, an importer that knows nothing of how the FMU was made."""

from __future__ import annotations

from collections.abc import Callable

import fmpy
import numpy as np
from numpy.typing import NDArray

from pysim.types import Model, Record

Array = NDArray[np.float64]

STEP = 0.2e-3  # s between two communication points


def cosimulate(
    model: Model, command: Callable[[Array], tuple[Array, Array]], times: Array, names: tuple[str, ...]
) -> Record:
    """Run the pump by its own integrator from times[0] to times[-1].

    An input holds its value from one communication point to the next. It is set to what the command is half a step
    later, which makes the error of holding it second order in the step.

    Args:
        command: t (n_t,) -> alphaCMD in percent and its rate in percent/s.
        times: (n_t,) s, multiples of STEP.
        names: variables to record.
    """
    grid = np.arange(round((times[-1] - times[0]) / STEP) + 1) * STEP + times[0]
    value, rate = command(grid + STEP / 2)
    signals = np.zeros(grid.size, dtype=[("time", float), ("alphaCMD", float), ("alphaCMD_t", float)])
    signals["time"], signals["alphaCMD"], signals["alphaCMD_t"] = grid, value, rate
    result = fmpy.simulate_fmu(
        str(model.path),
        fmi_type="CoSimulation",
        stop_time=times[-1],
        output_interval=STEP,
        input=signals,
        output=list(names),
    )
    at = np.searchsorted(result["time"], times - STEP / 2)
    values = np.column_stack([result[name][at] for name in names])
    units = tuple(model[name].unit for name in names)
    return Record(times, values, names, units, origin=f"simulated {model.name}, co-simulation")
