"""A learned law, as a curve."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pysim.io import shown_unit
from pysim.present.interactive.look import Figure, axis, figure, plain, unit_text


def law_figure(law: Mapping[str, Any]) -> Figure:
    """The curve over what it depends on, with its 95 percent band.

    Args:
        law: of `missing` in the answer.
    """
    shape = law["shape"]
    unit_in, scale_in = shown_unit(shape["argument_unit"])
    unit_out, scale_out = shown_unit(shape["unit"])
    x = [v * scale_in for v in shape["argument"]]
    sides = {name: [v * scale_out for v in shape[name]] for name in ("value", "low", "high")}
    band: dict[str, Any] = {"x": [*x, *reversed(x)], "y": [*sides["high"], *reversed(sides["low"])], "fill": "toself"}
    band |= {"fillcolor": "@finalband", "line": {"width": 0}, "name": "95 % band", "hoverinfo": "skip", "mode": "lines"}
    line: dict[str, Any] = {"x": x, "y": sides["value"], "mode": "lines+markers", "name": "learned law"}
    line |= {"line": {"color": "@final", "width": 2.5}, "marker": {"size": 6, "color": "@final"}}
    zero = {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 0, "y1": 0, "line": {"color": "@line", "width": 1}}
    return figure(
        [band, line],
        xaxis=axis(f"{plain(law['depends_on'])} ({unit_text(unit_in)})"),
        yaxis=axis(f"missing at {plain(law['slot'])} ({unit_text(unit_out)})"),
        shapes=[zero],
    )
