"""What a diagnosis answers, in two figures: the error falling step by step, and the candidates in their order."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify.accuracy import FREQUENCY_CRITERIA, TIME_CRITERIA
from pysim.present.style import (
    BAND,
    COLOURS,
    DASHES,
    LIMIT,
    MARKERS,
    MEASURED,
    SMALL,
    TEXT,
    legend_above,
    new_figure,
    quiet,
)
from pysim.types import BadInput, Candidate, Criterion, Diagnosis, LedgerStep

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_CRITERIA = {c.symbol: c for c in (*FREQUENCY_CRITERIA, *TIME_CRITERIA)}
_TICKS = tuple(digit * 10.0**power for power in range(-2, 7) for digit in (1, 2, 5))
_PASS, _FAIL = "#14663a", "#b3261e"
_ROWS, _FEW = 14, 3  # candidates shown, and of a later round at least


def step_name(step: str) -> str:
    """A step of the ledger as people call it."""
    return {"prior": "as it is", "refit": "refitted"}.get(step, f"+ {step}")


def diagnosis_ledger_figure(steps: Sequence[LedgerStep]) -> Figure:
    """The error over noise as a falling staircase, fitted and held out; below, each criterion of Tables 1.3 and 1.4.

    Args:
        steps: of one story, in order.
    Raises:
        BadInput: no step.
    """
    if not steps:
        raise BadInput("ledger figure: needs at least one step")
    symbols = [s for s in _CRITERIA if any(s in step.criteria for step in steps)]
    figure = new_figure(max(6.6, 2.6 + 1.3 * len(steps)), 3.3 + 0.24 * len(symbols))
    if symbols:
        top, low = figure.subplots(2, 1, sharex=True, height_ratios=(3.0, 0.3 + 0.27 * len(symbols)))
        _criteria(low, steps, symbols)
    else:
        top = figure.subplots()
    _staircase(figure, top, steps)
    top.set_xlim(-0.5, len(steps) - 0.5)
    top.set_xticks(range(len(steps)), [step_name(step.step) for step in steps], fontsize=TEXT)
    top.tick_params(labelbottom=True, bottom=False)
    return figure


def _staircase(figure: Figure, axes: Axes, steps: Sequence[LedgerStep]) -> None:
    quiet(axes)
    axes.grid(False, axis="x")
    axes.set_yscale("log")
    lines = {"fitted": [s.fit for s in steps], "held out": [s.validate for s in steps]}
    known = [v for values in lines.values() for v in values if v is not None]
    low, high = min([0.72, *(0.72 * v for v in known)]), max([1.6, *(1.7 * v for v in known)])
    axes.set_ylim(low, high)
    from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

    axes.yaxis.set_major_locator(FixedLocator([t for t in _TICKS if low <= t <= high]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.axhspan(low, 1.0, color=BAND, alpha=0.6, linewidth=0)
    axes.axhline(1.0, color=LIMIT, linewidth=1.0)
    handles, names = [], []
    for k, (name, values) in enumerate(lines.items()):
        if all(v is None for v in values):
            continue
        height = np.array([math.nan if v is None else v for v in values])
        edges = np.arange(-0.5, len(steps))
        drawn = axes.stairs(height, edges, baseline=None, color=COLOURS[k], linewidth=2.0, linestyle=DASHES[k])
        axes.plot(np.arange(height.size), height, color=COLOURS[k], marker=MARKERS[k], linestyle="none", markersize=5)
        handles.append(drawn)
        names.append(name)
    for i, step in enumerate(steps):
        _numbers(axes, i, step)
    axes.set_ylabel("Residual over noise (-)", fontsize=TEXT)
    axes.annotate(
        "noise alone",
        (0, 1.0),
        xycoords=("axes fraction", "data"),
        xytext=(4, -4),
        textcoords="offset points",
        va="top",
        fontsize=SMALL,
        color="#5c5c5c",
    )
    legend_above(figure, handles, names)


def _numbers(axes: Axes, i: int, step: LedgerStep) -> None:
    """The larger one's value above its line, the smaller one's below, so that they never meet."""
    values = [(v, COLOURS[k]) for k, v in enumerate((step.fit, step.validate)) if v is not None]
    for rank, (value, colour) in enumerate(sorted(values, reverse=True)):
        above = rank == 0
        axes.annotate(
            f"{value:.3g}" if value >= 10 else f"{value:.2f}", (i, value), xytext=(0, 6 if above else -6),
            textcoords="offset points", ha="center", va="bottom" if above else "top", fontsize=SMALL, color=colour,
        )  # fmt: skip


def _criteria(axes: Axes, steps: Sequence[LedgerStep], symbols: Sequence[str]) -> None:
    """A row per criterion, a column per step: its worst value, met or not."""
    for row, symbol in enumerate(symbols):
        for i, step in enumerate(steps):
            value, limit = step.criteria.get(symbol), _CRITERIA[symbol].limit
            if value is None:
                continue
            met = value <= limit
            text = f"{value:.3g}  {'✓' if met else '✗'}"
            axes.text(
                i, row, text, ha="center", va="center", fontsize=SMALL, color=_PASS if met else _FAIL,
                fontweight="normal" if met else "bold",
            )  # fmt: skip
    axes.set_ylim(len(symbols) - 0.4, -0.6)
    axes.set_yticks(range(len(symbols)), [_limit(_CRITERIA[s]) for s in symbols], fontsize=SMALL)
    axes.spines[:].set_visible(False)
    axes.tick_params(length=0, labelbottom=False)
    for row in range(len(symbols) + 1):
        axes.axhline(row - 0.5, color="#e6e6e6", linewidth=0.6)


def _limit(criterion: Criterion) -> str:
    words = criterion.name.removesuffix(" deviation")
    return f"{words} ≤ {criterion.limit:g} {criterion.unit}"


def diagnosis_ranking_figure(diagnosis: Diagnosis) -> Figure:
    """Gain less penalty of each candidate, the best on top: full bars were refitted, hollow ones only screened.

    A panel per round of the search. Candidates that the data do not tell apart share a colour and a bracket.

    Raises:
        BadInput: no candidate.
    """
    numbers = sorted({row.round for row in diagnosis.ranking})
    rounds = [_shown([row for row in diagnosis.ranking if row.round == number], number) for number in numbers]
    if not rounds:
        raise BadInput("ranking figure: needs at least one candidate")
    figure = new_figure(7.4, 0.7 + sum(0.55 + 0.27 * len(rows) for rows in rounds))
    panels = figure.subplots(len(rounds), 1, squeeze=False, height_ratios=[1 + len(rows) for rows in rounds])[:, 0]
    groups = {name: k for k, group in enumerate(diagnosis.confusable) for name in group}
    high = max([10.0, *(row.score for rows in rounds for row in rows)])
    for axes, rows, number in zip(panels, rounds, numbers, strict=True):
        _round(axes, rows, groups, _added_in(diagnosis, number), high)
        axes.set_title("" if len(rounds) == 1 else f"Round {number}", fontsize=TEXT, loc="left")
    words = "Gain less penalty: fall of the sum of squares over noise, less ln n per parameter"
    panels[-1].set_xlabel(words, fontsize=TEXT)
    from matplotlib.patches import Patch

    kinds = {"added": Patch(facecolor=COLOURS[0])} if {e.effect.name for e in diagnosis.added} - set(groups) else {}
    kinds |= {
        "refitted": Patch(facecolor=COLOURS[5]),
        "screened only": Patch(facecolor="white", edgecolor=COLOURS[5], hatch="////"),
    }
    if groups:
        kinds["indistinguishable"] = Patch(facecolor=COLOURS[4])
    legend_above(figure, list(kinds.values()), list(kinds))
    return figure


def _shown(rows: Sequence[Candidate], number: int) -> Sequence[Candidate]:
    """Of a later round what pays, and a few at least."""
    paying = sum(row.score > 1 for row in rows)
    return rows[: _ROWS if number == 1 else min(_ROWS, max(_FEW, paying))]


def _added_in(diagnosis: Diagnosis, number: int) -> set[str]:
    """Effects that this round has added: those that were candidates in it and in no later one."""
    later = {row.effect for row in diagnosis.ranking if row.round > number}
    own = {row.effect for row in diagnosis.ranking if row.round == number}
    return {one.effect.name for one in diagnosis.added} & own - later


def _round(axes: Axes, rows: Sequence[Candidate], groups: dict[str, int], added: set[str], high: float) -> None:
    quiet(axes)
    axes.grid(False, axis="y")
    axes.set_xscale("log")
    axes.set_xlim(1.0, high * 4.0)
    for i, row in enumerate(rows):
        colour = COLOURS[4] if row.effect in groups else COLOURS[0] if row.effect in added else COLOURS[5]
        _bar(axes, i, row, colour)
    _brackets(axes, [row.effect for row in rows], groups)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks(range(len(rows)), [row.effect for row in rows], fontsize=SMALL)


def _bar(axes: Axes, i: int, row: Candidate, colour: str) -> None:
    """From 1 to its score; a candidate that does not pay has no bar. Its share of the misfit stands at the right."""
    if row.score > 1:
        hollow = {"facecolor": "white", "edgecolor": colour, "hatch": "////"}
        look: dict[str, Any] = {"facecolor": colour} if row.refitted else hollow
        axes.barh(i, row.score - 1, left=1.0, height=0.62, linewidth=0.8, **look)
    axes.annotate(
        f"{row.score:,.0f}" if row.score > 1 else "does not pay", (max(row.score, 1.0), i),
        xytext=(4, 0), textcoords="offset points", va="center", fontsize=SMALL, color="#333333",
    )  # fmt: skip
    axes.annotate(
        f"{100 * row.explained:.1f} %", (1.0, i), xycoords=("axes fraction", "data"), xytext=(34, 0),
        textcoords="offset points", va="center", ha="right", fontsize=SMALL,
    )  # fmt: skip


def _brackets(axes: Axes, names: Sequence[str], groups: dict[str, int]) -> None:
    """A line beside the names of each group, and what the numbers at the right are."""
    axes.annotate(
        "of the misfit", (1.0, -0.6), xycoords=("axes fraction", "data"), xytext=(34, 3), textcoords="offset points",
        ha="right", fontsize=SMALL, color="#5c5c5c",
    )  # fmt: skip
    for k in set(groups.values()):
        own = [i for i, name in enumerate(names) if groups.get(name) == k]
        if len(own) > 1:
            axes.plot(
                [0.012, 0.004, 0.004, 0.012], [own[0] - 0.3, own[0] - 0.3, own[-1] + 0.3, own[-1] + 0.3],
                color=MEASURED, linewidth=1.6, transform=axes.get_yaxis_transform(), clip_on=False, zorder=5,
            )  # fmt: skip
