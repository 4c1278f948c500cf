"""The falling error: a level per step."""

from __future__ import annotations

import math
from collections.abc import Sequence
from textwrap import wrap
from typing import Any

from pysim.present.diagnosis.levels import levels
from pysim.present.diagnosis.words import step_name
from pysim.present.interactive.look import Figure, axis, figure, plain
from pysim.present.notes import USES
from pysim.types import ErrorStep

_LOOKS = dict(
    zip(
        USES.values(),
        (("@final", "solid", "circle"), ("@base", "dash", "square"), ("@measured", "dot", "diamond")),
        strict=True,
    )
)
_ABOVE, _BESIDE, _BELOW = {"yshift": 15}, {"xshift": 26}, {"yshift": -15}


def error_figure(steps: Sequence[ErrorStep], *, doing: str = "") -> Figure:
    """The error over noise, step by step, of each use of logs; what is being worked on stands last, empty.

    Args:
        steps: of the error history.
        doing: name of the step that is being found; "" where nothing runs.
    """
    names = [plain(step_name(step.step)) for step in steps] + ([f"<i>{_wrapped(doing)} …</i>"] if doing else [])
    found = levels(steps)
    data = [trace for use, values in found.lines.items() for trace in _stairs(use, values)]
    notes = [note for k in range(len(steps)) for note in _numbers(k, {u: v[k] for u, v in found.lines.items()})]
    noise = {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, "y0": found.low, "y1": 1, "fillcolor": "@band"}
    shapes = [{**noise, "line": {"width": 0}, "layer": "below"}]
    if doing:
        begin = len(steps) - 0.5
        box = {"type": "rect", "x0": begin + 0.06, "x1": begin + 0.94, "yref": "paper", "y0": 0.02, "y1": 0.98}
        shapes.append({**box, "line": {"color": "@quiet", "width": 1.2, "dash": "dot"}, "fillcolor": "@raised"})
    notes.append(
        {"xref": "paper", "x": 0.004, "y": math.log10(1.0), "text": "noise alone", "showarrow": False}
        | {"xanchor": "left", "yanchor": "top", "font": {"size": 11.5, "color": "@quiet"}}
    )
    return figure(
        data,
        xaxis=axis(
            range=[-0.5, max(len(names), 3) - 0.5], tickvals=list(range(len(names))), ticktext=names, showgrid=False
        ),
        yaxis=axis(
            "Error over noise (–)", type="log", range=[math.log10(found.low), math.log10(found.high)],
            tickvals=found.ticks, ticktext=[f"{t:g}" for t in found.ticks],
        ),
        shapes=shapes,
        annotations=notes,
        margin={"l": 62, "r": 18, "t": 34, "b": 30},
    )  # fmt: skip


def _wrapped(words: str) -> str:
    """In lines that fit below a step."""
    return "<br>".join(plain(line) for line in wrap(words, 20))


def _stairs(use: str, values: Sequence[float | None]) -> list[dict[str, Any]]:
    """A level per step, and a mark in its middle."""
    colour, dash, symbol = _LOOKS[use]
    x = [edge for k in range(len(values)) for edge in (k - 0.5, k + 0.5)]
    y = [v for v in values for _ in range(2)]
    line = {"color": colour, "width": 3, "dash": dash}
    marks = {"color": colour, "size": 9, "symbol": symbol}
    level = {"x": x, "y": y, "mode": "lines", "line": line, "name": use, "hoverinfo": "skip", "showlegend": False}
    hover = f"{use}: %{{y:.3g}} times the noise<extra></extra>"
    both = {"mode": "lines+markers", "line": line, "marker": marks, "name": use, "hovertemplate": hover}
    return [
        level,
        {**both, "x": [None, *range(len(values))], "y": [None, *values], "mode": "markers"},
    ]


def _numbers(k: int, values: dict[str, float | None]) -> list[dict[str, Any]]:
    """The largest above its line, the smallest below, one between them beside."""
    known = sorted(((value, _LOOKS[use][0]) for use, value in values.items() if value), reverse=True)
    places = [_ABOVE, *[_BESIDE] * (len(known) - 2), _BELOW]
    return [_number(k, value, colour, place) for (value, colour), place in zip(known, places, strict=False)]


def _number(k: int, value: float, colour: str, place: dict[str, int]) -> dict[str, Any]:
    text = f"<b>{value:.3g}</b>" if value >= 10 else f"<b>{value:.2f}</b>"
    there = {"x": k, "y": math.log10(value), "showarrow": False, **place}
    return {**there, "text": text, "font": {"color": colour, "size": 13}}
