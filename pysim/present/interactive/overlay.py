"""A record over time: measured, simulated, and what is left over."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pysim.identify import HALF_95
from pysim.present.interactive.look import LOOKS, Figure, axis, figure, plain, unit_text


def overlay_figure(
    names: Sequence[str], units: Sequence[str], models: Sequence[tuple[str, str]], traces: Sequence[Mapping[str, Any]]
) -> Figure:
    """Each signal as measured and as the models have it, what each leaves below; all panels share the time axis.

    Args:
        names, units: of the signals.
        models: key of LOOKS and words of each model.
        traces: as `signal_traces` gives them.
    """
    layout: dict[str, Any] = {"xaxis": axis("Time (s)", showgrid=True)}
    heights = [weight for _ in names for weight in ((3.0, 1.6) if models else (3.0,))]
    gap = 0.045
    free, top = 1.0 - gap * (len(heights) - 1), 1.0
    for k, weight in enumerate(heights):
        size = free * weight / sum(heights)
        name = names[k // 2] if models else names[k]
        unit = units[k // 2] if models else units[k]
        residual = bool(models) and k % 2 == 1
        title = "left over<br>(noise s.d.)" if residual else f"{plain(name)} ({unit_text(unit)})"
        low = max(top - size, 0.0)
        layout[f"yaxis{k + 1 if k else ''}"] = axis(title, domain=[low, top], anchor="x")
        top -= size + gap
    last = len(heights)
    layout["xaxis"]["anchor"] = f"y{last}" if last > 1 else "y"
    bands = [
        {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, "yref": f"y{2 * k + 2}", "y0": -HALF_95, "y1": HALF_95}
        | {"fillcolor": "@band", "line": {"width": 0}, "layer": "below"}
        for k in range(len(names) if models else 0)
    ]
    return figure(traces, **layout, shapes=bands, dragmode="zoom", margin={"l": 74, "r": 18, "t": 30, "b": 46})


def signal_trace(key: str, words: str, panel: int, x: Any, y: Any, *, legend: bool, unit: str = "") -> dict[str, Any]:
    """One line of an overlay.

    Args:
        key: of LOOKS.
        panel: from 1, from above.
    """
    _, colour, dash = LOOKS[key]
    look = {"color": colour, "width": 1.4 if key == "measured" else 1.8, "dash": dash}
    hover = f"{plain(words)}: %{{y:.4g}} {unit_text(unit)} at %{{x:.4g}} s<extra></extra>"
    place = {"xaxis": "x", "yaxis": f"y{panel}" if panel > 1 else "y"}
    return {"type": "scatter", "mode": "lines", "x": x, "y": y, "name": plain(words), "line": look, **place} | {
        "legendgroup": key, "showlegend": legend, "hovertemplate": hover,
    }  # fmt: skip
