"""`python -m validation.ripple.pictures FOLDER`: thesis Fig. 4.9 and 4.11 redone, and what takes the ripple away."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pysim.present.render import render
from pysim.present.style import COLOURS, DASHES, LIMIT, MARKERS, SMALL, TEXT, new_figure, quiet
from pysim.types import Record
from validation.ripple import hose, relief
from validation.ripple.line import Hose

LITRES = 60e3  # l/min of m3/s
SHOWN = 5.5 / hose.STROKES  # s


def hose_picture() -> Figure:
    """Flow before and after the hose, and what a line lets through over frequency."""
    figure = new_figure(7.2, 3.4)
    left, right = figure.subplots(1, 2)
    _flows(left, hose.measured(), hose.measured(1))
    _passed(right, float(hose.measured()["before.Q"].mean()))
    return figure


def _flows(axes: Axes, record: Record, single: Record) -> None:
    shown = record.time < record.time[0] + SHOWN
    t = 1e3 * (record.time - record.time[0])[shown]
    curves = (
        ("pump", record["before.Q"], COLOURS[0]),
        ("after 32 segments", record["after.Q"], COLOURS[1]),
        ("after 1 segment", single["after.Q"], COLOURS[2]),
    )
    quiet(axes)
    for (name, flow, colour), dash in zip(curves, DASHES, strict=False):
        axes.plot(t, LITRES * flow[shown], color=colour, linestyle=dash, linewidth=1.4, label=name)
    axes.set_xlim(0, t[-1])
    axes.set_ylim(50.5, 52.1)
    axes.set_xlabel("Time (ms)", fontsize=TEXT)
    axes.set_ylabel("Flow (l/min)", fontsize=TEXT)
    axes.legend(fontsize=SMALL, frameon=False, loc="upper left", ncols=2, handlelength=1.8, columnspacing=1.0)


def _passed(axes: Axes, flow: float) -> None:
    hertz = np.linspace(20, 700, 1500)
    quiet(axes)
    for lag, colour, dash in zip(hose.LAGS, COLOURS, DASHES, strict=False):
        share = Hose().with_lag(lag).passed(hertz, flow)
        factor = 2 * np.pi * hose.STROKES * lag
        axes.semilogy(hertz, share, color=colour, linestyle=dash, linewidth=1.2, label=f"loss factor {factor:.2f}")
    one = Hose().passed_by_segments(1, hertz, flow)
    axes.semilogy(hertz, one, color=LIMIT, linewidth=1.2, label="1 segment, 0.27")
    axes.axvline(hose.STROKES, color=LIMIT, linewidth=0.8)
    axes.text(hose.STROKES + 6, 0.0022, "435 Hz", fontsize=SMALL, color="#555555")
    axes.plot(hose.STROKES, hose.passed(hose.measured()), MARKERS[0], color="black", markersize=4.5, label="FMU")
    axes.plot(hose.STROKES, hose.passed(hose.measured(lag=5e-5)), MARKERS[0], color="black", markersize=4.5)
    axes.plot(hose.STROKES, hose.passed(hose.measured(1)), MARKERS[0], color="black", markersize=4.5)
    axes.set_xlim(0, 700)
    axes.set_ylim(2e-3, 200)
    axes.set_xlabel("Frequency (Hz)", fontsize=TEXT)
    axes.set_ylabel("Ripple that arrives, over that of the pump (1)", fontsize=TEXT)
    axes.legend(fontsize=SMALL, frameon=False, loc="upper left", ncols=2, handlelength=1.8, columnspacing=1.0)


def cause_picture() -> Figure:
    """What arrives between 1300 and 1600 rpm, by what could have taken it away."""
    flow, hertz = float(hose.measured()["before.Q"].mean()), hose.NEAR
    segments = [Hose().with_lag(0.0).passed_by_segments(n, hertz, flow) for n in (4, 2, 1)]
    rows = {f"{n} segment{'s' if n > 1 else ''}": share for n, share in zip((4, 2, 1), segments, strict=True)}
    rows |= {"70 MPa and a loss factor of 0.27": hose.damped().passed(hertz, flow)}
    rows |= {words: line.passed(hertz, flow) for words, (line, _) in reversed(list(hose.causes().items()))}
    rows |= {"none": Hose().with_lag(0.0).passed(hertz, flow)}
    figure = new_figure(7.2, 3.2)
    axes = figure.subplots()
    quiet(axes)
    for place, share in enumerate(rows.values()):
        hidden = float(share.max()) <= hose.UNSEEN
        axes.plot([share.min(), share.max()], [place, place], color=COLOURS[1 if hidden else 0], linewidth=6)
    axes.axvline(hose.UNSEEN, color=LIMIT, linewidth=0.8, linestyle=DASHES[1])
    axes.text(0.9 * hose.UNSEEN, len(rows) - 1, "a line's width", fontsize=SMALL, color="#555555", ha="right")
    axes.set_xscale("log")
    axes.set_yticks(range(len(rows)), list(rows), fontsize=SMALL)
    axes.set_xlabel("Ripple that arrives, over that of the pump, 390 to 480 Hz (1)", fontsize=TEXT)
    return figure


def relief_picture() -> Figure:
    """Opening over time with ripple and without, and its swing over the valve's natural frequency."""
    figure = new_figure(7.2, 3.4)
    left, right = figure.subplots(1, 2)
    record = relief.run(whole=True)
    quiet(left)
    for name, label, colour in (("valve1", "with ripple", COLOURS[0]), ("valve2", "without", COLOURS[1])):
        left.plot(record.time, 100 * record[f"{name}.opening"], color=colour, linewidth=0.8, label=label)
    for end in relief.FIGURE_4_11:
        left.axhline(100 * end, color=LIMIT, linewidth=0.8, linestyle=(0, (4, 3)))
    left.text(0.3, 100 * relief.FIGURE_4_11[1] + 0.6, "ends in the thesis", fontsize=SMALL, color="#555555", ha="right")
    left.set_xlim(0, 0.3)
    left.set_ylim(0, 60)
    left.set_xlabel("Time (s)", fontsize=TEXT)
    left.set_ylabel("Opening (%)", fontsize=TEXT)
    left.legend(fontsize=SMALL, frameon=False, loc="lower right")
    _swings(right)
    return figure


def _swings(axes: Axes) -> None:
    hertz = np.concatenate([np.arange(300, 430, 20), [425, 430, 435, 440, 445, 450], np.arange(460, 1000, 30)])
    runs = [relief.run(1 / f) for f in hertz]
    quiet(axes)
    for (name, label, colour), marker in zip(
        (("valve1", "with ripple", COLOURS[0]), ("valve2", "without", COLOURS[1])), MARKERS, strict=False
    ):
        swing = [max(100 * np.ptp(record[f"{name}.opening"]), 1e-5) for record in runs]
        axes.semilogy(hertz, swing, color=colour, marker=marker, markersize=3, linewidth=1.0, label=label)
    axes.axvline(hose.STROKES, color=LIMIT, linewidth=0.8)
    axes.text(hose.STROKES + 8, 100, "435 Hz", fontsize=SMALL, color="#555555")
    axes.text(298, 2e-3, "swings by\nitself", fontsize=SMALL, color="#555555")
    axes.set_xlim(290, 1000)
    axes.set_xlabel("Natural frequency of the valve (Hz)", fontsize=TEXT)
    axes.set_ylabel("Swing of the opening, end to end (%)", fontsize=TEXT)
    axes.legend(fontsize=SMALL, frameon=False, loc="center right")


def main(folder: Path) -> None:
    """Write both pictures."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "hose.png").write_bytes(render(hose_picture(), "png"))
    (folder / "causes.png").write_bytes(render(cause_picture(), "png"))
    (folder / "relief.png").write_bytes(render(relief_picture(), "png"))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
