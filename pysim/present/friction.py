"""The friction of a shaft, shown: text, JSON, figure and page."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify.friction import (
    FRICTION_NAMES,
    FRICTION_UNITS,
    FrictionFit,
    ShaftColumns,
    friction_slopes,
    friction_torque,
)
from pysim.present.page import heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.plain_text import wrapped
from pysim.present.render import Drawing, Picture
from pysim.present.style import BAND, COLOURS, LIMIT, MEASURED, legend_above, new_figure, quiet
from pysim.types.json_number import json_data

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_MEANING = {
    "r": "steepness at standstill",
    "omega_0": "speed over which stiction fades",
    "tau_c": "Coulomb friction",
    "tau_s": "stiction",
}
_STEEP = 1e3  # s/rad, drawn for a steepness without an upper end


_BESIDE = (
    "As the thesis did it: the held speed of the pulse sensor, low-passed and differentiated. The reading is late "
    "by half to one and a half of the time between pulses, so near standstill torque and speed do not belong "
    "together: the steepness found this way is that of the filter, and the intervals do not know it."
)


@dataclass(frozen=True)
class Friction:
    """What was found.

    Args:
        fit: by the pulses of the sensor, or by the filter where there are none.
        by_filter: the same log by filter and Eq. 6.1, to stand beside it.
        dataset: its name, or its folder.
        columns: that were used.
        inertia: of motors and shaft, kg.m2.
    """

    fit: FrictionFit
    by_filter: FrictionFit | None
    dataset: str
    columns: ShaftColumns
    inertia: float


def text(result: Friction) -> str:
    """A row per parameter with its 95 percent interval, then what the data do not tell."""
    fit = result.fit
    lines = ["  parameter     value   95 % interval"]
    for name, unit in zip(FRICTION_NAMES, FRICTION_UNITS, strict=True):
        lines.append(f"  {name:<9}{_value(fit, name):>10}   {_interval(fit, name)} {unit:<6} {_MEANING[name]}")
    lines.append(
        f"  residual {fit.rms:.3g} N.m, {fit.residuals.size} samples worth {fit.effective:.0f} independent ones"
    )
    return "\n".join([*lines, *(line for remark in _remarks(fit) for line in wrapped(remark, width=78))])


def data(result: Friction) -> dict[str, Any]:
    """Everything for JSON; an open end is None."""
    by_filter = None if result.by_filter is None else _data(result.by_filter)
    return json_data({**_data(result.fit), "by_filter": by_filter})


def figures(result: Friction) -> Iterator[Picture]:
    """The law over the measured torque."""
    caption = "Friction torque over speed, all speeds and those near standstill; grey: speeds that no sample has."
    yield Picture("friction", caption, friction_figure(result.fit))


def page(result: Friction, drawings: Sequence[Drawing], redo: str) -> str:
    """The parameters, the picture, how they were found, and what the thesis' way gives."""
    fit, thesis, columns = result.fit, result.by_filter, result.columns
    load = f" and {columns.load}" if columns.load else ""
    lead = f"{result.dataset}: {columns.speed} against {columns.supply}{load}, inertia {result.inertia:g} kg.m2."
    parts = [heading("Friction of the shaft"), _table(fit), items(_remarks(fit)), *pictures(drawings)]
    parts += [heading("How it was found"), items(_method(fit))]
    if thesis is not None:
        parts += [heading("The same log by filter and Eq. 6.1"), _table(thesis), paragraph(_BESIDE, note=True)]
    return whole_page("Friction torque of the shaft over its speed", lead, parts, redo)


def _data(fit: FrictionFit) -> dict[str, Any]:
    found = {
        name: {"value": fit.parameters[name], "unit": unit, "interval": fit.intervals[name],
               "bounded_only": name in fit.bounded, "at_bound": name in fit.at_bound}
        for name, unit in zip(FRICTION_NAMES, FRICTION_UNITS, strict=True)
    }  # fmt: skip
    return {
        "parameters": found,
        "covariance": fit.covariance,
        "objective": "weighted least squares" if fit.weighted else "thesis Eq. 6.1",
        "residual_rms": fit.rms,
        "samples": int(fit.residuals.size),
        "effective_samples": fit.effective,
        "slowest_speed": fit.blind_below,
        "dropped": _dropped(fit),
        "remarks": list(_remarks(fit)),
    }


def _remarks(fit: FrictionFit) -> tuple[str, ...]:
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


def _table(fit: FrictionFit) -> str:
    """A row per parameter."""
    rows = [
        [name, _value(fit, name), _interval(fit, name), unit, _MEANING[name]]
        for name, unit in zip(FRICTION_NAMES, FRICTION_UNITS, strict=True)
    ]
    caption = f"Thesis Eq. 5.38; residual {fit.rms:.3g} N.m; {fit.residuals.size} samples, worth {fit.effective:.0f}"
    return table(caption, ["", "value", "95 % interval", "unit", "meaning"], rows, words=[4])


def _value(fit: FrictionFit, name: str) -> str:
    return "-" if name in fit.bounded else f"{fit.parameters[name]:.4f}"


def _interval(fit: FrictionFit, name: str) -> str:
    low, high = fit.intervals[name]
    if math.isinf(high):
        return f"{'anything' if low <= 0 else f'above {low:.3g}':<18}"
    return f"{low:.4f} ... {high:.4f}"


def _dropped(fit: FrictionFit) -> dict[str, int]:
    left = Counter[str]()
    for samples in fit.samples:
        for reason, count in samples.dropped:
            left[reason] += count
    return dict(+left)


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


def friction_figure(fit: FrictionFit) -> Figure:
    """All speeds, those near standstill, and the residuals over speed, from left to right and below.

    Grey field: speeds no sample has. The fan in it is what the interval of the steepness leaves open there.
    """
    figure = new_figure(9.0, 6.2)
    axes = figure.subplot_mosaic([["all", "near"], ["rest", "close"]], height_ratios=(2.4, 1.0))
    fastest = max(float(np.abs(s.speed).max()) for s in fit.samples)
    near = min(max(3.0 * fit.blind_below, 0.5), fastest)
    for top, bottom, reach in ((axes["all"], axes["rest"], 1.04 * fastest), (axes["near"], axes["close"], near)):
        handles = _draw_curve(top, fit, reach)
        _draw_residuals(bottom, fit, reach)
        bottom.set_xlabel("Speed (rad/s)")
    axes["all"].set_ylabel("Friction torque (N m)")
    axes["rest"].set_ylabel("Measured - fitted (N m)")
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _draw_curve(axes: Axes, fit: FrictionFit, reach: float) -> dict[str, Any]:
    """Samples, fitted law with its band, blind zone; label -> artist."""
    quiet(axes)
    speed = np.linspace(-reach, reach, 2001)
    handles: dict[str, Any] = {"no sample": _blind(axes, fit)}
    for samples in fit.samples:
        seen = np.abs(samples.speed) <= reach
        (dots,) = axes.plot(
            samples.speed[seen], samples.torque[seen], ".", color=MEASURED, markersize=2.5, alpha=0.35, rasterized=True
        )
    handles["measured"] = dots
    torque, half = friction_torque(fit.vector, speed), _half_width(fit, speed)
    low, high = _open_ends(fit, speed)
    band = axes.fill_between(
        speed,
        np.minimum(torque - half, low),
        np.maximum(torque + half, high),
        color=COLOURS[0],
        alpha=0.25,
        linewidth=0,
    )
    (line,) = axes.plot(speed, torque, color=COLOURS[0], linewidth=1.5)
    handles |= {"fitted, Eq. 5.38": line, "95 % band": band}
    axes.set_xlim(-reach, reach)
    return handles


def _blind(axes: Axes, fit: FrictionFit) -> Any:
    """The field of speeds that no sample has, on each side up to its own slowest sample."""
    speeds = np.concatenate([samples.speed for samples in fit.samples])
    backward, forward = speeds[speeds < 0], speeds[speeds > 0]
    left = float(backward.max()) if backward.size else float(speeds.min()) if speeds.size else 0.0
    right = float(forward.min()) if forward.size else 0.0
    return axes.axvspan(min(left, 0.0), max(right, 0.0), color=BAND, alpha=0.55, linewidth=0)


def _half_width(fit: FrictionFit, speed: Array) -> Array:
    """Of the 95 percent band by the covariance, N.m; Student's, with the freedom that `fit.intervals` count."""
    slopes = friction_slopes(fit.vector, speed)
    return fit.quantile * np.sqrt(np.maximum(np.einsum("ni,ij,nj->n", slopes, fit.covariance, slopes), 0.0))


def _open_ends(fit: FrictionFit, speed: Array) -> tuple[Array, Array]:
    """Lowest and highest law within the interval of the steepness."""
    low, high = fit.intervals["r"]
    curves = [
        friction_torque(np.append(r, fit.vector[1:]), speed)
        for r in (max(low, 1e-6), min(high, _STEEP), fit.parameters["r"])
    ]
    return np.min(curves, axis=0), np.max(curves, axis=0)


def _draw_residuals(axes: Axes, fit: FrictionFit, reach: float) -> None:
    quiet(axes)
    _blind(axes, fit)
    speed = np.concatenate([samples.speed for samples in fit.samples])
    seen = np.abs(speed) <= reach
    axes.plot(speed[seen], fit.residuals[seen], ".", color=MEASURED, markersize=2.5, alpha=0.35, rasterized=True)
    axes.axhline(0.0, color=LIMIT, linewidth=0.9)
    axes.set_xlim(-reach, reach)
