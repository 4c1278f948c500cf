"""A fitted transfer function beside its data: Bode plot, residuals, pole-zero map."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import count
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify import HALF_95
from pysim.identify.blackbox import FittedResponse, Root, TransferFunctionFit
from pysim.io import same_file
from pysim.present import style
from pysim.present.blackbox.answer import TransferFunctions
from pysim.present.render import Picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_LEVEL = 0.95
_TWO = 2.447747  # half width of a 95 percent region of two numbers, standard deviations
_FAR = 20.0  # times the highest measured frequency: roots beyond are not drawn
_FIT, _ZERO = style.COLOURS[0], style.COLOURS[1]
_LONGEST = 60  # characters of a label in a file name


def figures(result: TransferFunctions) -> Iterator[Picture]:
    """One per response."""
    for one, name in zip(result.fitted, _names([one.label for one in result.fitted]), strict=True):
        caption = f"{one.label}: gain, phase and residuals of the fit; its poles and zeros."
        yield Picture(name, caption, blackbox_figure(one))


def _names(labels: Sequence[str]) -> list[str]:
    """Names of files on any system, one per label and none twice: a test may have been repeated."""
    names: dict[str, str] = {}
    for label in labels:
        plain = "blackbox_" + re.sub(r"[^\w+.-]+", "_", label)[:_LONGEST]
        again = (plain if k == 1 else f"{plain}_{k}" for k in count(1))
        name = next(name for name in again if same_file(name) not in names)
        names[same_file(name)] = name
    return list(names.values())


def blackbox_figure(fitted: FittedResponse) -> Figure:
    """Gain (dB), phase (deg) and residuals over frequency on the left; poles and zeros on the right.

    Shaded: the 95 percent interval of the fitted curve. Bars: that of the measured points where their noise is known.
    Ellipses and bars in the map: the 95 percent region of each pole and zero.
    """
    fit = fitted.fit
    figure = style.new_figure(9.6, 6.4)
    grid = figure.add_gridspec(3, 2, width_ratios=(1.45, 1), height_ratios=(1.25, 1.25, 0.9))
    left = [figure.add_subplot(grid[0, 0])]
    left += [figure.add_subplot(grid[row, 0], sharex=left[0]) for row in (1, 2)]
    handles = _draw_bode(left[0], left[1], fitted)
    _draw_residuals(left[2], fit)
    for axes in left[:2]:
        axes.tick_params(labelbottom=False)
    style.frequency_axis(left[2], 0.94 * float(fit.data.frequency[0]), 1.06 * float(fit.data.frequency[-1]))
    left[2].set_xlabel("Frequency (Hz)")
    figure.align_ylabels(left)
    _draw_map(figure.add_subplot(grid[:, 1]), fit)
    style.legend_above(figure, list(handles.values()), list(handles))
    return figure


def _draw_bode(top: Axes, bottom: Axes, fitted: FittedResponse) -> dict[str, Any]:
    fit, measured = fitted.fit, fitted.measured
    f = measured.frequency
    dense = np.unique(np.geomspace(f[0], f[-1], 400))  # a single one where a single one was tested
    curve = fit.function.response(dense, measured.test)
    at = fit.function.response(f, measured.test)
    gain_width, phase_width = fit.band(dense, _LEVEL)
    turns = 2 * np.pi * np.round((at.phase[0] - measured.phase[0]) / (2 * np.pi))
    decibel, degrees = 20 * np.log10(curve.gain), np.degrees(curve.phase - turns)
    widths = (20 / np.log(10) * gain_width, np.degrees(phase_width))
    points = (20 * np.log10(measured.gain), np.degrees(measured.phase))
    handles: dict[str, Any] = {}
    names = ("Gain (dB)", "Phase (deg)")
    for axes, values, width, data, bars, name in zip(
        (top, bottom), (decibel, degrees), widths, points, _bars(fit), names, strict=True
    ):
        style.quiet(axes)
        band = axes.fill_between(dense, values - width, values + width, color=_FIT, alpha=0.25, linewidth=0)
        (line,) = axes.plot(dense, values, color=_FIT, linewidth=1.4)
        dots = axes.errorbar(
            f, data, yerr=bars, color=style.MEASURED, fmt="o", markersize=3.2, elinewidth=0.9, capsize=1.5
        )
        axes.set_ylabel(name)
        handles = {measured.origin: dots, f"fitted: {fit.structure.label}": line, "its 95 % interval": band}
    style.phase_axis(bottom)
    top.set_title(f"{fitted.label}, fit {fit.fit_percent:.2f} %", fontsize=style.TEXT, loc="left")
    return handles


def _bars(fit: TransferFunctionFit) -> tuple[Array | None, Array | None]:
    """Half widths of the measured points' intervals in dB and deg, from the covariance of real and imaginary part."""
    if fit.data.covariance is None:
        return None, None
    values = fit.data.values
    along = np.stack([values.real, values.imag], axis=1) / np.abs(values)[:, None]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    variances = [np.einsum("fi,fij,fj->f", d, fit.data.covariance, d) for d in (along, across)]
    sizes = [HALF_95 * np.sqrt(variance) / np.abs(values) for variance in variances]
    return 20 / np.log(10) * sizes[0], np.degrees(sizes[1])


def _draw_residuals(axes: Axes, fit: TransferFunctionFit) -> None:
    """Real and imaginary part in standard deviations, with the lines that one in twenty is beyond."""
    style.quiet(axes)
    f = fit.data.frequency
    axes.axhline(0, color=style.LIMIT, linewidth=0.8)
    for side in (-HALF_95, HALF_95):
        axes.axhline(side, color=style.LIMIT, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.plot(f, fit.standardised[:, 0], "o", color=_FIT, markersize=3.5, label="real part")
    axes.plot(f, fit.standardised[:, 1], "^", color=_ZERO, markersize=3.5, label="imaginary part")
    most = max(3.0, 1.15 * float(np.max(np.abs(fit.standardised))))
    axes.set_ylim(-most, 1.35 * most)
    axes.set_ylabel("Residual\n(std. dev.)")
    axes.legend(loc="upper left", ncols=2, frameon=False, fontsize=style.SMALL, borderaxespad=0.1, handletextpad=0.2)


def _draw_map(axes: Axes, fit: TransferFunctionFit) -> None:
    """The plane of s in rad/s; roots far beyond the measured frequencies are described in words instead."""
    style.quiet(axes)
    axes.axhline(0, color=style.LIMIT, linewidth=0.8)
    axes.axvline(0, color=style.LIMIT, linewidth=0.8)
    reach = _FAR * 2 * np.pi * float(fit.data.frequency[-1])
    drawn, edges, words = [], [], []
    for roots, marker, colour, name in ((fit.poles, "x", _FIT, "pole"), (fit.zeros, "o", _ZERO, "zero")):
        near = [root.value for root in roots if abs(root.value) <= reach]
        drawn += near
        edges += [edge for root in roots if abs(root.value) <= reach for edge in _edges(root)]
        words += [f"{name} at {_number(r.value)}" for r in roots if abs(r.value) > reach and r.value.imag >= 0]
        look: dict[str, Any] = {"color": colour, "markersize": 7, "fillstyle": "none", "linestyle": "none"}
        if near:
            axes.plot(np.real(near), np.imag(near), marker, label=name, **look)
        for root in roots:
            _draw_doubt(axes, root, fit.quantile(_LEVEL) / HALF_95, colour, reach)
    axes.set_xlabel("Real part (rad/s)")
    axes.set_ylabel("Imaginary part (rad/s)")
    axes.set_title("poles and zeros with 95 % regions", fontsize=style.TEXT, loc="left")
    _limit(axes, drawn, edges)
    if words:
        axes.text(
            0.02, 0.98, "not shown: " + ",\n".join(words), transform=axes.transAxes, va="top", fontsize=style.SMALL
        )
    if drawn:
        axes.legend(loc="lower left", frameon=False, fontsize=style.SMALL)


def _number(value: complex) -> str:
    return f"{value.real:.3g}" if value.imag == 0 else f"{value.real:.3g} ± {value.imag:.3g}j"


def _edges(root: Root) -> list[complex]:
    """Outermost points of a root's region, no further off than half its size: a larger one may leave the picture."""
    half = _TWO * np.sqrt(np.diag(root.covariance))
    real, imag = np.where(np.isfinite(half), np.minimum(half, 0.5 * abs(root.value)), 0.0)
    return [root.value + sign * step for sign in (-1, 1) for step in (real, 1j * imag)]


def _limit(axes: Axes, values: list[complex], edges: list[complex]) -> None:
    """All roots and what is near them of their regions, with the imaginary axis in sight."""
    size = max([abs(part) for v in values or [-1.0] for part in (v.real, v.imag)] + [1e-9])
    real, imag = (np.array([getattr(v, part) for v in [*values, *edges] or [-1.0]]) for part in ("real", "imag"))
    axes.set_xlim(min(1.3 * float(np.min(real)), -0.1 * size), max(1.3 * float(np.max(real)), 0.12 * size))
    high = max(1.2 * float(np.max(np.abs(imag))), 0.3 * size)
    axes.set_ylim(-high, high)


def _draw_doubt(axes: Axes, root: Root, widened: float, colour: str, reach: float) -> None:
    """An ellipse, or a bar for a real root; nothing for what the data do not determine."""
    if not np.isfinite(root.covariance).all() or abs(root.value) > reach:
        return
    if root.value.imag == 0:
        half = HALF_95 * widened * float(np.sqrt(root.covariance[0, 0]))
        axes.plot([root.value.real - half, root.value.real + half], [0, 0], color=colour, linewidth=2.4, alpha=0.45)
        return
    from matplotlib.patches import Ellipse

    sizes, directions = np.linalg.eigh(root.covariance)
    width, height = 2 * _TWO * widened * np.sqrt(np.maximum(sizes, 0))
    angle = float(np.degrees(np.arctan2(directions[1, 0], directions[0, 0])))
    centre = (root.value.real, root.value.imag)
    axes.add_patch(Ellipse(centre, width, height, angle=angle, facecolor=colour, alpha=0.25, edgecolor=colour))
