"""The virtual bench with an independent plant's parameters leaves of that plant's measurements nothing but noise."""

from __future__ import annotations

import json
import math
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.bench import BenchData, Plan, read_plan, run_plan, write_commands
from pysim.identify.data_check import check_dataset
from pysim.io import read_dataset, write_dataset
from pysim.thesis import pump_model
from pysim.types import Dataset, MeasuredSignal, Record
from validation.findings import Finding

MEASUREMENTS = Path(__file__).parents[1] / "measurements"
SEED = 1
_PLAYED_HZ, _NEAR = 1000.0, 1e-3
_COMMAND, _ANGLE = "alphaCMD", "alphaPercent"
_RENAMED = {"K_d": "K_D"}


def run() -> Iterator[Finding]:
    """Read, simulate, subtract."""
    start = time.process_time()
    measured = read_dataset(MEASUREMENTS / "bench-01")
    yield Finding("bench-01: processor time to read its 68 logs", time.process_time() - start, 1.0, "s")
    yield Finding("bench-01: warnings of the data check", len(check_dataset(measured).findings), 0, "")
    plan = read_plan("bench-01")
    data = run_plan(pump_model("free"), plan, SEED, parameters=true_parameters())
    yield from _against_the_independent_plant(measured, data.truth.clean)
    yield from _own_noise(data)
    yield _round_trip(plan, data)
    yield _played(plan, measured)


def true_parameters() -> dict[str, float]:
    """Of bench-01, in the model's names and SI units."""
    told = json.loads((MEASUREMENTS / "bench-01.truth.json").read_text(encoding="utf-8"))["parameters"]
    return {_RENAMED.get(name, name): float(value) for name, value in told.items()}


def noise_of(signal: MeasuredSignal) -> float:
    """Standard deviation of noise and quantisation, in the signal's unit."""
    return math.hypot(signal.noise or 0.0, (signal.resolution or 0.0) / math.sqrt(12))


def _logs(dataset: Dataset) -> dict[str, Record]:
    """Stepped sines and chirps by their files."""
    kinds = ("frequency-response", "chirp")
    return {r.source: r.data for r in dataset.records if r.kind in kinds and isinstance(r.data, Record)}


def _against_the_independent_plant(measured: Dataset, clean: Dataset) -> Iterator[Finding]:
    theirs, ours = _logs(measured), _logs(clean)
    commands = [np.abs(log[_COMMAND] - ours[name][_COMMAND]).max() for name, log in theirs.items()]
    yield Finding(f"commands of {len(theirs)} logs: largest difference", float(max(commands)), 6e-6, "%")
    differences = [log[_ANGLE] - ours[name][_ANGLE] for name, log in theirs.items()]
    noise = noise_of(measured.signal(_ANGLE))
    pooled = _rms(np.concatenate(differences)) / noise
    yield Finding("angle against the independent plant, pooled, in units of its noise", pooled, 1.05, "")
    worst = max(_rms(difference) for difference in differences) / noise
    yield Finding("angle against the independent plant, worst log, in units of its noise", worst, 1.15, "")


def _own_noise(data: BenchData) -> Iterator[Finding]:
    for name in (_ANGLE, "u"):
        pairs = [
            (noisy.data[name], clean.data[name])
            for noisy, clean in zip(data.dataset.logs(), data.truth.clean.logs(), strict=True)
            if isinstance(noisy.data, Record) and isinstance(clean.data, Record) and name in noisy.data.names
        ]
        error = np.concatenate([noisy - clean for noisy, clean in pairs])
        ratio = _rms(error) / noise_of(data.dataset.signal(name))
        yield Finding(f"{name} of the virtual bench: noise against its plan", abs(ratio - 1), 0.01, "")


def _round_trip(plan: Plan, data: BenchData) -> Finding:
    """Largest difference after writing and reading, in halves of the last printed digit."""
    digits = {_COMMAND: 5, _ANGLE: 4, "u": 6}
    with tempfile.TemporaryDirectory() as folder:
        units = {name: unit for name, (unit, _) in plan.units.items()}
        back = read_dataset(write_dataset(Path(folder) / "set", data.dataset, units=units))
    worst = max(
        float(np.abs(new.data[name] - old.data[name]).max()) / (0.5 * 10 ** -digits[name])
        for new, old in zip(back.logs(), data.dataset.logs(), strict=True)
        if isinstance(new.data, Record) and isinstance(old.data, Record)
        for name in new.data.names
    )
    return Finding(
        "written and read again: largest difference in halves of the last digit", worst, 1 + 1e-6, "", regression=True
    )


def _played(plan: Plan, measured: Dataset) -> Finding:
    """Files for LabVIEW against what the independent author's bench logged as its command."""
    logs = {record.source: record.data for record in measured.records}
    worst, compared = 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        write_commands(plan, Path(folder) / "bench", form="csv", sampling_hz=_PLAYED_HZ)
        for run in plan.runs():
            log = logs.get(run.source)
            if run.kind == "stochastic" or not isinstance(log, Record):
                continue  # its phases are another draw
            path = (Path(folder) / "bench" / "commands" / run.source).with_suffix(".csv")
            value = np.loadtxt(path, delimiter=",", skiprows=1)[:, 1]
            rows = np.rint(log.time * _PLAYED_HZ).astype(int)
            near = np.abs(log.time * _PLAYED_HZ - rows) < _NEAR  # a sample of the file, to the printed digits of time
            worst = max(worst, float(np.abs(value[rows[near]] - log[_COMMAND][near]).max()))
            compared += int(near.sum())
    return Finding(
        f"bench-01 as files for LabVIEW, {compared} samples against commands that an independent bench logged: off by",
        worst,
        1e-4,
        "%",
        alternative="offset, amplitude, frequency or start of a file are another test's: off by a percent and more",
        source="printed digits, and a time stamp that is off by 0.01 of a sample at 30 Hz",
    )


def _rms(values: NDArray[np.float64]) -> float:
    return float(np.sqrt(np.mean(values**2)))
