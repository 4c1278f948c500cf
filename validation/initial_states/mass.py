"""A mass on a spring and a damper: its FMU, and its motion in closed form."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm
from scipy.signal import lfilter

import fmu_build
from pysim.io import read_model
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Model, Record
from pysim.types.record_kind import Command

Array = NDArray[np.float64]

TRUTH: Mapping[str, float] = {"m": 2.0, "d": 8.0, "c": 800.0}  # 3.2 Hz, a tenth of critical damping
UNITS = {"F": "N", "x": "m", "v": "m/s"}


def mass_model() -> Model:
    """The FMU, from the cache where it was built before."""
    return read_model(fmu_build.build("Mass", libraries=[Path(__file__).with_name("Mass.mo")]))


def motion(time: Array, force: Array, start: tuple[float, float], values: Mapping[str, float] = TRUTH) -> Array:
    """Position and speed (n_t, 2) in m and m/s, of a force (n_t,) in N that is linear between its samples.

    Exact: over a step of constant length the force is a line, so the states follow from the matrix exponential
    (Van Loan 1978, Computing integrals involving the matrix exponential), and a row of such steps is a linear filter.

    Args:
        time: (n_t,) s, equidistant.
        start: position and speed at the first time.
    """
    step = float(time[-1] - time[0]) / (time.size - 1)
    m, d, c = values["m"], values["d"], values["c"]
    whole = np.zeros((4, 4))  # states, force, its slope
    whole[0, 1], whole[1, :3], whole[2, 3] = 1.0, (-c / m, -d / m, 1 / m), 1.0
    a = expm(whole * step)
    transition, by_force, by_slope = a[:2, :2], a[:2, 2], a[:2, 3] / step
    pushed = force[:-1, None] * (by_force - by_slope) + force[1:, None] * by_slope
    # x[k+1] = A x[k] + p[k]; by Cayley and Hamilton each state alone obeys x[k+2] = tr x[k+1] - det x[k] + ...
    trace, determinant = float(np.trace(transition)), float(np.linalg.det(transition))
    adjugate = transition - trace * np.eye(2)
    first = np.array(start)
    source = np.vstack([first, pushed]) + np.vstack([np.zeros(2), first[None] @ adjugate.T, pushed[:-1] @ adjugate.T])
    return lfilter([1.0], [1.0, -trace, determinant], source, axis=0)


def force(time: Array, seed: int, size: float = 20.0) -> Array:
    """Twelve sines from 0.3 to 8 Hz with phases of their own, (n_t,) N."""
    rng = np.random.default_rng(seed)
    phases = rng.uniform(0, 2 * np.pi, 12)
    total = np.zeros(time.size)
    for f, phase in zip(np.geomspace(0.3, 8.0, 12), phases, strict=True):
        total += np.sin(2 * np.pi * f * time + phase)
    return size / np.sqrt(6) * total


def logged(
    source: str, time: Array, force: Array, states: Array, outputs: tuple[str, ...], use: str = "fit"
) -> MeasuredRecord:
    """A log of the force and of some of the states (n_t, 2)."""
    columns = [force, *(states[:, ("x", "v").index(name)] for name in outputs)]
    names = ("F", *outputs)
    data = Record(time, np.column_stack(columns), names, tuple(UNITS[name] for name in names), origin="virtual")
    return MeasuredRecord(source, "stochastic", use, data)


def measured(name: str, records: tuple[MeasuredRecord, ...], noise: Mapping[str, float]) -> Dataset:
    """The data set; `noise` is the standard deviation of each output, which is specified."""
    signals = [MeasuredSignal("F", "input", "N", "force", "F", hold=Command.LINES)]
    signals += [MeasuredSignal(n, "output", UNITS[n], n, n, noise=size) for n, size in noise.items()]
    return Dataset(name, "closed form", "mass on a spring", tuple(signals), records)


def at_rest(records: Sequence[MeasuredRecord]) -> tuple[MeasuredRecord, ...]:
    """The logs, their initial states held at rest."""
    return tuple(replace(record, initial="rest") for record in records)
