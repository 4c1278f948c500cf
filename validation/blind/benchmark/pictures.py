"""The benchmark's pictures: naming over the footprint, and what was answered to what."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Picture
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from pysim.plot.style import COLOURS, LIMIT, MEASURED, SMALL, TEXT, new_figure, quiet
from validation.blind.benchmark.figures import VISIBLE, Figure, Pair, right_first, tied
from validation.blind.benchmark.logistic import rise
from validation.blind.plant.effects import BEYOND, STANDARD

Array = NDArray[np.float64]

LEFT_OUT, PAIR = "left out of the catalogue", ""
_EDGES = np.array([1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 1e5, 1e6, 1e8])
_ANSWERS = (*STANDARD, "unknown", "none", "no answer")


def naming_picture(named: Sequence[Pair]) -> Picture:
    """Share of right names over the footprint: bins with 95 percent intervals, and the logistic curve through all."""
    figure = new_figure(7.2, 3.9)
    axes = figure.add_subplot()
    quiet(axes)
    known = [pair for pair in named if pair[1].footprint]
    sizes = np.array([max(pair[1].footprint or 0.0, _EDGES[0]) for pair in known])
    hits = np.array([right_first(pair) for pair in known], dtype=bool)
    axes.axvline(VISIBLE, color=LIMIT, linewidth=1.0)
    axes.axhline(95, color=LIMIT, linewidth=1.0, linestyle=(0, (4, 3)))
    axes.text(VISIBLE * 1.08, 3, "footprint 100", fontsize=SMALL, color="#555555")
    axes.text(_EDGES[0] * 1.1, 96, "95 %", fontsize=SMALL, color="#555555")
    if known:
        _curve(axes, sizes, hits)
        _bins(axes, sizes, hits)
        both = np.array([right_first(pair) or tied(pair) for pair in known])
        _ticks(axes, sizes, both, hits)
    axes.set_xscale("log")
    axes.set_xlim(_EDGES[0], max(1e6, float(sizes.max(initial=1.0)) * 1.5))
    axes.set_ylim(-6, 106)
    axes.set_xlabel("Footprint: sum of squares over noise that the refitted base model leaves", fontsize=TEXT)
    axes.set_ylabel("Right effect named first (%)", fontsize=TEXT)
    if known:
        handles, labels = axes.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper left", ncols=len(labels), frameon=False, fontsize=TEXT)
    return figure


def _curve(axes: Axes, sizes: Array, hits: NDArray[np.bool_]) -> None:
    x = np.log10(sizes)
    found, dense = rise(x, hits), np.linspace(0.0, max(6.0, float(x.max())), 200)
    low, high = found.band(dense)
    axes.fill_between(10**dense, 100 * low, 100 * high, color=COLOURS[0], alpha=0.15, linewidth=0)
    axes.plot(10**dense, 100 * found.share(dense), color=COLOURS[0], linewidth=1.4, label="logistic curve")


def _bins(axes: Axes, sizes: Array, hits: NDArray[np.bool_]) -> None:
    label = "bins with 95 % intervals"
    for low, high in pairwise(_EDGES.tolist()):
        inside = (sizes >= low) & (sizes < high)
        if not inside.any():
            continue
        figure = Figure("", int(hits[inside].sum()), int(inside.sum()))
        at, bounds = float(np.exp(np.mean(np.log(sizes[inside])))), figure.interval
        axes.plot([at, at], bounds, color=MEASURED, linewidth=1.0)
        axes.plot(at, figure.percent, "o", color=MEASURED, markersize=4.5, label=label)
        label = ""


def _ticks(axes: Axes, sizes: Array, both: NDArray[np.bool_], hits: NDArray[np.bool_]) -> None:
    """Every case as a tick: above named, below not, in the second colour where only tied."""
    shown = (
        (hits, 103, COLOURS[0], ""),
        (~both, -3, MEASURED, ""),
        (both & ~hits, -3, COLOURS[1], "tied with another"),
    )
    for chosen, at, colour, label in shown:
        if chosen.any():
            axes.plot(sizes[chosen], np.full(int(chosen.sum()), at), "|", color=colour, markersize=5, label=label)


def confusion(pairs: Sequence[Pair]) -> dict[str, Counter[str]]:
    """Truth -> verdict -> how many; the effects left out of the catalogue in one row, pairs apart."""
    found: dict[str, Counter[str]] = {name: Counter() for name in (*STANDARD, "none", LEFT_OUT, *BEYOND)}
    for case, answer in pairs:
        if case.kind == "pair":
            continue
        truth = LEFT_OUT if case.kind == "left-out" else case.effects[0][0] if case.effects else "none"
        found[truth][answer.verdict or "no answer"] += 1
    return {truth: row for truth, row in found.items() if row}


def confusion_picture(pairs: Sequence[Pair]) -> Picture:
    """Truth down, verdict across; shades are shares of the row, numbers are cases, frames are right answers."""
    found = confusion(pairs)
    truths = list(found)
    columns = [name for name in _ANSWERS if name in STANDARD or any(found[t][name] for t in truths)]
    counts = np.array([[found[t][name] for name in columns] for t in truths], dtype=float).reshape(-1, len(columns))
    share = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
    figure = new_figure(0.36 * len(columns) + 2.6, 0.26 * max(len(truths), 4) + 2.2)
    axes = figure.add_subplot()
    if truths:
        axes.imshow(share, cmap="Blues", vmin=0, vmax=1.15, aspect="auto")
    for i, j in zip(*np.nonzero(counts), strict=True):
        dark = "white" if share[i, j] > 0.6 else MEASURED
        axes.text(j, i, f"{counts[i, j]:.0f}", ha="center", va="center", fontsize=SMALL, color=dark)
    for i, truth in enumerate(truths):
        right = truth if truth in columns else "unknown"
        if right in columns:
            frame = Rectangle(
                (columns.index(right) - 0.5, i - 0.5), 1, 1, fill=False, edgecolor=COLOURS[1], linewidth=1.2
            )
            axes.add_patch(frame)
    axes.set_xticks(range(len(columns)), columns, rotation=60, ha="left", rotation_mode="anchor", fontsize=SMALL)
    axes.set_yticks(range(len(truths)), truths, fontsize=SMALL)
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    axes.set_xlabel("Verdict", fontsize=TEXT)
    axes.xaxis.set_label_position("top")
    axes.set_ylabel("In the plant", fontsize=TEXT)
    return figure
