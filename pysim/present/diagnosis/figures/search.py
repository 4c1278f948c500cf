"""A search while it runs: what the model and each candidate leave, point by point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pysim.present.charts import Chart, axis, chart, level_line, plain, size_axis
from pysim.present.diagnosis.figures.error import TICKS

_BASE = "base model"
_FEW = 12  # points, below which each has a number on the axis
_RISES = 1.001  # times the error before: more than what a finer integration changes
_ROOM = (0.8, 1.25)  # of the axis, below the least and above the largest value


def by_model(trials: Sequence[Mapping[str, Any]]) -> dict[str, list[tuple[int, float]]]:
    """Model, by what it has besides the base model -> numbers of its points, and the residual over noise at each.

    Args:
        trials: `names` and `error` of points, in the order in which they were tried.
    """
    found: dict[str, list[tuple[int, float]]] = {}
    for number, one in enumerate(trials, 1):
        found.setdefault(" + ".join(one["names"]) or _BASE, []).append((number, float(one["error"])))
    return found


def left_over(trials: Sequence[Mapping[str, Any]]) -> list[tuple[str, float]]:
    """Each model and the least it leaves, the best first."""
    return sorted(((name, min(e for _, e in points)) for name, points in by_model(trials).items()), key=lambda m: m[1])


def search_chart(trials: Sequence[Mapping[str, Any]]) -> Chart:
    """A line per model over the points tried, the best one and the base model set apart from all others.

    Args:
        trials: as of `by_model`.
    """
    found, ranked = by_model(trials), left_over(trials)
    best = ranked[0][0] if ranked else _BASE
    looks = {_BASE: ("@base", 2.4), best: ("@final", 3.0)} if best != _BASE else {_BASE: ("@final", 3.0)}
    lines = []
    for name in sorted(found, key=lambda one: one in looks):  # those above lie over the others
        colour, width = looks.get(name, ("@prior", 1.2))
        x, y = _searches(found[name])
        lines.append(
            {"x": x, "y": y, "mode": "lines+markers", "name": plain(name), "showlegend": name in looks}
            | {"line": {"color": colour, "width": width}, "marker": {"color": colour, "size": 2 + 2 * width}}
            | {"hovertemplate": f"{plain(name)}: %{{y:.3g}} times the noise<extra></extra>"}
        )
    errors = [error for points in found.values() for _, error in points] or [1.0]
    low, high = _ROOM[0] * min(1.0, *errors), _ROOM[1] * max(1.6, *errors)
    return chart(
        lines,
        xaxis=axis("Points tried", rangemode="tozero", **({"dtick": 1} if len(trials) < _FEW else {})),
        yaxis=size_axis("Residual over noise (–)", low, high, [t for t in TICKS if low <= t <= high]),
        shapes=[level_line(1.0, "@quiet", 1.0)],
    )


def _searches(points: Sequence[tuple[int, float]]) -> tuple[list[int], list[float | None]]:
    """Numbers and errors with a gap ahead of each new search: within one the best error never rises."""
    x: list[int] = []
    y: list[float | None] = []
    for (number, error), (_, before) in zip(points, [points[0], *points], strict=False):
        if error > _RISES * before:
            x, y = [*x, number], [*y, None]
        x, y = [*x, number], [*y, error]
    return x, y
