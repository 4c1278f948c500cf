"""Five stable poles for each working point of a known plant, row by row beside Table 4.4."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from pysim.identify import FREQUENCY_CRITERIA, frequency_deviations
from pysim.identify.blackbox import THESIS_STRUCTURE, fit_transfer_function
from pysim.present.style import COLOURS, LIMIT, MARKERS, SMALL, TEXT, legend_above, new_figure, quiet
from pysim.thesis.published import PublishedDeviations, published_deviations
from validation.findings import Finding
from validation.pump_frequency.case import reference_responses

_TABLES = ("4.4", "4.7", "4.8")
_SHARE = 1 / 3  # of a limit, by which a row's mean magnitude may be off: the plant is the thesis' model, not its pump


@dataclass(frozen=True)
class Row:
    """A working point: mean and largest deviation in dB, then in degrees, here and as printed."""

    offset: float
    amplitude: float
    found: tuple[float, ...]
    printed: tuple[float, ...]

    @property
    def label(self) -> str:
        """As in the table's first two columns."""
        return f"{self.offset:g} / {self.amplitude:g}"


@cache
def rows() -> tuple[Row, ...]:
    """The nine with positive offset; the printed ones with negative offset are the same."""
    printed = {(row.offset, row.amplitude): row.values for row in published_deviations("4.4")}
    done = []
    for response in reference_responses("free"):
        fit = fit_transfer_function(response, replace(THESIS_STRUCTURE, stable=True))
        found = frequency_deviations(fit.function.response(response.frequency, response.test), response)
        test = response.test
        values = tuple(deviation.value for deviation in found)
        done.append(Row(test.offset, test.amplitude, values, printed[test.offset, test.amplitude]))
    return tuple(done)


def notes() -> Sequence[str]:
    """What stood in, and the table."""
    told = (
        "The measured points were never published. An independent simulation of the free set (Table 4.6) stands in for "
        "the pump; the transfer functions are fitted to it anew.",
        "offset / amplitude (%): mean and largest dB, mean and largest degrees; printed in brackets",
    )
    return (*told, *(f"{row.label}: {', '.join(map(_pair, row.found, row.printed))}" for row in rows()))


def _pair(found: float, printed: float) -> str:
    return f"{found:.2f} ({printed:g})"


def run() -> Iterator[Finding]:
    """The printed verdicts, then what five poles leave of a known plant."""
    wrong = [f"{t}: {row.offset:g}/{row.amplitude:g}" for t in _TABLES for row in published_deviations(t) if _odd(row)]
    claim = f"Tables 4.4, 4.7, 4.8: verdicts that do not follow from the printed numbers{': ' if wrong else ''}"
    yield Finding(claim + ", ".join(wrong), float(len(wrong)), 0, "of 54")
    found = np.array([row.found for row in rows()])
    printed = np.array([row.printed for row in rows()])
    beyond = np.any(found > [criterion.limit for criterion in FREQUENCY_CRITERIA], axis=1)
    yield Finding("rows beyond Table 1.3 (printed: 1)", float(beyond.sum()), 0, f"of {len(rows())}")
    off = np.abs(found[:, 0] - printed[:, 0])
    small = np.array([row.amplitude for row in rows()]) < 20.0
    claim = f"mean magnitude deviation, off the printed one (at 5 and 10 % at most {off[small].max():.3f} dB)"
    yield Finding(claim, float(off.max()), _SHARE * FREQUENCY_CRITERIA[0].limit, "dB")
    for k in (2, 3):
        worst = float((found[:, k] / printed[:, k]).max())
        claim = f"{FREQUENCY_CRITERIA[k].name}: five poles alone leave at most this share of the printed one"
        yield Finding(claim, worst, 1.0, "")


def _odd(row: PublishedDeviations) -> bool:
    return row.passes != all(v <= c.limit for v, c in zip(row.values, FREQUENCY_CRITERIA, strict=True))


def pictures() -> Mapping[str, Figure]:
    """The table as a figure: filled is redone, hollow printed."""
    figure = new_figure(9.0, 3.4)
    axes = figure.subplots(1, len(FREQUENCY_CRITERIA), sharey=True)
    places = np.arange(len(rows()))
    handles = []
    for k, (panel, criterion) in enumerate(zip(axes, FREQUENCY_CRITERIA, strict=True)):
        quiet(panel)
        for side, face, shift in ((0, COLOURS[0], -0.12), (1, "white", 0.12)):
            values = [(row.found, row.printed)[side][k] for row in rows()]
            look: dict[str, Any] = {"color": COLOURS[side], "marker": MARKERS[side], "markersize": 5.0}
            look["linestyle"] = "none"
            (handle,) = panel.plot(values, places + shift, markerfacecolor=face, **look)
            handles += [handle] if k == 0 else []
        right = 1.1 * max(criterion.limit, *(value for row in rows() for value in (row.found[k], row.printed[k])))
        panel.axvspan(criterion.limit, right, color=LIMIT, alpha=0.14, linewidth=0)
        panel.axvline(criterion.limit, color=LIMIT, linewidth=1.0)
        panel.set_xlim(0.0, right)
        panel.set_title(criterion.name, fontsize=SMALL)
        panel.set_xlabel(criterion.unit, fontsize=TEXT)
    axes[0].set_yticks(places, [row.label for row in rows()])
    axes[0].invert_yaxis()
    axes[0].set_ylabel("Offset / amplitude (%)", fontsize=TEXT)
    legend_above(figure, handles, ["five poles of the free set's simulation", "printed"])
    return {"Table 4.4 redone, with a simulation in place of the measurements.": figure}
