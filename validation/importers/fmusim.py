"""fmusim, the program that ran with the Reference-FMUs until 2025: model exchange by Euler or CVODE, co-simulation."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.thesis import read_csv
from validation.importers.exported import Exported

Array = NDArray[np.float64]
PROGRAM = "fmusim"


def installed() -> bool:
    """Whether the program is on PATH."""
    return shutil.which(PROGRAM) is not None


def simulated(exported: Exported, fmi: int, *options: str, step: float) -> Array:
    """Outputs (n_t, n_outputs) at the communication points; `step` in s is its output interval, and Euler's step.

    Raises:
        RuntimeError: what the program said when it failed.
    """
    words = [PROGRAM, *options, "--stop-time", repr(exported.stop), "--output-interval", repr(step)]
    for name, value in exported.inputs.items():
        words += ["--start-value", name, repr(value)]
    for name in exported.outputs:
        words += ["--output-variable", name]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "out.csv"
        done = subprocess.run(
            [*words, "--output-file", str(file), str(exported.build(fmi))], capture_output=True, text=True, check=False
        )
        if done.returncode:
            raise RuntimeError(f"status {done.returncode}: {done.stdout} {done.stderr}")
        rows = read_csv(file)
    time, *values = (np.array([float(row[name]) for row in rows]) for name in ("time", *exported.outputs))
    return np.column_stack([np.interp(exported.times, time, one) for one in values])
