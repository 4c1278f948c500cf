"""The blind plant against an independent author's measurements of eight effects, and against the pump's FMU."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io import read_dataset
from pysim.simulate import Rodas, simulate_many
from pysim.thesis import pump_model
from pysim.types import Experiment, MeasuredRecord, Record, Signal
from validation.blind.plant.case import ANGLE_STEP, SPOOL_STEP
from validation.blind.plant.command import Command, Lead, chirp, stepped_sine
from validation.blind.plant.effects import STANDARD
from validation.blind.plant.equations import run as run_plant
from validation.blind.plant.programme import RATE, programme
from validation.blind.plant.quantities import STEP, Parameters, Strengths
from validation.findings import Finding

Array = NDArray[np.float64]

_PERCENT = math.radians(15.0) / 100
_SAMPLE = round(1 / RATE / STEP)
_WAVES = Path(__file__).parent / "measurements"
_BENCH_01 = Path(__file__).parents[1] / "measurements"
_NOISE = np.hypot([0.1, 0.002], np.array([ANGLE_STEP, SPOOL_STEP]) / math.sqrt(12))
_WAVE_START = 1.0  # s of rest ahead of a wave
_SHAFT = 1450 / 60  # Hz
_FINEST_NOISE = 0.02  # percent, the finest of the benchmark


def run() -> Iterator[Finding]:
    """Subtract the plant from independent measurements, then from the FMU."""
    yield from _whole_session()
    for name, told in read_truth().items():
        yield from _one_wave(name, told)
    yield from _limited_sines()
    yield from _against_the_fmu()


def read_truth() -> dict[str, Any]:
    """Effect, strength and parameters of each measured wave."""
    told: dict[str, Any] = json.loads((_WAVES / "truth.json").read_text(encoding="utf-8"))
    return told


def parameters_of(told: Mapping[str, float]) -> Parameters:
    """By the names of the thesis; the truth beside `bench-01` writes K_d for K_D."""
    return Parameters(**{{"K_d": "K_D"}.get(name, name): float(value) for name, value in told.items()})


def strengths_of(told: Mapping[str, Any]) -> Strengths:
    """From effect names and symbols of the standard list; one outside of it is the force of `bench-16`."""
    names = [told["effect"]] if isinstance(told["effect"], str) else told["effect"]
    if names == ["unknown"]:
        return Strengths(shaft__F=150.0, shaft__f=_SHAFT)
    parts = (part for name in names if name != "none" for part in STANDARD[name])
    return Strengths(**{part.field: float(told["strength"][part.symbol]) for part in parts})


@dataclass(frozen=True)
class Wave:
    """The measured wave of one set: knots of its command in percent, readings (n, 2) at every second of them."""

    level: Array
    slope: Array
    readings: Array

    def residuals(self, parameters: Parameters, strengths: Strengths) -> Array:
        """Readings minus plant, (n, 2), in units of noise."""
        ahead = np.zeros(round(_WAVE_START * RATE))
        level, slope = (np.concatenate([ahead, part]) * _PERCENT for part in (self.level, self.slope))
        logged = run_plant(
            level, slope, _SAMPLE, ahead.size * _SAMPLE, 2 * _SAMPLE, parameters=parameters, strengths=strengths
        )
        return np.asarray((self.readings - _readings(logged)) / _NOISE)


def read_wave(name: str) -> Wave:
    """Of the set with this name; counts of 12 bits in the file."""
    level = np.loadtxt(_WAVES / "command.txt", skiprows=1)
    counts = np.loadtxt(_WAVES / f"{name}.txt", skiprows=1)
    times = np.arange(level.size) / RATE
    slope = Signal.through(times, level).derivative(times)
    return Wave(level, slope, counts * (ANGLE_STEP, SPOOL_STEP))


def with_shaft_phase(wave: Wave, parameters: Parameters, strengths: Strengths) -> Strengths:
    """The same with the phase at which the shaft happened to be, which no log tells: least squares by Gauss-Newton."""
    grid = [strengths._replace(shaft__phase=phase) for phase in np.arange(8) * math.pi / 4]
    best = min(grid, key=lambda tried: float(np.sum(wave.residuals(parameters, tried) ** 2)))
    for _ in range(3):
        here = wave.residuals(parameters, best)
        slope = (wave.residuals(parameters, best._replace(shaft__phase=best.shaft__phase + 0.05)) - here) / 0.05
        best = best._replace(shaft__phase=best.shaft__phase - float(np.sum(slope * here) / np.sum(slope**2)))
    return best


def _readings(logged: Array) -> Array:
    return np.column_stack([logged[:, 0] / _PERCENT, logged[:, 1]])


def _excess(residuals: Array) -> float:
    """How far a mean square of unit noise is from 1, in its standard deviations."""
    return float((np.mean(residuals**2) - 1) * math.sqrt(residuals.size / 2))


def _one_wave(name: str, told: Mapping[str, Any]) -> Iterator[Finding]:
    wave, parameters, strengths = read_wave(name), parameters_of(told["parameters"]), strengths_of(told)
    if strengths.shaft__F:
        strengths = with_shaft_phase(wave, parameters, strengths)
    label = told["effect"] if isinstance(told["effect"], str) else " and ".join(told["effect"])
    residuals = wave.residuals(parameters, strengths)
    for column, signal in enumerate(("angle", "spool")):
        rest = residuals[:, column]
        yield Finding(f"{name}, {label}: {signal}, mean square off 1", abs(_excess(rest)), 4.0, "deviations")
        memory = abs(float(np.mean(rest[1:] * rest[:-1]))) * math.sqrt(rest.size)
        yield Finding(f"{name}, {label}: {signal}, one sample against the next", memory, 4.0, "deviations")
    if name in _LEFT:
        off = wave.residuals(parameters, Strengths())
        share = float(np.sum(residuals**2) / np.sum(off**2))
        yield Finding(f"{name}, {label}: what is left, over what is left with the effect off", share, _LEFT[name], "")


# Sum of squares with the effect over that without: that the wave could have contradicted the plant's reading of it.
# The spool of bench-08 never reaches its limit in the wave; its sines stand for it.
_LEFT = {
    "bench-02": 0.65, "bench-03": 0.03, "bench-04": 0.95, "bench-05": 0.6, "bench-06": 0.1,
    "bench-07": 0.75, "bench-15": 0.05, "bench-16": 0.5,
}  # fmt: skip


def _limited_sines() -> Iterator[Finding]:
    """Three sines of bench-08 that run into the limit of the spool's speed."""
    told = read_truth()["bench-08"]
    parameters, strengths = parameters_of(told["parameters"]), strengths_of(told)
    for offset, amplitude, frequency in ((25.0, 10.0, 20.0), (50.0, 20.0, 13.0), (75.0, 10.0, 20.0)):
        test = f"O{offset:+g}_A{amplitude:g}_{frequency:g}Hz"
        measured = np.loadtxt(_WAVES / f"bench-08_{test}.txt", skiprows=1) * ANGLE_STEP
        command = stepped_sine(Lead(offset), offset, amplitude, frequency, (measured.size - 1) / RATE)
        rest, off = (
            (measured - readings_of(command, parameters, limit)[: measured.size, 0]) / _NOISE[0]
            for limit in (strengths, Strengths())
        )
        yield Finding(f"bench-08, {test}: mean square off 1", abs(_excess(rest)), 4.0, "deviations")
        share = float(np.sum(rest**2) / np.sum(off**2))
        yield Finding(f"bench-08, {test}: what is left, over what is left without a limit", share, 0.01, "")


def readings_of(command: Command, parameters: Parameters, strengths: Strengths) -> Array:
    """Angle (percent) and spool (1) at the samples of a test, (n, 2)."""
    logged = run_plant(
        command.level * _PERCENT,
        command.slope * _PERCENT,
        command.every,
        round(command.start / STEP),
        _SAMPLE,
        parameters=parameters,
        strengths=strengths,
    )
    return _readings(logged)


def _whole_session() -> Iterator[Finding]:
    """All 68 logs of the set without an effect."""
    told = json.loads((_BENCH_01 / "bench-01.truth.json").read_text(encoding="utf-8"))
    parameters, pooled, worst = parameters_of(told["parameters"]), [], 0.0
    for record in read_dataset(_BENCH_01 / "bench-01").logs():
        if record.kind == "stochastic" or not isinstance(record.data, Record):
            continue
        command = _command_of(record)
        measured = record.data["alphaPercent"]
        rest = (measured - readings_of(command, parameters, Strengths())[: measured.size, 0]) / _NOISE[0]
        pooled.append(rest)
        worst = max(worst, abs(_excess(rest)))
    yield Finding("bench-01, 66 logs: mean square off 1", abs(_excess(np.concatenate(pooled))), 4.0, "deviations")
    yield Finding("bench-01, 66 logs: the worst of them", worst, 4.5, "deviations")


def _command_of(record: MeasuredRecord) -> Command:
    assert isinstance(record.data, Record)
    assert record.offset is not None
    assert record.amplitude is not None
    length = float(record.data.time[-1] - record.data.time[0])
    lead = Lead(record.offset)
    if record.frequency is None:
        return chirp(lead, record.offset, record.amplitude, 0.1, 30.0, length)
    return stepped_sine(lead, record.offset, record.amplitude, record.frequency, length)


def _against_the_fmu(seed: int = 1) -> Iterator[Finding]:
    """Thesis' parameters, no effect: what the FMU's dead time and end stops cost, test by test."""
    tests = [test for test in programme() if test.offset == 75.0 or test.frequency is None]
    commands = [test.command(seed) for test in tests]
    runs, theirs = [], []
    for test, command in zip(tests, commands, strict=True):
        n = math.floor(test.length * RATE + 1e-6) + 1
        times = command.start + np.arange(n) / RATE
        knots = np.arange(command.level.size) * command.every * STEP
        inputs = {"alphaCMD": Signal.through(knots, command.level, command.slope)}
        runs.append(Experiment(times, ("alphaPercent", "u"), inputs, rates={"alphaCMD_t": "alphaCMD"}))
        theirs.append(readings_of(command, Parameters(), Strengths())[:n])
    model = pump_model("free")
    ours = simulate_many(model, runs, solver=Rodas(rtol=1e-6, atol=1e-6))
    off = {test.file: mine.values - plant for test, mine, plant in zip(tests, ours, theirs, strict=True)}
    every = np.concatenate(list(off.values()))
    worst = max(off, key=lambda file: float(np.abs(off[file][:, 0]).max()))
    for column, signal, noise in ((0, "angle", _FINEST_NOISE), (1, "spool", _FINEST_NOISE * 0.02)):
        rms = float(np.sqrt(np.mean(every[:, column] ** 2))) / noise
        yield Finding(f"plant against FMU: rms of the {signal}, in units of the finest noise", rms, 0.05, "")
        largest = float(np.abs(off[worst][:, column]).max()) / noise
        yield Finding(f"plant against FMU: largest of the {signal}, in such units, in {worst}", largest, 1.0, "")
