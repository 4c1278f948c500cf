"""The command of a stepped-sine test, step by step as Section 2.1.1 tells it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from matplotlib.figure import Figure

from pysim.excitation import SteppedSineCommand
from pysim.present.style import COLOURS, LIMIT, SMALL, TEXT, new_figure, quiet
from pysim.thesis import FREQUENCIES_HZ
from validation.findings import Finding
from validation.thesis.numbers import published

COMMAND = SteppedSineCommand(offset=50.0, amplitude=10.0, frequency=2.0, periods=6.0)


def run() -> Iterator[Finding]:
    """Rest, ramp, hold, sine, ramp."""
    told, signal = published(__file__), COMMAND.signal()
    rest = np.linspace(0, told["rest"], 101)
    yield Finding("command at rest for half a second, off zero by", float(np.abs(signal.value(rest)).max()), 1e-9, "%")
    hold = np.linspace(told["sine_starts"] - told["hold"], told["sine_starts"], 101)
    off = float(np.abs(signal.value(hold) - COMMAND.offset).max())
    yield Finding("command held for a second before the sine, off its offset by", off, 1e-9, "%")
    yield Finding("the sine starts at 2 s, off by", abs(COMMAND.onset - told["sine_starts"]), 1e-12, "s")
    t = np.linspace(COMMAND.onset, COMMAND.end, 1001)
    sine = COMMAND.offset + COMMAND.amplitude * np.sin(2 * np.pi * COMMAND.frequency * (t - told["sine_starts"]))
    yield Finding("sine of Eq. 2.1, off by", float(np.abs(signal.value(t) - sine).max()), 1e-9, "%")
    end = float(np.abs(signal.value(np.array([COMMAND.duration]))[0]))
    yield Finding("command back at zero in the end, off by", end, 1e-9, "%")
    low, high = abs(FREQUENCIES_HZ[0] - told["lowest"]), abs(FREQUENCIES_HZ[-1] - told["highest"])
    yield Finding("test frequencies from 0.1 to 30 Hz, off by", float(max(low, high)), 0, "Hz")


def pictures() -> Mapping[str, Figure]:
    """The command, and between the dashed lines what is measured."""
    figure = new_figure(7.2, 2.8)
    axes = figure.subplots()
    quiet(axes)
    t = np.linspace(0, COMMAND.duration + 0.5, 3001)
    axes.plot(t, COMMAND.signal().value(t), color=COLOURS[0], linewidth=1.4)
    for at in (COMMAND.onset, COMMAND.end):
        axes.axvline(at, color=LIMIT, linewidth=1.0, linestyle=(0, (4, 3)))
    axes.text(COMMAND.onset + 0.05, 5, "measured", fontsize=SMALL, color="#555555")
    axes.set_xlim(0, t[-1])
    axes.set_xlabel("Time (s)", fontsize=TEXT)
    axes.set_ylabel("Command of the angle (%)", fontsize=TEXT)
    return {"Figure 2.1 redone: the command of one step of a frequency response test.": figure}
