"""Frequency responses: magnitude above phase."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from pysim.app.figures.look import LOOKS, Figure, axis, figure, plain
from pysim.identify import FREQUENCY_CRITERIA


def bode_figure(response: Mapping[str, Any], models: Sequence[tuple[str, str, Mapping[str, Any]]]) -> Figure:
    """Magnitude above phase, measured with the band of thesis Table 1.3 around it, and the models.

    Args:
        response: measured, `frequency` Hz, `gain`, `phase` rad.
        models: key of LOOKS, words, and the simulated `gain` and `phase`.
    """
    f = response["frequency"]
    limits = (FREQUENCY_CRITERIA[1].limit, FREQUENCY_CRITERIA[3].limit)
    measured = response["measured"]
    data: list[dict[str, Any]] = []
    for panel, limit in enumerate(limits):
        y = _bode(measured, panel)
        place = {"xaxis": "x", "yaxis": "y2" if panel else "y"}
        band = {"x": [*f, *reversed(f)], "y": [v + limit for v in y] + [v - limit for v in reversed(y)]}
        told = f"± {limits[0]:g} dB, ± {limits[1]:g}° (Table 1.3)"
        look = {"fill": "toself", "fillcolor": "@band", "line": {"width": 0}, "mode": "lines", "hoverinfo": "skip"}
        data.append({**band, **look, **place, "name": told, "showlegend": not panel, "legendgroup": "band"})
        unit = "°" if panel else "dB"
        for key, words, side in [("measured", "measured", measured), *models]:
            _, colour, dash = LOOKS[key]
            values = _bode(side, panel)
            if panel:
                turns = round((values[0] - y[0]) / 360)
                values = [v - 360 * turns for v in values]
            line = {"color": colour, "width": 2, "dash": dash}
            marks = {"mode": "lines+markers", "marker": {"size": 6, "color": colour}} if key == "measured" else {}
            hover = f"{plain(words)}: %{{y:.2f}} {unit} at %{{x:g}} Hz<extra></extra>"
            data.append({"x": f, "y": values, "mode": "lines", "line": line, "name": plain(words), **marks, **place} | {
                "legendgroup": key, "showlegend": not panel, "hovertemplate": hover,
            })  # fmt: skip
    ticks = [t for t in (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200) if f[0] <= t <= f[-1]]
    return figure(
        data,
        xaxis=axis("Frequency (Hz)", type="log", tickvals=ticks, ticktext=[f"{t:g}" for t in ticks], anchor="y2"),
        yaxis=axis("Magnitude (dB)", domain=[0.53, 1]),
        yaxis2=axis("Phase (°)", domain=[0, 0.47], dtick=45 if max(map(abs, _bode(measured, 1))) > 60 else None),
    )


def _bode(side: Mapping[str, Any], panel: int) -> list[float]:
    """Magnitude relative to the lowest frequency in dB (panel 0), or phase in degrees (panel 1)."""
    if panel:
        return [math.degrees(v) for v in side["phase"]]
    return [20 * math.log10(v / side["gain"][0]) for v in side["gain"]]
