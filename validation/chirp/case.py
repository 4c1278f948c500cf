"""Tops, bottoms and mean of one chirp against stepped sines on a model with an asymmetric spring."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.excitation import Chirp, Excitation, SteppedSineCommand
from pysim.identify import magnitude_db, measured_responses
from pysim.identify.chirp import ChirpAnalysis, analyse_chirp
from pysim.io import read_model
from pysim.simulate import Rk45, simulate_many
from pysim.types import Dataset, Experiment, FrequencyResponse, MeasuredRecord, MeasuredSignal, Model, Record
from validation.findings import Finding

Array = NDArray[np.float64]

OFFSET, AMPLITUDE, ASYMMETRY = 50.0, 10.0, 0.1
FREQUENCIES = (0.5, 0.8, 1.2, 2.0, 3.0, 4.5, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0, 17.0, 20.0)
CHIRP = Chirp(OFFSET, AMPLITUDE, 0.1, 21.0, 261.25)
SAMPLING = 250.0  # Hz
NOISE, STEP = 0.1, 0.0586
_MOST_DB, _MOST_DEG, _RATIO_DB = 0.3, 4.0, 0.05


def run() -> Iterator[Finding]:
    """Mean, envelope and ratio without noise; the mean with it."""
    model = read_model(fmu_build.build("AsymmetricSpring", libraries=[Path(__file__).parent / "AsymmetricSpring.mo"]))
    sines = [SteppedSineCommand(OFFSET, AMPLITUDE, f, periods=max(4.0, 3 * f)) for f in FREQUENCIES]
    chirp, *logs = _logs(model, [CHIRP, *sines])
    reference = _stepped(logs)
    clean = analyse_chirp(chirp, "u", "y")
    yield from _against(reference, clean, "chirp")
    yield from _envelope(reference, clean)
    noisy = analyse_chirp(_disturbed(chirp, seed=1), "u", "y")
    yield from _against(reference, noisy, "chirp with noise and steps")


def _logs(model: Model, tests: list[Excitation]) -> list[MeasuredRecord]:
    """Each test run through the model and sampled from its onset to its end."""
    experiments = []
    for test in tests:
        times = test.onset + np.arange(int((test.end - test.onset) * SAMPLING + 1e-6) + 1) / SAMPLING
        experiments.append(Experiment(times, ("y",), {"u": test.signal()}))
    records = simulate_many(model, experiments, solver=Rk45(rtol=1e-8, atol=1e-8))
    made = []
    for test, record in zip(tests, records, strict=True):
        command = test.signal().value(record.time)
        data = Record(record.time, np.column_stack([command, record["y"]]), ("u", "y"), ("%", "%"), origin="simulated")
        f = test.frequency if isinstance(test, SteppedSineCommand) else None
        kind = "chirp" if f is None else "frequency-response"
        made.append(MeasuredRecord(f"{kind} {f or ''}", kind, "fit", data, OFFSET, AMPLITUDE, f))
    return made


def _stepped(logs: list[MeasuredRecord]) -> FrequencyResponse:
    signals = (MeasuredSignal("u", "input", "%", "command", "u"), MeasuredSignal("y", "output", "%", "position", "y"))
    (only,) = measured_responses(Dataset("asymmetric spring", "", "", signals, tuple(logs)))
    return only.response


def _disturbed(record: MeasuredRecord, seed: int) -> MeasuredRecord:
    assert isinstance(record.data, Record)
    values = np.array(record.data.values)
    values[:, 1] += NOISE * np.random.default_rng(seed).standard_normal(values.shape[0])
    values[:, 1] = np.round(values[:, 1] / STEP) * STEP
    data = Record(record.data.time, values, record.data.names, record.data.units, origin="simulated")
    return MeasuredRecord(record.source, record.kind, record.use, data, OFFSET, AMPLITUDE)


def _against(reference: FrequencyResponse, chirp: ChirpAnalysis, title: str) -> Iterator[Finding]:
    magnitude, phase = chirp.mean.at(reference.frequency)
    decibel = np.max(np.abs(magnitude - magnitude_db(reference, None)))
    degrees = np.max(np.abs(phase - np.degrees(reference.phase)))
    span = f"{reference.frequency[0]:g} to {reference.frequency[-1]:g} Hz"
    yield Finding(f"{title}: mean against stepped sines, {span}, magnitude", float(decibel), _MOST_DB, "dB")
    yield Finding(f"{title}: mean against stepped sines, {span}, phase", float(degrees), _MOST_DEG, "deg")


def _envelope(reference: FrequencyResponse, chirp: ChirpAnalysis) -> Iterator[Finding]:
    top, _ = chirp.top.at(reference.frequency)
    bottom, _ = chirp.bottom.at(reference.frequency)
    stepped = magnitude_db(reference, None)
    outside = np.maximum(np.minimum(top, bottom) - stepped, stepped - np.maximum(top, bottom))
    yield Finding("chirp: stepped sines outside tops and bottoms", float(np.max(outside)), 0.0, "dB")
    expected = 20 * np.log10((1 - ASYMMETRY) / (1 + ASYMMETRY))
    off = abs(float(top[0] - bottom[0]) - expected)
    yield Finding(f"chirp: tops by bottoms at {reference.frequency[0]:g} Hz against the spring's", off, _RATIO_DB, "dB")
