"""The same FMUs and wires under libcosim and under our master; and under libcosim from the package that we export."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.cosim import cosimulate
from pysim.cosim.ssp import write_ssp
from validation.findings import Finding
from validation.libcosim.bench import STARTS, STEP, STEPS, WIRES, coupled, models

Array = NDArray[np.float64]

LIMIT = 0.0  # both masters make the same calls at the same times
MISSING = "libcosimpy is not installed (pip install libcosimpy)"


def run() -> Iterator[Finding]:
    """Every output at every communication point."""
    file = coupled()
    record = cosimulate(file.system, file.experiment, step=STEP, order=file.order)
    known = record.values[1:]  # libcosim shows nothing ahead of the first step
    texts = {name: f"test bench of three FMUs: {name} against libcosim" for name in record.names}
    package = "test bench exported as .ssp and read by libcosim, worst output"
    if find_spec("libcosimpy") is None:
        yield from (Finding(text, float("nan"), LIMIT, "of its range", skipped=MISSING) for text in texts.values())
        yield Finding(package, float("nan"), LIMIT, "of its range", skipped=MISSING)
        return
    from validation.libcosim.peer import from_package, wired

    rows = wired(models(), STARTS, WIRES, STEP).rows(STEPS)
    for name, worst in zip(record.names, difference(rows, known), strict=True):
        yield Finding(texts[name], float(worst), LIMIT, "of its range")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bench.ssp"
        write_ssp(file, path)
        rows = from_package(path, models(), STEP).rows(STEPS)
    yield Finding(package, float(difference(rows, known).max()), LIMIT, "of its range")


def difference(found: Array, known: Array) -> Array:
    """Largest, per column, as a share of the column's range; of its size where it stands still."""
    spread = np.ptp(known, axis=0)
    return np.asarray(np.abs(found - known).max(axis=0) / np.where(spread > 0, spread, np.abs(known).max(axis=0)))
