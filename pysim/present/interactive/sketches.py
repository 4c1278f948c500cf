"""Sketches: an effect's law, a model with its ports and slots, and where a model fails."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from pysim.effects import Sketch
from pysim.present.interactive.look import Figure, axis, figure, plain
from pysim.types import Failure

_COLOURS = ("@final", "@base", "@prior")
_WORST = 12  # regions that are drawn


def sketch_figure(sketch: Sketch, name: str) -> Figure:
    """The strokes of a law, without numbers."""
    lines = [
        {"x": list(x), "y": list(y), "mode": "lines", "line": {"color": _COLOURS[k % len(_COLOURS)], "width": 2.5}}
        for k, (x, y) in enumerate(sketch.curves)
    ]
    quiet: dict[str, Any] = {"showticklabels": False}
    title = f"{plain(name)}: {plain(sketch.words)}"
    return figure(lines, xaxis=axis(**quiet), yaxis=axis(**quiet), title={"text": title}, showlegend=False)


def model_figure(
    title: str, inputs: Sequence[str], outputs: Sequence[str], inside: Sequence[str], slots: Sequence[str]
) -> Figure:
    """Inputs, a box with some lines, outputs, and the slots below."""
    box = {"type": "rect", "x0": 0.3, "x1": 0.7, "y0": 0.35, "y1": 1, "line": {"color": "@ink", "width": 1.2}}
    columns = [(0.28, inputs, " →", "right"), (0.5, inside, "", "center"), (0.72, outputs, "", "left")]
    notes = [_words(x, 0.67, [f"{one}{end}" for one in names], side) for x, names, end, side in columns if names]
    for k, one in enumerate(slots):
        at = _words((k + 0.5) / len(slots), 0.15, one.splitlines(), "center")
        notes.append({**at, "bordercolor": "@line", "borderwidth": 1, "borderpad": 6})
    hidden = {"visible": False, "range": [0, 1]}
    return figure([], shapes=[box], annotations=notes, xaxis=hidden, yaxis=hidden, title={"text": plain(title)})


def _words(x: float, y: float, lines: Sequence[str], side: str) -> dict[str, Any]:
    return {"x": x, "y": y, "xanchor": side, "text": "<br>".join(map(plain, lines)), "showarrow": False}


def regions_figure(failures: Sequence[Failure]) -> Figure:
    """Where a model fails, the worst regions above, with their residual over noise."""
    worst = failures[:_WORST]
    names = [plain(f"{one.record}, {one.signal}: {one.region}") for one in worst]
    bars = {"type": "bar", "orientation": "h", "x": [one.error for one in worst], "y": names}
    return figure(
        [{**bars, "marker": {"color": "@final"}}],
        xaxis=axis("Residual over noise (1: noise alone)"),
        yaxis=axis(type="category", autorange="reversed", ticksuffix="  "),
        showlegend=False,
    )
