"""A test signal over time, and where its power is."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pysim.excitation import Excitation, Multisine, StochasticWave
from pysim.present.style import (
    BAND,
    COLOURS,
    MEASURED,
    TEXT,
    frequency_axis,
    legend_above,
    new_figure,
    quiet,
    size_axis,
)
from pysim.types import Signal

Array = NDArray[np.float64]

_SAMPLES = 30_000  # of a time course: the tops of a fast sine do not beat with them
_COARSE = 0.1  # of the fastest sine's period: with times further apart it folds back visibly
_LONGEST = 60.0  # s that are drawn of a command without an end
_POINTS = 2**16  # of a spectrum
_MOST = 2**22  # of one whose sines are too fast for so few
_PER_PERIOD = 2.5  # of the fastest sine, the fewest that keep it from folding back
_FEWEST = 64  # samples of it, however short it is
_HIGHEST_HZ = 1000.0  # that a spectrum resolves, or twice the fastest sine


def excitation_figure(test: Excitation, unit: str) -> Figure:
    """Time course above, amplitude spectrum of the excitation proper below, where it moves at all.

    A multisine shows the amplitude of its lines, excited and left out; anything else the square root of its power
    spectral density over the time from onset to end, and a stochastic wave the spectrum it was drawn from. A step
    stands still from its onset on: it has no such spectrum, and its time course is alone.

    Args:
        unit: of the command.
    """
    signal = test.signal()
    stop = test.duration if np.isfinite(test.duration) else test.onset + _LONGEST
    t = _times(test, stop)
    values, sampling = _samples(test, signal, min(test.end, stop))
    moves = np.ptp(values) > 0
    figure = new_figure(7.2, 5.2 if moves else 2.8)
    time_axes, *below = figure.subplots(2 if moves else 1, 1, squeeze=False)[:, 0]
    quiet(time_axes)
    time_axes.axvspan(test.onset, min(test.end, stop), color=BAND, alpha=0.35, linewidth=0)
    time_axes.plot(t, signal.value(t), color=COLOURS[0], linewidth=0.9)
    time_axes.set_xlim(0.0, stop)
    time_axes.set_xlabel("Time (s)", fontsize=TEXT)
    time_axes.set_ylabel(f"Command ({unit})", fontsize=TEXT)
    for spectrum_axes in below:
        quiet(spectrum_axes)
        spectrum_axes.set_xlabel("Frequency (Hz)", fontsize=TEXT)
        if isinstance(test, Multisine):
            _draw_lines(spectrum_axes, test, unit, figure)
        else:
            _draw_density(spectrum_axes, test, values, sampling, unit, figure)
    return figure


def _times(test: Excitation, stop: float) -> Array:
    """When the time course is drawn, (n,): uneven where even times would make slow waves of fast sines."""
    t = np.linspace(0.0, stop, _SAMPLES)
    if test.highest_hz * t[1] > _COARSE:
        t[1:-1] += t[1] * np.random.default_rng(0).uniform(-0.5, 0.5, t.size - 2)
    return t


def _samples(test: Excitation, signal: Signal, end: float) -> tuple[Array, float]:
    """Values (n,) of the command from onset to end, and how many of them a second has."""
    length, fastest = end - test.onset, test.highest_hz
    sampling = min(_POINTS / length, max(2 * _HIGHEST_HZ, 4 * fastest, _FEWEST / length))
    if not isinstance(test, Multisine):  # its lines are known
        sampling = max(sampling, _PER_PERIOD * fastest)
    count = min(int(length * sampling), _MOST)
    return signal.value(test.onset + np.arange(count) / sampling), sampling


def _draw_lines(axes: Axes, test: Multisine, unit: str, figure: Figure) -> None:
    """Amplitude of each excited line, and where lines were left out."""
    grid = test.grid
    waves = test.waves()
    f = grid.frequencies(grid.excited)
    excited = axes.vlines(f, 0.0, waves[:, 0], color=COLOURS[0], linewidth=0.9)
    handles: list[Artist] = [excited]
    labels = [f"{f.size} excited lines"]
    for lines, name, colour, marker in (
        (grid.even_detection, "even lines left out", COLOURS[4], "."),
        (grid.odd_detection, "odd lines left out", COLOURS[1], "^"),
    ):
        if lines.size:
            at = grid.frequencies(lines)
            (handle,) = axes.plot(at, np.zeros(at.size), color=colour, marker=marker, markersize=4, linestyle="none")
            handles.append(handle)
            labels.append(f"{lines.size} {name}")
    axes.set_ylim(-0.06 * waves[:, 0].max(), 1.15 * waves[:, 0].max())
    axes.set_ylabel(f"Amplitude ({unit})", fontsize=TEXT)
    legend_above(figure, handles, labels)


def _draw_density(axes: Axes, test: Excitation, values: Array, sampling: float, unit: str, figure: Figure) -> None:
    """Square root of the one-sided power spectral density of the samples, mean taken off."""
    values = values - values.mean()
    f = np.fft.rfftfreq(values.size, 1 / sampling)[1:]
    density = np.sqrt(2 / (sampling * values.size)) * np.abs(np.fft.rfft(values)[1:])
    shown = f <= max(2.0 * f[_cumulative(density**2) <= 0.999].max(initial=f[min(2, f.size - 1)]), 3 * f[0])
    (line,) = axes.plot(f[shown], density[shown], color=COLOURS[0], linewidth=0.9)
    if isinstance(test, StochasticWave):
        theory = np.sqrt(2 * np.pi * test.spectrum.density(2 * np.pi * f[shown]))
        (spectrum,) = axes.plot(f[shown], theory, color=MEASURED, linewidth=1.6)
        legend_above(figure, [line, spectrum], ["this wave", "Pierson-Moskowitz spectrum"])
    frequency_axis(axes, float(f[0]), float(f[shown][-1]))
    size_axis(axes)
    axes.set_ylim(1e-3 * density.max(), 2 * density.max())
    axes.set_ylabel(f"Amplitude density ({unit}/√Hz)", fontsize=TEXT)


def _cumulative(power: Array) -> Array:
    """Share of the power up to each place, (n,)."""
    total = np.cumsum(power)
    return np.asarray(total / total[-1])
