"""Data sets of complete plants, each drawn from a seed of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter, lsim

from pysim.bench import run_plan
from pysim.diagnosis import Session, session
from pysim.effects import read_catalogue
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record
from pysim.types.record_kind import Command
from pysim.workflow.variants import Variants
from validation.rig_diagnosis import machines as bench
from validation.rig_diagnosis.tests_of_bench import plan

Array = NDArray[np.float64]
Values = Mapping[str, float]

COUNT = 300
CONDITIONS = ("coloured", "motion", "unstated")
_BENCHES = 4  # of each condition, the last ones: a test bench takes minutes and not seconds
_SEED = 40_000  # of the first; nothing else is drawn from these
_SPREAD = 0.15  # of free parameters around the design, uniform
_SAMPLES = (2.0, 20.0)  # over which noise is correlated, log-uniform
_BEGINS = (0.5, 3.0)  # s of motion ahead of a log
_STATED = (0.0, 0.3, 3.0)  # noise that the data set states, over what there is; 0 where it states none
_RATE, _LENGTH = 50.0, 8.0  # Hz and s, of a log
_USES = ("fit", "fit", "validate")
_MODELS = Path(__file__).parents[2] / "tests" / "known_answers" / "models"


@dataclass(frozen=True)
class Linear:
    """A plant without effects, which is linear: states' = A states + b command.

    Args:
        design: numbers of the model; free: those that differ from it.
        equations: numbers -> A (n, n) and b (n, 1).
        command: name, unit, largest value, and band in Hz.
        sensors: state, name, unit and noise of each output.
    """

    design: Values
    free: tuple[str, ...]
    equations: Callable[[Values], tuple[Array, Array]]
    command: tuple[str, str, float, tuple[float, float]]
    sensors: tuple[tuple[int, str, str, float], ...]


def _mass(p: Values) -> tuple[Array, Array]:
    return np.array([[0, 1], [-p["k"] / p["m"], -p["d"] / p["m"]]]), np.array([[0], [1 / p["m"]]])


def _axis(p: Values) -> tuple[Array, Array]:
    m, d, gain, lag, stiff = p["m"], p["d"], p["K"], p["T"], p["K_v"]
    rows = [[0, 1, 0], [0, -d / m, gain / m], [-stiff / lag, 0, -1 / lag]]
    return np.array(rows), np.array([[0], [0], [stiff / lag]])


_PLANTS = {
    "mass": Linear(
        {"m": 1.0, "d": 2.0, "k": 40.0}, ("m", "d", "k"), _mass,
        ("F", "N", 8.0, (0.2, 2.5)), ((0, "x", "m", 1e-3),),
    ),
    "axis": Linear(
        {"m": 10.0, "d": 100.0, "K": 20.0, "T": 0.02, "K_v": 50.0}, ("d", "K", "T"), _axis,
        ("x_ref", "m", 0.1, (0.1, 1.5)), ((0, "x", "m", 1e-4), (2, "i", "V", 0.01)),
    ),
}  # fmt: skip


def names(count: int = COUNT) -> list[str]:
    """The first of them, number-plant-condition: masses and drives, at the end a few benches."""
    few = COUNT // 3 - _BENCHES
    plants = [("mass", "axis")[k % 2] if k < few else "bench" for k in range(COUNT // 3)]
    return [f"{k:03d}-{plants[k // 3]}-{CONDITIONS[k % 3]}" for k in range(count)]


def drawn(name: str) -> Session:
    """The complete model beside the logs of that name, with all effects of its catalogue."""
    number, plant, condition = name.split("-")
    rng = np.random.default_rng(_SEED + int(number))
    memory = float(np.exp(rng.uniform(*np.log(_SAMPLES)))) if condition == "coloured" else 0.0
    begins = round(_RATE * rng.uniform(*_BEGINS)) / _RATE if condition == "motion" else 0.0
    stated = float(rng.choice(_STATED)) if condition == "unstated" else 1.0
    if plant == "bench":
        return bench.asked(_bench(rng, memory, begins, stated))
    library = _MODELS / f"{plant.capitalize()}.mo"
    variants, data = _variants(library), _measured(_PLANTS[plant], rng, memory, begins, stated)
    model, catalogue = variants.build(())[0], read_catalogue(library)
    return session(model, data, catalogue, variants.build, slots=variants.slots, workers=1)


@cache
def _variants(library: Path) -> Variants:
    return Variants(f"{library.stem}.Design", (library,))


def _near(rng: np.random.Generator) -> float:
    return 1 + _SPREAD * float(rng.uniform(-1, 1))


def _measured(plant: Linear, rng: np.random.Generator, memory: float, begins: float, stated: float) -> Dataset:
    """Three logs of waves from rest, the last held out; the command is a line between its samples."""
    a, b = plant.equations({**plant.design, **{name: plant.design[name] * _near(rng) for name in plant.free}})
    time, records = np.arange(round((begins + _LENGTH) * _RATE)) / _RATE, []
    pushed, unit, *_ = plant.command
    shown, columns, units, noise = zip(*plant.sensors, strict=True)
    for k, use in enumerate(_USES):
        command, logged = _wave(plant, time, rng), time >= begins
        states = lsim((a, b, np.eye(len(a)), np.zeros((len(a), 1))), command, time)[1][:, list(shown)]
        values = states + np.column_stack([size * _noise(time.size, memory, rng) for size in noise])
        rows = np.column_stack([command, values])[logged]
        data = Record(time[: len(rows)], rows, (pushed, *columns), (unit, *units))
        records.append(MeasuredRecord(f"log-{k}.txt", "stochastic", use, data))
    signals = [MeasuredSignal(pushed, "input", unit, pushed, pushed, hold=Command.LINES)]
    for name, own, size in zip(columns, units, noise, strict=True):
        signals.append(MeasuredSignal(name, "output", own, name, name, noise=stated * size or None))
    return Dataset("null", "a complete plant", "plant", tuple(signals), tuple(records))


def _wave(plant: Linear, time: Array, rng: np.random.Generator) -> Array:
    """Eight sines of the band, grown from rest within the first second, (n_t,)."""
    _, _, peak, band = plant.command
    turns = np.outer(time, 2 * np.pi * rng.uniform(*band, 8)) + rng.uniform(0, 2 * np.pi, 8)
    wave = np.sin(turns).sum(axis=1)
    return np.asarray(peak * wave / np.abs(wave).max() * np.clip(time, 0, 1) ** 2)


def _noise(n: int, memory: float, rng: np.random.Generator) -> Array:
    """(n,) normal noise of unit standard deviation, correlated over `memory` samples (0: white), stationary."""
    kept = float(np.exp(-1 / memory)) if memory else 0.0
    fresh = rng.standard_normal(n)
    fresh[1:] *= np.sqrt(1 - kept**2)
    return np.asarray(lfilter([1.0], [1.0, -kept], fresh))


def _bench(rng: np.random.Generator, memory: float, begins: float, stated: float) -> Dataset:
    """Logs of the virtual bench; coloured noise as large as the white comes on top of it."""
    truth = {name: value * _near(rng) for name, value in bench.KNOWN_BADLY.items()}
    whole = run_plan(bench.BENCH.model, plan(), int(rng.integers(1_000_000)), parameters=truth).dataset
    size = {s.name: s.noise for s in whole.signals if s.noise is not None}
    louder = stated * (float(np.sqrt(2.0)) if memory else 1.0)

    def signal(own: MeasuredSignal) -> MeasuredSignal:
        return own if own.noise is None else replace(own, noise=own.noise * louder or None)

    def record(own: MeasuredRecord) -> MeasuredRecord:
        assert isinstance(own.data, Record)
        later, values = own.data.time >= own.data.time[0] + begins, own.data.values.copy()
        for j, name in enumerate(own.data.names):
            if memory and name in size:
                values[:, j] += size[name] * _noise(later.size, memory, rng)
        return replace(own, data=replace(own.data, time=own.data.time[later], values=values[later]))

    return replace(whole, signals=tuple(map(signal, whole.signals)), records=tuple(map(record, whole.records)))
