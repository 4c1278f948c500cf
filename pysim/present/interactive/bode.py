"""Frequency responses: magnitude above phase."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, THESIS_REFERENCE_HZ
from pysim.present.interactive.look import LOOKS, Figure, axis, figure, plain

_NEAR = 1e-3  # of the reference, by which the frequency of a log may be off, as in pysim.identify.greybox.stepped_sines
_NUMBERS = 6  # wanted along the frequencies; of two decades and more Plotly then takes 1, 2 and 5


def bode_figure(response: Mapping[str, Any], models: Sequence[tuple[str, str, Mapping[str, Any]]]) -> Figure:
    """Magnitude above phase, measured with the band of thesis Table 1.3 around it, and the models.

    Args:
        response: measured, `frequency` Hz, `gain`, `phase` rad.
        models: key of LOOKS, words, and the simulated `gain` and `phase`.
    """
    f = response["frequency"]
    reference = reference_place(f)
    relative = ", absolute" if reference is None else f" relative to {f[reference]:g} Hz"
    shown: tuple[Callable[..., list[float]], ...] = (partial(_decibels, reference=reference), _degrees)
    limits = (FREQUENCY_CRITERIA[1].limit, FREQUENCY_CRITERIA[3].limit)
    measured = response["measured"]
    data: list[dict[str, Any]] = []
    for panel, limit in enumerate(limits):
        y = shown[panel](measured)
        place = {"xaxis": "x", "yaxis": "y2" if panel else "y"}
        band = {"x": [*f, *reversed(f)], "y": [v + limit for v in y] + [v - limit for v in reversed(y)]}
        told = f"± {limits[0]:g} dB, ± {limits[1]:g}° (Table 1.3)"
        look = {"fill": "toself", "fillcolor": "@band", "line": {"width": 0}, "mode": "lines", "hoverinfo": "skip"}
        data.append({**band, **look, **place, "name": told, "showlegend": not panel, "legendgroup": "band"})
        unit = "°" if panel else "dB"
        for key, words, side in [("measured", "measured", measured), *models]:
            _, colour, dash = LOOKS[key]
            values = shown[panel](side)
            if panel:
                turns = round((values[0] - y[0]) / 360)
                values = [v - 360 * turns for v in values]
            line = {"color": colour, "width": 2, "dash": dash}
            marks = {"mode": "lines+markers", "marker": {"size": 6, "color": colour}} if key == "measured" else {}
            hover = f"{plain(words)}: %{{y:.2f}} {unit} at %{{x:g}} Hz<extra></extra>"
            data.append({"x": f, "y": values, "mode": "lines", "line": line, "name": plain(words), **marks, **place} | {
                "legendgroup": key, "showlegend": not panel, "hovertemplate": hover,
            })  # fmt: skip
    return figure(
        data,
        xaxis=axis("Frequency (Hz)", type="log", nticks=_NUMBERS, tickformat="~g", anchor="y2"),
        yaxis=axis(f"Magnitude{relative} (dB)", domain=[0.53, 1]),
        yaxis2=axis("Phase (°)", domain=[0, 0.47], dtick=45 if max(map(abs, _degrees(measured))) > 60 else None),
    )


def reference_place(frequency: Sequence[float]) -> int | None:
    """Place of the frequency (Hz) whose gain counts as 0 dB on both sides where a response is judged; None: none does.

    A file of stages does not tell it. Logs of stepped sines are judged relative to 0.1 Hz where one of them is at that
    frequency, and as they are where none is; tables always have it.
    """
    near = np.flatnonzero(np.isclose(frequency, THESIS_REFERENCE_HZ, rtol=_NEAR))
    return int(near[0]) if near.size else None


def _decibels(side: Mapping[str, Any], *, reference: int | None) -> list[float]:
    """Magnitude over that at the place of the reference, or as it is."""
    base = 1.0 if reference is None else side["gain"][reference]
    return [20 * math.log10(v / base) for v in side["gain"]]


def _degrees(side: Mapping[str, Any]) -> list[float]:
    return [math.degrees(v) for v in side["phase"]]
