"""A test signal, shown: text, figure and page; over time, and where its power is."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pysim.excitation import Excitation, Multisine, StochasticWave
from pysim.present.page import heading, items, pictures
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing, Picture
from pysim.present.style import BAND, COLOURS, MEASURED, frequency_axis, legend_above, panels, size_axis
from pysim.types import Signal

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_SAMPLES = 30_000  # of a time course: the tops of a fast sine do not beat with them
_COARSE = 0.1  # of the fastest sine's period: with times further apart it folds back visibly
_LONGEST = 60.0  # s that are drawn of a command without an end
_POINTS = 2**16  # of a spectrum
_MOST = 2**22  # of one whose sines are too fast for so few
_PER_PERIOD = 2.5  # of the fastest sine, the fewest that keep it from folding back
_FEWEST = 64  # samples of it, however short it is
_HIGHEST_HZ = 1000.0  # that a spectrum resolves, or twice the fastest sine


@dataclass(frozen=True)
class Played:
    """A test signal in a file.

    Args:
        file: that a bench plays.
        kind: such as "stepped-sine".
        about: what that is, in a phrase.
        test: the signal.
        unit: of the command.
        sampling_hz: rows per second of the file.
        settings: the line that makes it again, with all of them.
    """

    file: Path
    kind: str
    about: str
    test: Excitation
    unit: str
    sampling_hz: float
    settings: str


def text(result: Played) -> str:
    """What the file is, and what is in it."""
    return "\n".join([f"{result.file}: {result.about}", *(f"  {fact}" for fact in _facts(result))])


def figures(result: Played) -> Iterator[Picture]:
    """Time course and spectrum."""
    figure = excitation_figure(result.test, result.unit)
    spectrum = ", and its spectrum" if len(figure.axes) > 1 else ""
    caption = f"The command over time, the excitation proper shaded{spectrum}."
    yield Picture(result.kind.replace("-", "_"), caption, figure)


def page(result: Played, drawings: Sequence[Drawing], redo: str) -> str:
    """What is played, the picture, and the settings."""
    parts = [heading("What is played"), items(_facts(result)), *pictures(drawings)]
    return whole_page(f"Test signal: {result.kind}", result.about, parts, result.settings)


def _facts(result: Played) -> list[str]:
    """What a person at the bench wants to know before it is played: levels, jumps, and the speed between these."""
    test, unit, sampling, signal = result.test, result.unit, result.sampling_hz, result.test.signal()
    t = np.arange(max(1, math.floor((test.end - test.onset) * sampling))) / sampling + test.onset
    value, fastest = signal.value(t), float(np.abs(signal.derivative(t)).max())
    facts = [f"excitation from {test.onset:g} to {test.end:g} s, {test.duration:g} s in all"]
    if np.ptp(value) > 0:
        levels = f"from {value.min():.4g} to {value.max():.4g} {unit}"
        facts.append(f"mean {value.mean():.4g} {unit}, rms about it {value.std():.4g} {unit}, {levels}")
    jumped = [f"at {at:g} s from {before:.4g} to {behind:.4g} {unit}" for at, before, behind in jumps(signal)]
    facts += [f"jumps {', '.join(jumped)}"] if jumped else []
    shown = f", its fastest sine in {sampling / test.highest_hz:.3g} rows per period" if test.highest_hz else ""
    return facts + ([f"fastest {fastest:.4g} {unit}/s{shown}"] if fastest > 0 else [])


def jumps(signal: Signal) -> list[tuple[float, float, float]]:
    """Time in s, value before and value behind, wherever the command jumps."""
    at = signal.starts[1:]
    before, behind = signal.value(np.nextafter(at, -np.inf)), signal.value(at)
    there = np.abs(behind - before) > 1e-6 * np.abs([before, behind]).max(initial=0.0)
    return list(zip(at[there].tolist(), before[there].tolist(), behind[there].tolist(), strict=True))


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
    figure, axes = panels(7.2, 5.2 if moves else 2.8, 2 if moves else 1)
    time_axes, *below = axes[:, 0]
    time_axes.axvspan(test.onset, min(test.end, stop), color=BAND, alpha=0.35, linewidth=0)
    time_axes.plot(t, signal.value(t), color=COLOURS[0], linewidth=0.9)
    time_axes.set(xlabel="Time (s)", ylabel=f"Command ({unit})", xlim=(0.0, stop))
    for spectrum_axes in below:
        spectrum_axes.set_xlabel("Frequency (Hz)")
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
    most = waves[:, 0].max()
    axes.set(ylabel=f"Amplitude ({unit})", ylim=(-0.06 * most, 1.15 * most))
    legend_above(figure, handles, labels)


def _draw_density(axes: Axes, test: Excitation, values: Array, sampling: float, unit: str, figure: Figure) -> None:
    """Square root of the one-sided power spectral density of the samples, mean taken off."""
    values = values - values.mean()
    f = np.fft.rfftfreq(values.size, 1 / sampling)[1:]
    density = np.sqrt(2 / (sampling * values.size)) * np.abs(np.fft.rfft(values)[1:])
    power = np.cumsum(density**2)
    shown = f <= max(2.0 * f[power <= 0.999 * power[-1]].max(initial=f[min(2, f.size - 1)]), 3 * f[0])
    (line,) = axes.plot(f[shown], density[shown], color=COLOURS[0], linewidth=0.9)
    if isinstance(test, StochasticWave):
        theory = np.sqrt(2 * np.pi * test.spectrum.density(2 * np.pi * f[shown]))
        (spectrum,) = axes.plot(f[shown], theory, color=MEASURED, linewidth=1.6)
        legend_above(figure, [line, spectrum], ["this wave", "Pierson-Moskowitz spectrum"])
    frequency_axis(axes, float(f[0]), float(f[shown][-1]))
    size_axis(axes)
    axes.set(ylabel=f"Amplitude density ({unit}/√Hz)", ylim=(1e-3 * density.max(), 2 * density.max()))
