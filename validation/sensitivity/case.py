"""One evaluation of the complete fit of the pump: 342 periodic orbits and two records of 20 s, by 13 parameters.

`python -m validation.sensitivity.case` prints the findings. Both ways of getting the derivatives run in turn on the
same FMU, and processor time counts, so that a busy machine slows both alike.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.identify.stepped_sine import stepped_sine
from pysim.simulate import Esdirk, Orbit, Periodic, Rodas, periodic_many, sensitivities_many, simulate_many
from pysim.thesis import FREQUENCIES_HZ, pump_model
from pysim.types import Experiment, Model, Outcome, Signal, SineTest
from validation.findings import Finding

PARAMETERS = ("omega_v", "zeta_v", "L", "A_p", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau")
RECORDED = ("alphaPercent", "u")
RATES = {"alphaCMD_t": "alphaCMD"}
POINTS = 32  # of a period

SOLVER = Esdirk(1e-4, 1e-4)
REFERENCE = Esdirk(1e-8, 1e-8)
RODAS = Rodas(1e-5, 1e-5)

RATIO = 10.0  # at least, in processor time
HARMONIC, HARMONIC_WORST = 2e-4, 1e-3  # of the angle's fundamental: median and worst
SLOPE, SLOPE_WORST = 1e-3, 0.05  # of its logarithm's derivatives by those of the parameters: median and 99 percent

Array = NDArray[np.float64]


def tests() -> list[SineTest]:
    """The thesis' 18: both signs of three offsets, three amplitudes."""
    sizes = [(sign * offset, a) for sign in (1, -1) for offset in (25, 50, 75) for a in (5, 10, 20)]
    return [SineTest(offset, amplitude, "alphaCMD", "alphaPercent") for offset, amplitude in sizes]


def orbits() -> list[Periodic]:
    """Their steady states at 19 frequencies."""
    return [_orbit(test, f) for test in tests() for f in FREQUENCIES_HZ]


def _orbit(test: SineTest, f: float) -> Periodic:
    sines = np.array([[[test.amplitude, 0.0, 2 * np.pi * f, 0.0]]])
    command = Signal(np.zeros(1), np.array([[test.offset, 0.0, 0.0, 0.0]]), sines)
    return Periodic(1 / f, POINTS, RECORDED, {"alphaCMD": command}, rates=RATES)


def records() -> list[Experiment]:
    """Two records of 20 s at 250 Hz: twelve sines between 0.2 and 12 Hz with phases of their own."""
    found = []
    for seed in (1, 2):
        phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, 12)
        frequencies = 2 * np.pi * np.geomspace(0.2, 12, 12)
        sines = np.stack([np.full(12, 3.0), phases, frequencies, np.zeros(12)], axis=1)
        command = Signal(np.zeros(1), np.array([[30.0, 0.0, 0.0, 0.0]]), sines[None])
        found.append(Experiment(np.arange(5001) / 250, RECORDED, {"alphaCMD": command}, rates=RATES))
    return found


def run() -> Iterator[Finding]:
    """The claims on this machine."""
    model, wanted = pump_model("free"), orbits()
    exact = periodic_many(model, wanted, PARAMETERS, solver=REFERENCE, mismatch=1e-6)
    failed = sum(orbit.outcome is not Outcome.DONE or orbit.iterations == 0 for orbit in exact)
    yield Finding("orbits that shooting does not find", failed, 0, f"of {len(wanted)}")
    guesses = [orbit.state for orbit in exact]
    found, ours = _timed(lambda: _evaluate(model, wanted, guesses))
    yield from _accuracy(model, found, exact)
    differences = _timed(lambda: _by_differences(model))[1]
    again = _timed(lambda: _evaluate(model, wanted, guesses))[1]
    seconds = 0.5 * (ours + again)
    words = f"{seconds:.2f} s of processor time against {differences:.1f} s"
    claim = f"one evaluation with derivatives against differences of runs, {words}"
    yield Finding(claim, seconds / differences, 1 / RATIO, "")


def _evaluate(model: Model, wanted: Sequence[Periodic], guesses: Sequence[Array]) -> tuple[Orbit, ...]:
    """From the orbits nearby, as every evaluation of a fit but the first."""
    found = periodic_many(model, wanted, PARAMETERS, guesses=guesses, solver=SOLVER)
    sensitivities_many(model, records(), PARAMETERS, solver=SOLVER)
    return found


def _by_differences(model: Model) -> None:
    """The settled stepped sines and the records, once as they are and once for each parameter moved."""
    runs = [replace(stepped_sine(test, f), record=RECORDED, rates=RATES) for test in tests() for f in FREQUENCIES_HZ]
    runs += records()
    moved = {name: float(model[name].start or 0.0) * 1.001 for name in PARAMETERS}
    for change in ({}, *({name: value} for name, value in moved.items())):
        simulate_many(model, [run.override(**change) for run in runs], solver=RODAS)


def _timed(call: Callable[[], Any]) -> tuple[Any, float]:
    started = time.process_time()
    result = call()
    return result, time.process_time() - started


def _accuracy(model: Model, found: Sequence[Orbit], exact: Sequence[Orbit]) -> Iterator[Finding]:
    """The angle's fundamental and its derivatives against orbits at a tight tolerance."""
    sizes = np.array([float(model[name].start or 0.0) for name in PARAMETERS])
    errors, slopes = [], []
    for orbit, reference in zip(found, exact, strict=True):
        first, wanted = _fundamental(orbit.record.values[:, 0]), _fundamental(reference.record.values[:, 0])
        errors.append(abs(first - wanted) / abs(wanted))
        slope = _fundamental(orbit.by_parameter[:, 0] - reference.by_parameter[:, 0])
        slopes.append(np.abs(slope) * sizes / abs(wanted))
    yield Finding("fundamental of the angle, median over all orbits", float(np.median(errors)), HARMONIC, "of it")
    yield Finding("fundamental of the angle, worst orbit", float(np.max(errors)), HARMONIC_WORST, "of it")
    yield Finding("its logarithmic derivatives, median", float(np.median(slopes)), SLOPE, "")
    yield Finding("its logarithmic derivatives, 99 percent", float(np.quantile(slopes, 0.99)), SLOPE_WORST, "")


def _fundamental(values: Array) -> Any:
    return np.fft.fft(values, axis=0)[1]


if __name__ == "__main__":
    for finding in run():
        print(finding)
