"""The falling error: a level per step."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from textwrap import wrap
from typing import Any

from pysim.app.figures.look import Figure, axis, figure, plain
from pysim.present.diagnosis.words import step_name
from pysim.present.notes import USES


def error_figure(steps: Sequence[Mapping[str, Any]], *, doing: str = "") -> Figure:
    """The error over noise, step by step, fitted and held out; what is being worked on stands last, empty.

    Args:
        steps: of the error history.
        doing: name of the step that is being found; "" where nothing runs.
    """
    names = [plain(step_name(s["step"])) for s in steps] + ([f"<i>{_wrapped(doing)} …</i>"] if doing else [])
    places = list(range(len(names)))
    lines = {
        USES["fit"]: ([s["fit"] for s in steps], "@final", "solid", "circle", -0.16),
        USES["validate"]: ([s["validate"] for s in steps], "@base", "dash", "square", 0.16),
    }
    known = [v for values, *_ in lines.values() for v in values if v]
    low, high = min([0.6, *(0.62 * v for v in known)]), max([3.0, *(1.9 * v for v in known)])
    data: list[dict[str, Any]] = []
    notes: list[dict[str, Any]] = []
    for name, (values, colour, dash, symbol, _) in lines.items():
        if any(v is not None for v in values):
            data += _stairs(name, values, colour, dash, symbol)
    for k, step in enumerate(steps):
        pair = sorted(((step["fit"], "@final"), (step["validate"], "@base")), key=lambda p: -(p[0] or 0.0))
        for rank, (value, colour) in enumerate(p for p in pair if p[0]):
            notes.append(_number(k, value, colour, above=rank == 0))
    noise = {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, "y0": low, "y1": 1, "fillcolor": "@band"}
    shapes = [{**noise, "line": {"width": 0}, "layer": "below"}]
    if doing:
        begin = len(steps) - 0.5
        box = {"type": "rect", "x0": begin + 0.06, "x1": begin + 0.94, "yref": "paper", "y0": 0.02, "y1": 0.98}
        shapes.append({**box, "line": {"color": "@quiet", "width": 1.2, "dash": "dot"}, "fillcolor": "@raised"})
    notes.append(
        {"xref": "paper", "x": 0.004, "y": math.log10(1.0), "text": "noise alone", "showarrow": False}
        | {"xanchor": "left", "yanchor": "top", "font": {"size": 11.5, "color": "@quiet"}}
    )
    ticks = [d * 10.0**p for p in range(-1, 6) for d in (1, 2, 5) if low <= d * 10.0**p <= high]
    return figure(
        data,
        xaxis=axis(range=[-0.5, max(len(names), 3) - 0.5], tickvals=places, ticktext=names, showgrid=False),
        yaxis=axis(
            "Error over noise (–)", type="log", range=[math.log10(low), math.log10(high)], tickvals=ticks,
            ticktext=[f"{t:g}" for t in ticks],
        ),
        shapes=shapes,
        annotations=notes,
        margin={"l": 62, "r": 18, "t": 34, "b": 30},
    )  # fmt: skip


def _wrapped(words: str) -> str:
    """In lines that fit below a step."""
    return "<br>".join(plain(line) for line in wrap(words, 20))


def _stairs(name: str, values: Sequence[float | None], colour: str, dash: str, symbol: str) -> list[dict[str, Any]]:
    """A level per step, and a mark in its middle."""
    x = [edge for k in range(len(values)) for edge in (k - 0.5, k + 0.5)]
    y = [v for v in values for _ in range(2)]
    line = {"color": colour, "width": 3, "dash": dash}
    marks = {"color": colour, "size": 9, "symbol": symbol}
    level = {"x": x, "y": y, "mode": "lines", "line": line, "name": name, "hoverinfo": "skip", "showlegend": False}
    hover = f"{name}: %{{y:.3g}} times the noise<extra></extra>"
    both = {"mode": "lines+markers", "line": line, "marker": marks, "name": name, "hovertemplate": hover}
    return [
        level,
        {**both, "x": [None, *range(len(values))], "y": [None, *values], "mode": "markers"},
    ]


def _number(k: int, value: float, colour: str, *, above: bool) -> dict[str, Any]:
    text = f"<b>{value:.3g}</b>" if value >= 10 else f"<b>{value:.2f}</b>"
    place = {"x": k, "y": math.log10(value), "yshift": 15 if above else -15, "showarrow": False}
    return {**place, "text": text, "font": {"color": colour, "size": 13}}
