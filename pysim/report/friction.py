"""A friction fit as text, as data for JSON and as sections of the page."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping
from typing import Any

import numpy as np

from pysim.identify.friction import FRICTION_NAMES, FRICTION_UNITS, FrictionFit
from pysim.io import json_number
from pysim.report.page import cell, commands, heading, items, page, paragraph, picture, table

_MEANING = {
    "r": "steepness at standstill",
    "omega_0": "speed over which stiction fades",
    "tau_c": "Coulomb friction",
    "tau_s": "stiction",
}


def friction_text(fit: FrictionFit) -> str:
    """A row per parameter with its 95 percent interval, then what the data do not tell."""
    lines = ["  parameter     value   95 % interval"]
    for name, unit in zip(FRICTION_NAMES, FRICTION_UNITS, strict=True):
        value = "-" if name in fit.bounded else f"{fit.parameters[name]:.4f}"
        lines.append(f"  {name:<9}{value:>10}   {_interval(fit, name)} {unit:<6} {_MEANING[name]}")
    lines.append(
        f"  residual {fit.rms:.3g} N.m, {fit.residuals.size} samples worth {fit.effective:.0f} independent ones"
    )
    return "\n".join(
        [*lines, *(row for remark in remarks(fit) for row in textwrap.wrap(remark, 78, break_on_hyphens=False))]
    )


def remarks(fit: FrictionFit) -> tuple[str, ...]:
    """In words: what was not seen, what is bounded only, what stands at a bound, what was left out."""
    texts = [
        f"No sample is slower than {fit.blind_below:.3g} rad/s; below it the curve is that of the law, not of the data."
    ]
    low, high = fit.intervals["r"]
    if "r" in fit.bounded and low > 0:
        texts.append(
            f"The steepness r is bounded, not measured: above {low:.3g} s/rad (95 percent, one-sided) every value fits "
            f"alike. Where a number is needed take {fit.parameters['r']:.3g}. To measure it, log speeds of about 1/r "
            "and below, with a sensor that resolves them."
        )
    elif "r" in fit.bounded:
        end = "anything" if math.isinf(high) else f"at most {high:.3g} s/rad"
        texts.append(f"The steepness r is bounded, not measured: it may be {end} (95 percent).")
    if fit.at_bound:
        texts.append(f"Stopped by a bound: {', '.join(fit.at_bound)}; the true value may lie beyond it.")
    left = _dropped(fit)
    if left:
        texts.append("Left out: " + ", ".join(f"{count} samples ({reason})" for reason, count in left.items()) + ".")
    return tuple(texts)


def friction_data(fit: FrictionFit) -> dict[str, Any]:
    """Everything for JSON; an open end is None."""
    return {
        "parameters": {
            name: {
                "value": fit.parameters[name],
                "unit": unit,
                "interval": [json_number(x) for x in fit.intervals[name]],
                "bounded_only": name in fit.bounded,
                "at_bound": name in fit.at_bound,
            }
            for name, unit in zip(FRICTION_NAMES, FRICTION_UNITS, strict=True)
        },
        "covariance": fit.covariance.tolist(),
        "objective": "weighted least squares" if fit.weighted else "thesis Eq. 6.1",
        "residual_rms": fit.rms,
        "samples": int(fit.residuals.size),
        "effective_samples": fit.effective,
        "slowest_speed": fit.blind_below,
        "dropped": _dropped(fit),
        "remarks": list(remarks(fit)),
    }


def friction_page(
    fit: FrictionFit, thesis: FrictionFit | None, *, about: str, pictures: Mapping[str, bytes], redo: str
) -> str:
    """A self-contained page.

    Args:
        thesis: the same log by filter and Eq. 6.1, to stand beside it.
        about: data set, columns and inertia, in a line.
        pictures: caption -> SVG.
        redo: the command line that makes this page again.
    """
    parts = [heading("Friction of the shaft"), friction_table(fit), items(remarks(fit))]
    parts += [picture(svg, caption) for caption, svg in pictures.items()]
    parts += [heading("How it was found"), items(_method(fit))]
    if thesis is not None:
        parts += [
            heading("The same log by filter and Eq. 6.1"),
            friction_table(thesis),
            paragraph(_beside(), note=True),
        ]
    return page("Friction torque of the shaft over its speed", about, [*parts, heading("Do it again"), commands(redo)])


def friction_table(fit: FrictionFit) -> str:
    """A row per parameter."""
    rows = [
        [
            cell(name),
            cell("-" if name in fit.bounded else f"{fit.parameters[name]:.4f}"),
            cell(_interval(fit, name)),
            cell(unit),
            cell(_MEANING[name], "words"),
        ]
        for name, unit in zip(FRICTION_NAMES, FRICTION_UNITS, strict=True)
    ]
    caption = f"Thesis Eq. 5.38; residual {fit.rms:.3g} N.m; {fit.residuals.size} samples, worth {fit.effective:.0f}"
    return table(caption, ["", "value", "95 % interval", "unit", "meaning"], rows)


def _interval(fit: FrictionFit, name: str) -> str:
    low, high = fit.intervals[name]
    if math.isinf(high):
        return f"{'anything' if low <= 0 else f'above {low:.3g}':<18}"
    return f"{low:.4f} ... {high:.4f}"


def _dropped(fit: FrictionFit) -> dict[str, int]:
    left: dict[str, int] = {}
    for samples in fit.samples:
        for reason, count in samples.dropped:
            if count:
                left[reason] = left.get(reason, 0) + count
    return left


def _method(fit: FrictionFit) -> list[str]:
    fastest = max(float(np.abs(s.acceleration).max()) for s in fit.samples)
    return [
        "Friction is what the torque balance leaves over, T_f = T_s - T_L - J dw/dt (thesis Eq. 5.41); the "
        f"acceleration is the local slope of the speed, up to {fastest:.3g} rad/s2 here.",
        "Least squares, each sample weighted by its noise."
        if fit.weighted
        else "Least squares, every sample alike (thesis Eq. 6.1).",
        "Intervals take into account that residuals follow each other: a sandwich covariance with Bartlett's weights, "
        "Student's distribution with the effective number of samples. The interval of r is that of its profile.",
    ]


def _beside() -> str:
    return (
        "As the thesis did it: the held speed of the pulse sensor, low-passed and differentiated. The reading is late "
        "by half to one and a half of the time between pulses, so near standstill torque and speed do not belong "
        "together: the steepness found this way is that of the filter, and the intervals do not know it."
    )
