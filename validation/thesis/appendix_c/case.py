"""Bode plots of the black box, the free and the locked model at every offset and amplitude (Figures 5 to 10)."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

from matplotlib.figure import Figure

from pysim.identify import compare_responses
from pysim.io import read_dataset
from pysim.present.comparison import bode_figure, deviation_figure
from pysim.thesis import NOTE, differences, published_deviations, pump_model, write_dataset
from pysim.types import Comparison
from validation.findings import Finding

OFFSETS = {25.0: 5, 50.0: 6, 75.0: 7, -25.0: 8, -50.0: 9, -75.0: 10}  # offset -> figure


def notes() -> Sequence[str]:
    """What stands in, and the means of Table 1.3 over all tests."""
    black = published_deviations("4.4")
    means = [sum(row.values[k] for row in black) / len(black) for k in (0, 2)]
    told = f"Black box, as printed in Table 4.4: {sum(row.passes for row in black)} of 18 pass; means {_words(means)}."
    models = [_model_words(_compared(name)) for name in ("free", "locked")]
    same = "The black box of Table 4.1 is the reference itself here: black dots and red line are one."
    return (NOTE, same, told, *models)


def _model_words(comparison: Comparison) -> str:
    done = [test for test in comparison.tests if test.deviations]
    means = [sum(test.deviations[k].value for test in done) / len(done) for k in (0, 2)]
    passing = sum(test.passes for test in comparison.tests)
    return f"{comparison.label} model: {passing} of {len(comparison.tests)} pass; means {_words(means)}."


def _words(means: Sequence[float]) -> str:
    return f"{means[0]:.2f} dB and {means[1]:.1f} deg"


def run() -> Iterator[Finding]:
    """What the figures are to show: the free model closer than the locked one, everywhere."""
    free, locked = (_compared(name) for name in ("free", "locked"))
    worse = [
        f.measured.test.offset
        for f, k in zip(free.tests, locked.tests, strict=True)
        if f.deviations and k.deviations and f.deviations[2].value >= k.deviations[2].value
    ]
    yield Finding("tests in which the free model's mean phase is not closer than the locked one's", len(worse), 0, "")
    for model, table in ((free, "4.8"), (locked, "4.7")):
        other = [row for row in differences(model, table) if row.passes != row.printed_passes]
        yield Finding(
            f"{model.label} model: {len(other)} of 18 verdicts differ from Table {table}; in numbers that the misfit "
            "of Table 4.4 does not explain",
            float(sum(not row.explained for row in other)),
            0,
            "",
            alternative="the model, its parameters or the frequencies are not the thesis'",
            source="Table 4.8 judges by measured points, this by Table 4.1's fits to them; see demo-table",
        )


@cache
def _compared(name: str) -> Comparison:
    with tempfile.TemporaryDirectory() as folder:
        return compare_responses(pump_model(name), read_dataset(write_dataset(Path(folder))), label=name)


def pictures() -> Mapping[str, Figure]:
    """A figure per offset."""
    both = [_compared("free"), _compared("locked")]
    drawn = {"Accuracy under Table 1.3: deviation of every test, criterion by criterion.": deviation_figure(both)}
    for offset, number in OFFSETS.items():
        drawn[f"Figure {number} of Appendix C redone: offset {offset:+g} %."] = bode_figure(both, offset)
    return drawn
