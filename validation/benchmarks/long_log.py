"""One log of many rows: the time of a pass over it, and the memory that a fit of it takes at most.

`python -m validation.benchmarks.long_log FILE.npy` fits the log in that file and prints what it took as JSON.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox import Effort, Parameter, Tried, fit, problem
from pysim.types import Dataset, MeasuredRecord, Model, Record
from validation.initial_states.mass import TRUTH, force, mass_model, measured, motion

Array = NDArray[np.float64]

RATE, NOISE, OFF, SEED = 1000.0, 1e-3, 1.2, 3  # Hz, m, factor of the start off the truth, of the noise
GIB = 2.0**30
_PIECE = 100_000  # rows for which the force is made at a time
_STATUS = Path("/proc/self/status")


@dataclass(frozen=True)
class Cost:
    """What a fit of one log took in a process of its own.

    Args:
        rows: of the log.
        passes: CPU seconds between the points of the search, (n_points - 1,).
        before, peak: bytes of resident memory, with everything imported and the log in it, and at most.
        error: largest difference from the truth over its value.
    """

    rows: int
    passes: tuple[float, ...]
    before: int
    peak: int
    error: float


def cost(rows: int) -> Cost:
    """Fit a log of so many rows in a process of its own, which finds the data in a file.

    Raises:
        RuntimeError: it ended before its time, for lack of memory perhaps.
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "log.npy"
        np.save(file, columns(rows))
        words = [sys.executable, "-m", "validation.benchmarks.long_log", str(file)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"a fit of {rows} rows ended with {done.returncode}: {done.stderr[-300:]}")
    data = json.loads(done.stdout)
    return Cost(rows, tuple(data["passes"]), data["before"], data["peak"], data["error"])


def columns(rows: int) -> Array:
    """Time, force and measured position (rows, 3) of one log at 1 kHz, begun at rest; white noise on the position."""
    time_s = np.arange(rows) / RATE
    pushed = np.concatenate([force(part, SEED) for part in np.array_split(time_s, rows // _PIECE + 1)])
    pushed *= np.minimum(time_s, 1.0)
    position = motion(time_s, pushed, (0.0, 0.0))[:, 0]
    return np.column_stack([time_s, pushed, position + NOISE * np.random.default_rng(SEED).standard_normal(rows)])


def dataset(table: Array) -> Dataset:
    """The log as a data set; `table` as `columns` makes it."""
    log = Record(table[:, 0], table[:, 1:], ("F", "x"), ("N", "m"), origin="virtual")
    return measured("long", (MeasuredRecord("long.txt", "stochastic", "fit", log),), {"x": NOISE})


def main(file: Path) -> None:
    """Print what the fit of the log in the file took."""
    model = mass_model()
    _fitted(model, dataset(columns(2000)), [])  # what is compiled or loaded once
    data = dataset(np.load(file, mmap_mode="r"))
    times: list[float] = []
    before = _peak()
    found = _fitted(model, data, times)
    peak = _peak()
    error = max(abs(found[name] / value - 1) for name, value in TRUTH.items())
    print(json.dumps({"passes": np.diff(times).tolist(), "before": before, "peak": peak, "error": error}))


def _peak() -> int:
    """Bytes of resident memory at most; by the system's own count, which a process inherits from the one it started in,
    only where there is no other.
    """
    from resource import RUSAGE_SELF, getrusage

    if not _STATUS.is_file():
        return getrusage(RUSAGE_SELF).ru_maxrss * 1024
    line = next(line for line in _STATUS.read_text().splitlines() if line.startswith("VmHWM:"))
    return int(line.split()[1]) * 1024


def _fitted(model: Model, data: Dataset, times: list[float]) -> Mapping[str, float]:
    free = [Parameter(name, start=OFF * value) for name, value in TRUTH.items()]

    def note(tried: Tried) -> None:
        times.append(time.process_time())

    return fit(problem(model, [data], free), effort=Effort(nominal=False), progress=note).values


if __name__ == "__main__":
    main(Path(sys.argv[1]))
