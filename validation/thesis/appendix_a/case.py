"""The wave spectrum of Eq. 1, its division into twenty intervals, and a wave (Figures 1 to 3)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from matplotlib.figure import Figure
from scipy.integrate import quad

from pysim.excitation import PiersonMoskowitz, StochasticWave
from pysim.present.style import BAND, COLOURS, TEXT, new_figure, quiet
from validation.findings import Finding
from validation.thesis.numbers import published

SEED = 1


def run() -> Iterator[Finding]:
    """Eq. 1 as printed; what it integrates to; what the sines add up to."""
    told, spectrum, wave = published(__file__), _spectrum(), _wave()
    omega = np.linspace(1.0, 20.0, 500)
    h, t = told["height"], told["period"]
    printed = 5 * np.pi**4 * h**2 / t**4 / omega**5 * np.exp(-20 * np.pi**4 / t**4 / omega**4)
    off = float(np.abs(spectrum.density(omega) - printed).max() / printed.max())
    yield Finding("spectrum against Eq. 1 as printed", off, 1e-12, "of the largest")
    area = quad(lambda w: float(spectrum.density(w)), 0, 400, points=[np.pi, 10.0], limit=500)[0]
    yield Finding("its area is (H_s/4)^2, off by", 100 * abs(area / (h / 4) ** 2 - 1), 0.01, "%")
    dense = np.linspace(2.0, 5.0, 300001)
    peak = float(dense[np.argmax(spectrum.density(dense))])
    yield Finding("its peak is at 2 pi / T_p, off by", abs(peak - 2 * np.pi / t), 2e-5, "rad/s")
    amplitude, _, omega = wave.waves().T
    width = float(np.diff(wave.edges)[0])
    yield Finding("twenty even intervals, off by", abs(amplitude.size - told["intervals"]), 0, "")
    rough = np.sqrt(2 * spectrum.density(omega) * width)  # Eq. 2
    share = 100 * abs(float((rough**2).sum() / (amplitude**2).sum()) - 1)
    yield Finding("amplitudes of Eq. 2: their variance off the spectrum's over the band", share, 3.0, "%")
    time = np.linspace(wave.onset, wave.onset + wave.repeats_after, 20001)[:-1]
    deviation = float(np.std(wave.signal().value(time)))
    expected = float(np.sqrt((amplitude**2).sum() / 2))
    yield Finding(
        "standard deviation over a repetition, off its sines' by", 100 * abs(deviation / expected - 1), 0.5, "%"
    )


def _spectrum() -> PiersonMoskowitz:
    told = published(__file__)
    return PiersonMoskowitz(told["height"], told["period"])


def _wave() -> StochasticWave:
    count = int(published(__file__)["intervals"])
    return StochasticWave(_spectrum(), 60.0, SEED, components=count, scatter=False)


def pictures() -> Mapping[str, Figure]:
    """Spectrum and intervals side by side, and the wave."""
    spectrum, wave = _spectrum(), _wave()
    omega = np.linspace(0.5, 12.0, 800)
    first = new_figure(7.2, 3.0)
    left, right = first.subplots(1, 2, sharey=True)
    edges = wave.edges
    centres = (edges[:-1] + edges[1:]) / 2
    right.bar(centres, spectrum.density(centres), np.diff(edges), color=BAND, edgecolor="white", linewidth=0.5)
    for axes in (left, right):
        quiet(axes)
        axes.plot(omega, spectrum.density(omega), color=COLOURS[0], linewidth=1.4)
        axes.set_xlim(0, 12)
        axes.set_xlabel("Frequency (rad/s)", fontsize=TEXT)
    left.set_ylabel("Spectrum (m² s/rad)", fontsize=TEXT)
    second = new_figure(7.2, 2.6)
    axes = second.subplots()
    quiet(axes)
    time = np.linspace(wave.onset, wave.onset + 50, 3000)
    axes.plot(time - wave.onset, wave.signal().value(time), color=COLOURS[0], linewidth=1.2)
    axes.set_xlim(0, 50)
    axes.set_xlabel("Time (s)", fontsize=TEXT)
    axes.set_ylabel("Wave (m)", fontsize=TEXT)
    return {
        "Figures 1 and 2 of Appendix A redone: spectrum at H_s = 10 m and T_p = 2 s, and twenty intervals.": first,
        "Figure 3 of Appendix A redone: a wave of these twenty sines; its phases are drawn.": second,
    }
