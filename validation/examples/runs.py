"""One example by two ways that share the FMU only: FMPy's loop with CVODE, and our native loop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from fmpy import simulate_fmu
from numpy.typing import NDArray

import fmu_build
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Model, Record
from validation.examples.catalogue import WIDEST, Example, libraries_of

Array = NDArray[np.float64]

CVODE_TOLERANCE = 1e-10
NATIVE = Rodas(rtol=1e-8, atol=1e-8)
_PARTS = (10, 100, 1000, 10000)


def built(example: Example, compiler: str = "rumoca") -> Path:
    """The example's FMU. Raises BuildError, and LookupError where it needs a library that is not there."""
    return fmu_build.build(example.name, libraries=libraries_of(example), compiler=compiler)


def columns(model: Model) -> tuple[str, ...]:
    """What is stored: the states, thinned out evenly where there are many; of a model without, what is continuous."""
    names = model.abilities.states or tuple(
        variable.name
        for variable in model.variables
        if variable.variability == "continuous" and variable.causality in ("local", "output")
    )
    step = -(-len(names) // WIDEST) or 1
    return tuple(name for name in names[::step] if name != "time")


def native(model: Model, times: Array, names: Sequence[str], solver: Rodas = NATIVE) -> Record:
    """By the native loop."""
    return simulate(model, Experiment(times, tuple(names)), solver=solver)


def by_cvode(fmu: Path, times: Array, names: Sequence[str], tolerance: float = CVODE_TOLERANCE) -> Mapping[str, Array]:
    """By FMPy's loop with CVODE on the model-exchange side; values (n_t,) by name."""
    for parts in _PARTS:  # CVODE gives up after 500 steps without an output
        try:
            return _recorded(
                fmu, times, names, parts, fmi_type="ModelExchange", solver="CVode", relative_tolerance=tolerance
            )
        except RuntimeError as error:
            if "mxstep" not in str(error) or parts == _PARTS[-1]:
                raise
    raise AssertionError("there is a last part")


def by_cosimulation(fmu: Path, times: Array, names: Sequence[str]) -> Mapping[str, Array]:
    """By the solver inside the FMU, from one time to the next; values (n_t,) by name."""
    return _recorded(fmu, times, names, 1, fmi_type="CoSimulation")


def _recorded(fmu: Path, times: Array, names: Sequence[str], parts: int, **options: object) -> Mapping[str, Array]:
    """FMPy's result at `times`, with `parts` communication steps from one to the next."""
    result = simulate_fmu(
        str(fmu),
        start_time=float(times[0]),
        stop_time=float(times[-1]),
        output_interval=float(times[1] - times[0]) / parts,
        output=list(names),
        record_events=False,
        logger=lambda *words: None,
        **options,
    )[::parts]
    got = np.asarray(result["time"])
    if got.size != times.size or np.abs(got - times).max() > 1e-9 * max(float(times[-1]), 1.0):
        raise RuntimeError(f"FMPy recorded {got.size} times of {fmu.name}, not the {times.size} asked for")
    return {name: np.asarray(result[name], dtype=np.float64) for name in names}


def off(one: Array, other: Array, nominal: float | None) -> float:
    """Largest difference of two columns (n_t,) over the span of the second.

    A variable that hardly moves counts with a thousandth of its size or of its nominal value, which is 1 where FMI has
    none: finer than that the solvers' absolute tolerances do not resolve.
    """
    span = max(float(np.ptp(other)), 1e-3 * float(np.abs(other).max()), 1e-3 * (nominal or 1.0))
    return float(np.abs(one - other).max()) / span
