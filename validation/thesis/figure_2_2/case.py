"""Sines fitted to responses at 10 and 30 Hz (Figure 2.2), and at low and high frequency (Figure 2.3)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from pysim.bench.bench_tests import SteppedSines
from pysim.identify import SineFit, sine_fit
from pysim.present.style import COLOURS, DASHES, SMALL, TEXT, new_figure, quiet
from pysim.types import Record
from validation.findings import Finding
from validation.thesis.numbers import published
from validation.thesis.stand_in import ANGLE, COMMAND, NOTE, bench, logged

LOW, HIGH = 0.5, 20.0  # Hz, of Figure 2.3, which names none
SETTLED = 1.0  # s after the sine starts
_SIGMAS = 4.0


def notes() -> Sequence[str]:
    """What stands in."""
    return (NOTE,)


def run() -> Iterator[Finding]:
    """The fit finds what is behind the noise, and leaves next to nothing over."""
    told = published(__file__)
    for f in (told["first"], told["second"]):
        measured, clean = (_fit(_log(f, clean=clean), f) for clean in (False, True))
        sigma = np.sqrt(np.diag(measured.covariance))
        amplitude = abs(measured.amplitude - clean.amplitude) / sigma[0]
        yield Finding(f"{f:g} Hz: fitted amplitude off that without noise", float(amplitude), _SIGMAS, "deviations")
        phase = abs(np.angle(np.exp(1j * (measured.phase - clean.phase)))) / sigma[1]
        yield Finding(f"{f:g} Hz: fitted phase off that without noise", float(phase), _SIGMAS, "deviations")
        share = 2 * clean.residual**2 / clean.amplitude**2
        yield Finding(f"{f:g} Hz: variance of the noise-free response that no sine holds", 100 * share, 1.0, "%")
    gain = {f: _fit(_log(f), f).amplitude / told["amplitude"] for f in (told["reference"], LOW, HIGH)}
    yield Finding("0.1 Hz: the angle swings as its reference does, off by", 100 * abs(gain[0.1] - 1), 5.0, "%")
    yield Finding("Figure 2.3: at high frequency it swings less; more by", max(0.0, gain[HIGH] - gain[LOW]), 0, "")


def _log(frequency: float, *, clean: bool = False) -> Record:
    told = published(__file__)
    frequencies = (told["reference"], LOW, told["first"], HIGH, told["second"])
    point = ((told["offset"], told["amplitude"]),)
    data = bench([SteppedSines(COMMAND, (ANGLE,), point, frequencies, least=3.0)])
    source = data.truth.clean if clean else data.dataset
    return next(log for record, log in logged(source) if record.frequency == frequency)


def _fit(log: Record, frequency: float) -> SineFit:
    kept = log.time - log.time[0] >= SETTLED
    return sine_fit(log.time[kept], log[ANGLE][kept], frequency, origin=float(log.time[0]))


def pictures() -> Mapping[str, Figure]:
    """Reference, measurement and fit."""
    told = published(__file__)
    return {
        "Figure 2.2 redone: reference, response and fitted sine at 10 and 30 Hz.": _pair(told["first"], told["second"]),
        f"Figure 2.3 redone: at {LOW:g} and at {HIGH:g} Hz.": _pair(LOW, HIGH),
    }


def _pair(*frequencies: float) -> Figure:
    figure = new_figure(7.2, 3.2)
    for axes, f in zip(figure.subplots(1, 2, sharey=True), frequencies, strict=True):
        quiet(axes)
        log, fit = _log(f), _fit(_log(f), f)
        start = log.time[0] + SETTLED
        t = np.linspace(start, start + 2.2 / f, 600)
        shown = (log.time >= start) & (log.time <= t[-1])
        told = published(__file__)
        turn = 2 * np.pi * f * (t - log.time[0])
        reference = told["offset"] + told["amplitude"] * np.sin(turn)
        fitted = fit.offset + fit.amplitude * np.sin(turn + fit.phase)
        axes.plot(t - start, reference, color=COLOURS[2], linestyle=DASHES[1], linewidth=1.2, label="reference")
        axes.plot(log.time[shown] - start, log[ANGLE][shown], "o", color=COLOURS[1], markersize=2.6, label="measured")
        axes.plot(t - start, fitted, color=COLOURS[0], linewidth=1.4, label="fitted sine")
        axes.set_title(f"{f:g} Hz", fontsize=TEXT)
        axes.set_xlim(0, t[-1] - start)
        axes.set_xlabel("Time (s)", fontsize=TEXT)
    figure.axes[0].set_ylabel("Angle (%)", fontsize=TEXT)
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3, frameon=False, fontsize=SMALL)
    return figure
