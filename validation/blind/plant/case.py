"""One case of the benchmark: what is in the plant and how it is measured; the logs it leaves, and the truth."""

from __future__ import annotations

import json
import math
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io import write_dataset
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record
from validation.blind.plant.effects import draw_effect, told
from validation.blind.plant.equations import run
from validation.blind.plant.nuisance import Nuisance, deviation_told, draw_nuisance, noise
from validation.blind.plant.programme import RATE, Test, programme
from validation.blind.plant.quantities import BOUNDS, STEP, Parameters, Strengths

Array = NDArray[np.float64]

ANGLE_STEP, SPOOL_STEP = 240.0 / 4096, 2.4 / 4096  # percent and 1: 12 bits over +-120 percent and +-1.2
_SPOOL_NOISE = 0.02  # of the spool's reading, over the angle's noise in percent
_SPREAD = 0.3  # of the parameters around the thesis' values
_PERCENT = math.radians(15.0) / 100
_SAMPLE = round(1 / RATE / STEP)  # steps
_UNITS = {"alphaCMD": "%", "alphaPercent": "%", "u": "1"}


@dataclass(frozen=True)
class Case:
    """What stands behind one data set; the same case always leaves the same logs.

    Args:
        name: of the data set's folder; unique in a table.
        kind: "none" | "named" | "shaped" | "beyond" | "left-out" | "pair".
        effects: (name, size) of each effect in force.
        nuisances: kinds of nuisance in force.
        noise: standard deviation of the angle's white noise, percent.
        spool: whether the spool's position is logged beside the waves.
        left_out: effects that the diagnosis must not know of in this case.
        seed: of parameters, strengths, waves and noise.
    """

    name: str
    kind: str
    effects: tuple[tuple[str, str], ...] = ()
    nuisances: tuple[str, ...] = ()
    noise: float = 0.1
    spool: bool = True
    left_out: tuple[str, ...] = ()
    seed: int = 0

    @property
    def expected(self) -> tuple[str, ...]:
        """The right answer: names in any order, ("none",) or ("unknown",)."""
        if self.kind in ("beyond", "left-out"):
            return ("unknown",)
        return tuple(name.partition("~")[0] for name, _ in self.effects) or ("none",)

    def parameters(self) -> Parameters:
        """Each identified one within 30 percent of the thesis' value and within its bounds."""
        rng = self._stream("parameters")
        drawn = {}
        for name, (low, high) in BOUNDS.items():
            value = getattr(Parameters(), name) * (1 + _SPREAD * rng.uniform(-1, 1))
            drawn[name] = float(min(max(value, low), high))
        return Parameters(**drawn)

    def strengths(self) -> Strengths:
        """Of all its effects."""
        drawn: dict[str, float] = {}
        for name, size in self.effects:
            drawn |= draw_effect(name, size, self._stream(f"strength of {name}"))
        return Strengths(**drawn)

    def nuisance(self) -> Nuisance:
        """At the sizes that the seed draws."""
        return draw_nuisance(self.nuisances, self._stream("nuisance"))

    def _stream(self, purpose: str) -> np.random.Generator:
        """Random numbers of one purpose, independent of those of any other."""
        return np.random.default_rng((self.seed, zlib.crc32(purpose.encode())))


@dataclass(frozen=True)
class Measured:
    """What a case leaves.

    Args:
        dataset: noisy logs.
        clean: file -> angle (percent) and spool (1), (n, 2): the same readings without noise and resolution.
        states: file -> logged values (n, 8) of the plant as `COLUMNS` of the equations says, at the logs' instants.
        deviation: of the noise in each output, resolution included.
        truth: for JSON.
    """

    dataset: Dataset
    clean: Mapping[str, Array]
    states: Mapping[str, Array] = field(repr=False)
    deviation: Mapping[str, float]
    truth: Mapping[str, Any]


def measure(case: Case) -> Measured:
    """Carry out the case's session: every test, one after the other."""
    clean, states, records = {}, {}, []
    nuisance = case.nuisance()
    for test, command, logged, begin in _session(case):
        readings = np.column_stack([logged[:, 0] / _PERCENT, logged[:, 1]])
        hours = (begin + np.arange(len(logged)) / RATE) / 3600
        readings[:, 0] = nuisance.gain * readings[:, 0] + nuisance.offset + nuisance.drift * hours
        clean[test.file], states[test.file] = readings, logged
        records.append(replace(_record(case, test, command, readings), begin=begin))
    noise = deviation_told(case.noise, nuisance)
    deviation = {one.name: one.deviation for one in _signals(case, noise) if one.role == "output"}
    signals = _signals(case, nuisance.stated * noise or None)
    about = "swash plate tests without load: stepped sine, chirp, stochastic wave"
    dataset = Dataset(case.name, about, "pump", signals, tuple(records))
    return Measured(dataset, clean, states, deviation, _truth(case))


def write_case(case: Case, folder: Path, truth_folder: Path) -> Path:
    """Write the data set to `folder`/name and, apart from it, the truth: name.truth.json and name.truth.npz.

    Returns:
        the path of dataset.toml.
    Raises:
        BadInput: the data set's folder holds something.
    """
    measured = measure(case)
    path = write_dataset(folder / case.name, measured.dataset)
    truth_folder.mkdir(parents=True, exist_ok=True)
    text = json.dumps(dict(measured.truth), indent=1)
    (truth_folder / f"{case.name}.truth.json").write_text(text + "\n", encoding="utf-8")
    arrays = {file: values.astype(np.float32) for file, values in measured.clean.items()}
    np.savez_compressed(truth_folder / f"{case.name}.truth.npz", allow_pickle=False, **arrays)
    return path


def _session(case: Case) -> Iterator[tuple[Test, Array, Array, float]]:
    """Test by test: what was logged of the command (percent) and of the plant, and when that began, s."""
    nuisance, parameters, strengths = case.nuisance(), case.parameters(), case.strengths()
    tests = programme()
    commands = [test.command(case.seed, hold=nuisance.hold, before=nuisance.before) for test in tests]
    session = sum(command.start + test.length for test, command in zip(tests, commands, strict=True))
    clock = 0.0
    for test, command in zip(tests, commands, strict=True):
        first = round(command.start / STEP)
        n = (
            round(test.length * RATE - 1e-6) + 1
            if test.frequency is None
            else math.floor(test.length * RATE + 1e-6) + 1
        )
        later = round(nuisance.shift / STEP)
        extra = math.ceil(later / command.every)  # knots, for outputs that are logged later
        level = np.concatenate([command.level, np.full(extra, command.level[-1])]) * _PERCENT
        slope = np.concatenate([command.slope, np.zeros(extra)]) * _PERCENT
        logged = run(
            level, slope, command.every, first + later, _SAMPLE,
            parameters=parameters, strengths=strengths, clock=clock, session=session,
        )  # fmt: skip
        knots = (first + np.arange(n) * _SAMPLE) // command.every
        yield test, command.level[knots], logged[:n], clock + command.start
        clock += command.start + test.length


def _record(case: Case, test: Test, command: Array, readings: Array) -> MeasuredRecord:
    """The log as the bench writes it: time since the test began, noise, 12 bits."""
    n, nuisance = len(command), case.nuisance()
    rng = case._stream(f"noise of {test.file}")
    angle = readings[:, 0] + noise(n, case.noise, nuisance, 1 / RATE, rng)
    spool = readings[:, 1] + noise(n, case.noise * _SPOOL_NOISE, nuisance, 1 / RATE, rng)
    columns = {"alphaCMD": command, "alphaPercent": np.round(angle / ANGLE_STEP) * ANGLE_STEP}
    if case.spool and test.kind == "stochastic":
        columns["u"] = np.round(spool / SPOOL_STEP) * SPOOL_STEP
    lead = round((1.0 + nuisance.hold) * RATE) / RATE
    time = lead + np.arange(n) / RATE + nuisance.jitter * rng.uniform(-1, 1, n)
    units = tuple(_UNITS[name] for name in columns)
    data = Record(time, np.column_stack(list(columns.values())), tuple(columns), units, origin="measured")
    return MeasuredRecord(test.file, test.kind, test.use, data, test.offset, test.amplitude, test.frequency)


def _signals(case: Case, angle: float | None) -> tuple[MeasuredSignal, ...]:
    """The columns of its logs, with the angle's noise that is stated, percent."""
    spool = None if angle is None else angle * _SPOOL_NOISE
    signals = (
        MeasuredSignal("alphaCMD", "input", "%", "swash plate angle command", "alphaCMD"),
        MeasuredSignal("alphaPercent", "output", "%", "swash plate angle", "alphaPercent", angle, ANGLE_STEP),
        MeasuredSignal("u", "output", "1", "spool position", "u", spool, SPOOL_STEP),
    )
    return signals if case.spool else signals[:2]


def _truth(case: Case) -> dict[str, Any]:
    strengths = case.strengths()
    identified = {name: float(getattr(case.parameters(), name)) for name in BOUNDS}
    return {
        "case": asdict(case),
        "effect": list(case.expected),
        "in_force": {name: told(name, strengths) for name, _ in case.effects},
        "parameters": identified,
        "nuisance": asdict(case.nuisance()),
        "noise_percent": case.noise,
        "noise_u": case.noise * _SPOOL_NOISE,
        "columns": ["alphaPercent (%)", "u (1)"],
        "units": "SI",
    }
