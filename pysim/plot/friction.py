"""Friction torque over speed: what was measured, what was fitted, and where nobody could see."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pysim.identify.friction import FrictionFit, friction_slopes, friction_torque
from pysim.plot.style import BAND, COLOURS, LIMIT, MEASURED, TEXT, legend_above, new_figure, quiet

Array = NDArray[np.float64]

_STEEP = 1e3  # s/rad, drawn for a steepness without an upper end


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
        bottom.set_xlabel("Speed (rad/s)", fontsize=TEXT)
    axes["all"].set_ylabel("Friction torque (N m)", fontsize=TEXT)
    axes["rest"].set_ylabel("Measured - fitted (N m)", fontsize=TEXT)
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
