"""Measurements of the pump with known truth, made by simulation: stepped sines, stochastic waves, seeded noise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.harmonics import interpolation
from pysim.simulate import Esdirk, Periodic, Rodas, periodic_many, simulate_many
from pysim.types import Dataset, Experiment, MeasuredRecord, MeasuredSignal, Model, Record, Signal

Array = NDArray[np.float64]

RATE = 250.0  # Hz, thesis Section 3.1.3
NOISE = {"alphaPercent": 0.1, "u": 0.002}
_UNITS = {"alphaCMD": "%", "alphaPercent": "%", "u": "1"}
_POINTS = 99
_TIGHT = 1e-6

SIGNALS = (
    MeasuredSignal("alphaCMD", "input", "%", "command", "alphaCMD"),
    MeasuredSignal("alphaPercent", "output", "%", "angle", "alphaPercent", noise=NOISE["alphaPercent"]),
    MeasuredSignal("u", "output", "1", "spool position", "u", noise=NOISE["u"]),
)


def noise_free(
    model: Model,
    truth: Mapping[str, float],
    tests: Sequence[tuple[float, float]],
    frequencies: Sequence[float],
    waves: Sequence[tuple[int, float, str]],
) -> tuple[MeasuredRecord, ...]:
    """Logs without noise.

    Args:
        truth: parameter -> value in force.
        tests: offset and amplitude in percent, each at every frequency (Hz), logged once the swing is steady.
        waves: seed, length in s and use of each stochastic wave; angle and spool position are logged.
    """
    return (*_sines(model, truth, tests, frequencies), *_waves(model, truth, waves))


def measured(records: Sequence[MeasuredRecord], seed: int) -> Dataset:
    """The same logs with normal noise on every output, drawn from the seed."""
    rng = np.random.default_rng(seed)
    noisy = []
    for record in records:
        assert isinstance(record.data, Record)
        size = np.array([NOISE.get(name, 0.0) for name in record.data.names])
        values = record.data.values + size * rng.standard_normal(record.data.values.shape)
        data = Record(record.data.time, values, record.data.names, record.data.units, origin="virtual")
        noisy.append(replace(record, data=data))
    return Dataset(f"virtual-{seed}", "simulated with known parameters", "pump", SIGNALS, tuple(noisy))


def _log(time: Array, columns: Mapping[str, Array]) -> Record:
    names = tuple(columns)
    return Record(time, np.column_stack(list(columns.values())), names, tuple(_UNITS[name] for name in names))


def _sines(
    model: Model, truth: Mapping[str, float], tests: Sequence[tuple[float, float]], frequencies: Sequence[float]
) -> list[MeasuredRecord]:
    points = [(offset, amplitude, f) for offset, amplitude in tests for f in frequencies]
    orbits = []
    for offset, amplitude, f in points:
        swing = Signal(
            np.zeros(1), np.array([[offset, 0.0, 0.0, 0.0]]), np.array([[[amplitude, 0.0, 2 * np.pi * f, 0.0]]])
        )
        rates = {"alphaCMD_t": "alphaCMD"}
        orbits.append(Periodic(1 / f, _POINTS, ("alphaPercent",), {"alphaCMD": swing}, truth, rates))
    records = []
    steady = periodic_many(model, orbits, solver=Esdirk(rtol=_TIGHT, atol=_TIGHT), mismatch=1e-6)
    for (offset, amplitude, f), orbit in zip(points, steady, strict=True):
        length = max(2 / f, 1.2)
        time = np.arange(0.0, length, 1 / RATE)
        phase = 2 * np.pi * f * time
        angle = interpolation(phase, _POINTS) @ orbit.record.values[:, 0]
        data = _log(time, {"alphaCMD": offset + amplitude * np.sin(phase), "alphaPercent": angle})
        source = f"O{offset:+g}_A{amplitude:g}/{f:g}Hz.txt"
        records.append(MeasuredRecord(source, "frequency-response", "fit", data, offset, amplitude, f))
    return records


def _waves(model: Model, truth: Mapping[str, float], waves: Sequence[tuple[int, float, str]]) -> list[MeasuredRecord]:
    runs, commands = [], []
    for seed, length, _ in waves:
        time = np.arange(0.0, length, 1 / RATE)
        commands.append(_command(seed, time))
        inputs = {"alphaCMD": Signal.through(time, commands[-1])}
        runs.append(Experiment(time, ("alphaPercent", "u"), inputs, truth, rates={"alphaCMD_t": "alphaCMD"}))
    records = []
    done = simulate_many(model, runs, solver=Rodas(rtol=_TIGHT, atol=_TIGHT))
    for (seed, _, use), command, record in zip(waves, commands, done, strict=True):
        columns = {"alphaCMD": command, "alphaPercent": record["alphaPercent"], "u": record["u"]}
        records.append(MeasuredRecord(f"wave-{seed}.txt", "stochastic", use, _log(record.time, columns)))
    return records


def _command(seed: int, time: Array) -> Array:
    """Forty sines from 0.3 to 4 Hz of 25 percent together (as of thesis Section 2.1.3), grown from rest in a second."""
    rng = np.random.default_rng(seed)
    f = np.linspace(0.3, 4.0, 40) + rng.uniform(-0.04, 0.04, 40)
    size = np.exp(-(((f - 1.0) / 1.0) ** 2)) + 0.1
    size *= 25.0 * np.sqrt(2) / np.linalg.norm(size)
    swing = (size * np.sin(2 * np.pi * f * time[:, None] + rng.uniform(0, 2 * np.pi, 40))).sum(axis=1)
    grown = np.clip(time, 0.0, 1.0)
    return swing * grown**2 * (3 - 2 * grown)
