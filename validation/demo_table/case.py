"""The demo's table within 0.05 dB and 0.3 degrees of the independent result, and explained against the thesis."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from pysim.identify import compare_responses
from pysim.io import read_dataset
from pysim.thesis import Difference, differences, pump_model, read_csv, write_dataset
from pysim.thesis.explanation import TOLERANCE_DB, TOLERANCE_DEG
from pysim.types import Comparison
from validation.findings import Finding

LIMITS = (0.05, 0.05, 0.3, 0.3)
# With the locked set, V_0 - A_p x_p of Eq. 3.5 reaches zero inside this test's stroke: the thesis' equations end there,
# our model has a floor, and the independent simulation leaves the test out.
UNDEFINED = {("locked", 75.0, 20.0)}
_NUMBERS = ("mean_db", "max_db", "mean_deg", "max_deg")
_UNITS = ("dB", "dB", "deg", "deg")
_FILE = Path(__file__).parents[1] / "reference" / "free_set_deviations.csv"


def run() -> Iterator[Finding]:
    """All 18 tests of both sets."""
    with tempfile.TemporaryDirectory() as folder:
        dataset = read_dataset(write_dataset(Path(folder)))
    free, locked = (compare_responses(pump_model(name), dataset, label=name) for name in ("free", "locked"))
    yield from _against_the_independent_result(free)
    yield from _locked_set_fails_on_the_mean_phase(locked)
    for comparison, table in ((free, "4.8"), (locked, "4.7")):
        yield from _explained(comparison, table)


def _against_the_independent_result(free: Comparison) -> Iterator[Finding]:
    """Nine rows, each for both signs of the offset."""
    rows = {(float(row["offset_percent"]), float(row["amplitude_percent"])): row for row in read_csv(_FILE)}
    for i, (name, unit, limit) in enumerate(zip(_NUMBERS, _UNITS, LIMITS, strict=True)):
        worst = max(
            abs(
                test.deviations[i].value
                - float(rows[abs(test.measured.test.offset), test.measured.test.amplitude][name])
            )
            for test in free.tests
        )
        yield Finding(f"free set, {name}: largest difference from the independent result, 18 tests", worst, limit, unit)


def _locked_set_fails_on_the_mean_phase(locked: Comparison) -> Iterator[Finding]:
    """As in Table 4.7; the independent result is 9 to 13 degrees."""
    means = [test.deviations[2].value for test in locked.tests if test.deviations]
    yield Finding("locked set: tests that pass", float(sum(test.passes for test in locked.tests)), 0, "")
    yield Finding("locked set: tests that did not run", float(len(locked.tests) - len(means)), 0, "")
    yield Finding(
        "locked set: smallest mean phase deviation is at least 9 deg, short by", max(0.0, 9 - min(means)), 0, "deg"
    )


def _explained(comparison: Comparison, table: str) -> Iterator[Finding]:
    """What Table 4.4 cannot explain of the difference from the thesis' own table."""
    rows = [row for row in differences(comparison, table) if (comparison.label, *_size(row)) not in UNDEFINED]
    for numbers, unit, limit in ((slice(0, 2), "dB", TOLERANCE_DB), (slice(2, 4), "deg", TOLERANCE_DEG)):
        worst = max(max(row.excess[numbers]) for row in rows)
        left_out = ", ".join(f"{offset:g}/{size:g}" for label, offset, size in UNDEFINED if label == comparison.label)
        title = f"{comparison.label} set: difference from thesis Table {table} beyond the misfit of Table 4.4"
        title += f"; without {left_out}, of either sign, where the thesis' equations end" * bool(left_out)
        yield Finding(title, worst, limit, unit)


def _size(row: Difference) -> tuple[float, float]:
    """Offset without its sign, and amplitude."""
    return abs(row.offset), row.amplitude
