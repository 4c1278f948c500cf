"""Every effect of the Modelica catalogue against the same effect in the blind plant, noise-free, test by test."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, Effect, Experiment, Model, Signal
from validation.asked import PUMP
from validation.blind.plant.effects import STANDARD, draw_effect, told
from validation.blind.plant.programme import RATE, Test, programme
from validation.blind.plant.quantities import STEP, Parameters, Strengths
from validation.blind.proof import readings_of
from validation.findings import Finding

Array = NDArray[np.float64]

SIZE = "middle"
FILES = (
    "frequency_response/O-50_A10/2Hz.txt",
    "frequency_response/O+50_A20/13Hz.txt",
    "frequency_response/O+75_A10/20Hz.txt",
    "stochastic/Tp0.5_heldout.txt",
)
_WAVE_SEED = 1
_SOLVER = Rodas(rtol=1e-6, atol=1e-6)
_LIMIT = 0.01  # percent, half the finest noise of the benchmark


def run() -> Iterator[Finding]:
    """Root mean square of the angle's difference over four tests, against what the effect itself does there."""
    tests = [test for test in programme() if test.file in FILES]
    base = {test.file: _plant(test, Strengths()) for test in tests}
    effects = {effect.name: effect for effect in PUMP.catalogue}
    for name in STANDARD:
        strengths = Strengths(**draw_effect(name, SIZE, np.random.default_rng(1)))
        model, places = PUMP.variants.build([effects[name]])
        overrides = _overrides(effects[name], places[name], told(name, strengths))
        plant = {test.file: _plant(test, strengths) for test in tests}
        off = np.concatenate([_fmu(test, model, overrides) - plant[test.file] for test in tests])
        does = np.concatenate([plant[file] - base[file] for file in plant])
        claim = f"{name}: FMU against plant ({_rms(does):.2g} % is what the effect does)"
        yield Finding(claim, _rms(off), _LIMIT, "%")


def _overrides(effect: Effect, place: str, strengths: Mapping[str, float]) -> dict[str, float]:
    """The effect's parameters by their names in the model; one over the strength where the class takes that."""
    found = {}
    for parameter in effect.parameters:
        spoken = parameter.inverse or parameter.name
        if spoken not in strengths:
            raise BadInput(f"{effect.name}: the plant has no {spoken}; it has {', '.join(strengths)}")
        value = strengths[spoken]
        found[f"{place}.{parameter.name}"] = 1 / value if parameter.inverse else value
    return found


def _plant(test: Test, strengths: Strengths) -> Array:
    readings = readings_of(test.command(_WAVE_SEED), Parameters(), strengths)
    return readings[: int(test.length * RATE + 1e-6) + 1, 0]


def _fmu(test: Test, model: Model, overrides: Mapping[str, float]) -> Array:
    """The same command from the same rest, lead included."""
    command = test.command(_WAVE_SEED)
    knots = np.arange(command.level.size) * command.every * STEP
    times = command.start + np.arange(int(test.length * RATE + 1e-6) + 1) / RATE
    inputs = {"alphaCMD": Signal.through(knots, command.level, command.slope)}
    experiment = Experiment(times, ("alphaPercent",), inputs, overrides, rates={"alphaCMD_t": "alphaCMD"})
    return simulate(model, experiment, solver=_SOLVER)["alphaPercent"]


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
