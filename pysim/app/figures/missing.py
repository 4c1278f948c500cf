"""The term that is missing, as a curve."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pysim.app.figures.look import Figure, axis, figure, plain, unit_text
from pysim.io import shown_unit


def missing_figure(missing: Mapping[str, Any]) -> Figure:
    """The missing term over what it depends on, with its 95 percent band."""
    shape = missing["shape"]
    unit_in, scale_in = shown_unit(shape["argument_unit"])
    unit_out, scale_out = shown_unit(shape["unit"])
    x = [v * scale_in for v in shape["argument"]]
    sides = {name: [v * scale_out for v in shape[name]] for name in ("value", "low", "high")}
    band: dict[str, Any] = {"x": [*x, *reversed(x)], "y": [*sides["high"], *reversed(sides["low"])], "fill": "toself"}
    band |= {"fillcolor": "@finalband", "line": {"width": 0}, "name": "95 % band", "hoverinfo": "skip", "mode": "lines"}
    line: dict[str, Any] = {"x": x, "y": sides["value"], "mode": "lines+markers", "name": "what would close the gap"}
    line |= {"line": {"color": "@final", "width": 2.5}, "marker": {"size": 6, "color": "@final"}}
    zero = {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 0, "y1": 0, "line": {"color": "@line", "width": 1}}
    return figure(
        [band, line],
        xaxis=axis(f"{plain(missing['depends_on'])} ({unit_text(unit_in)})"),
        yaxis=axis(f"missing at {plain(missing['slot'])} ({unit_text(unit_out)})"),
        shapes=[zero],
    )
