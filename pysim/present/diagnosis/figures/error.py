"""What a diagnosis answers, in two figures: the error falling step by step, and what each candidate explains."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.present import style
from pysim.present.criteria import CRITERIA
from pysim.present.diagnosis.levels import levels
from pysim.present.diagnosis.words import candidates_shown, errors, size_text, step_name
from pysim.present.notes import USES
from pysim.types import BadInput, Criterion, Diagnosis, ErrorStep, Rival

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PASS, _FAIL = "#14663a", "#b3261e"
_ROWS = 14  # candidates shown


def error_figure(steps: Sequence[ErrorStep]) -> Figure:
    """The residual over noise, step by step, of each use of logs; below, each criterion of Tables 1.3 and 1.4.

    Args:
        steps: of the error history, in order.
    Raises:
        BadInput: no step.
    """
    if not steps:
        raise BadInput("error figure: needs at least one step")
    symbols = [s for s in CRITERIA if any(s in step.criteria for step in steps)]
    width, height, ratios = max(6.6, 2.6 + 1.3 * len(steps)), 3.3 + 0.24 * len(symbols), [3.0]
    ratios += [0.3 + 0.27 * len(symbols)] if symbols else []
    figure, axes = style.panels(width, height, len(ratios), sharex=True, height_ratios=ratios)
    top = axes[0, 0]
    if symbols:
        _criteria(axes[1, 0], steps, symbols)
    _levels(figure, top, steps)
    top.set_xlim(-0.5, len(steps) - 0.5)
    top.set_xticks(range(len(steps)), [step_name(step.step) for step in steps], fontsize=style.TEXT)
    top.tick_params(labelbottom=True, bottom=False)
    return figure


def _levels(figure: Figure, axes: Axes, steps: Sequence[ErrorStep]) -> None:
    axes.grid(False, axis="x")
    axes.set_yscale("log")
    found = levels(steps)
    axes.set_ylim(found.low, found.high)
    style.plain_numbers(axes.yaxis, found.ticks)
    axes.axhspan(found.low, 1.0, color=style.BAND, alpha=0.6, linewidth=0)
    axes.axhline(1.0, color=style.LIMIT, linewidth=1.0)
    handles, names = [], []
    for k, name in enumerate(USES.values()):
        values = found.lines.get(name)
        if values is None:
            continue
        height = np.array([math.nan if v is None else v for v in values])
        edges = np.arange(-0.5, len(steps))
        handles.append(axes.stairs(height, edges, baseline=None, **style.look(k, "linestyle"), linewidth=2.0))
        axes.plot(np.arange(height.size), height, **style.look(k, "marker"), linestyle="none", markersize=5)
        names.append(name)
    for i, step in enumerate(steps):
        _numbers(axes, i, step)
    axes.set_ylabel("Residual over noise (-)")
    where = ("axes fraction", "data")
    style.small_text(axes, "noise alone", (0, 1.0), (4, -4), xycoords=where, va="top", color="#5c5c5c")
    style.legend_above(figure, handles, names)


def _numbers(axes: Axes, i: int, step: ErrorStep) -> None:
    """The largest one's value above its line, the smallest one's below, one between them beside, so that none meet."""
    known = errors(step)
    values = [(known[words], style.COLOURS[k]) for k, words in enumerate(USES.values()) if words in known]
    places = [
        ((0, 6), "center", "bottom"),
        *[((8, 0), "left", "center")] * (len(values) - 2),
        ((0, -6), "center", "top"),
    ]
    for (value, colour), (away, ha, va) in zip(sorted(values, reverse=True), places, strict=False):
        style.small_text(axes, size_text(value), (i, value), away, ha=ha, va=va, color=colour)


def _criteria(axes: Axes, steps: Sequence[ErrorStep], symbols: Sequence[str]) -> None:
    """A row per criterion, a column per step: its worst value, met or not."""
    axes.grid(False)
    for row, symbol in enumerate(symbols):
        for i, step in enumerate(steps):
            value, limit = step.criteria.get(symbol), CRITERIA[symbol].limit
            if value is None:
                continue
            met = value <= limit
            text = f"{value:.3g}  {'✓' if met else '✗'}"
            axes.text(
                i, row, text, ha="center", va="center", fontsize=style.SMALL, color=_PASS if met else _FAIL,
                fontweight="normal" if met else "bold",
            )  # fmt: skip
    axes.set_ylim(len(symbols) - 0.4, -0.6)
    axes.set_yticks(range(len(symbols)), [_limit(CRITERIA[s]) for s in symbols], fontsize=style.SMALL)
    axes.spines[:].set_visible(False)
    axes.tick_params(length=0, labelbottom=False)
    for row in range(len(symbols) + 1):
        axes.axhline(row - 0.5, color="#e6e6e6", linewidth=0.6)


def _limit(criterion: Criterion) -> str:
    words = criterion.name.removesuffix(" deviation")
    return f"{words} ≤ {criterion.limit:g} {criterion.unit}"


def candidates_figure(diagnosis: Diagnosis) -> Figure:
    """Share of the misfit that each candidate explains, the best on top: full bars were refitted, hollow ones screened.

    What was added, and what these data cannot tell from it, have colours of their own.

    Raises:
        BadInput: no candidate.
    """
    rows = candidates_shown(diagnosis)[:_ROWS]
    if not rows:
        raise BadInput("candidates figure: needs at least one candidate")
    added, tied = {one.effect.name for one in diagnosis.effects}, {name for group in diagnosis.ties for name in group}
    figure, ((axes,),) = style.panels(7.4, 0.9 + 0.27 * len(rows))
    axes.grid(False, axis="y")
    for i, row in enumerate(rows):
        last = row.effects[-1]
        _bar(
            axes, i, row, style.COLOURS[4] if last in tied else style.COLOURS[0] if last in added else style.COLOURS[5]
        )
    axes.set_xlim(0, 120)
    axes.set_xticks(range(0, 101, 20))
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks(range(len(rows)), [" + ".join(row.effects) for row in rows], fontsize=style.SMALL)
    axes.set_xlabel("Explains of the misfit of the model it joins (%)")
    from matplotlib.patches import Patch

    kinds = {"added": Patch(facecolor=style.COLOURS[0])} if added - tied else {}
    kinds |= {"indistinguishable": Patch(facecolor=style.COLOURS[4])} if tied else {}
    kinds |= {"refitted": Patch(facecolor=style.COLOURS[5])}
    kinds |= {"screened only": Patch(facecolor="white", edgecolor=style.COLOURS[5], hatch="////")}
    style.legend_above(figure, list(kinds.values()), list(kinds))
    return figure


def _bar(axes: Axes, i: int, row: Rival, colour: str) -> None:
    hollow = {"facecolor": "white", "edgecolor": colour, "hatch": "////"}
    look: dict[str, Any] = {"facecolor": colour} if row.refitted else hollow
    share = 100 * row.explained
    axes.barh(i, share, height=0.62, linewidth=0.8, **look)
    text = f"{share:.1f} %" if row.score > 0 else f"{share:.1f} %, no better for its parameters"
    style.small_text(axes, text, (share, i), (4, 0), va="center", color="#333333")
