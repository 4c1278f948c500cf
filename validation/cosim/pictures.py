"""Pictures of the case."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from pysim.present.style import COLOURS, DASHES, MARKERS, TEXT, legend_above, new_figure, quiet
from validation.cosim.bench import TIMES, coupled, monolithic
from validation.cosim.oscillators import STEPS, errors

_RIG = (("omegaS", "Speed by pulses in rad/s", 1.0), ("pL", "Load pressure in bar", 1e-5))


def order_figure() -> Figure:
    """Errors over the step, both logarithmic."""
    figure = new_figure(7.0, 3.2)
    parts = figure.subplots(1, 2)
    for number, (name, found) in enumerate(errors().items()):
        for axes, values in zip(parts, found, strict=True):
            # Curves may lie on each other: hollow markers of shrinking size, dashes for the later ones.
            axes.loglog(
                1e3 * np.array(STEPS), values, marker=MARKERS[number], linestyle=DASHES[number], color=COLOURS[number],
                markersize=8 - number, markerfacecolor="none", linewidth=1.2, label=name,
            )  # fmt: skip
    for axes, text in zip(parts, ("Largest error in m", "Energy made by the coupling in J"), strict=True):
        quiet(axes)
        axes.set_xlabel("Communication step in ms", fontsize=TEXT)
        axes.set_ylabel(text, fontsize=TEXT)
        axes.set_xticks([1, 2, 4, 8], ["1", "2", "4", "8"])
        axes.minorticks_off()
    legend_above(figure, *parts[0].get_legend_handles_labels())
    return figure


def bench_figure() -> Figure:
    """Both runs, and their difference as a share of the signal's range."""
    figure = new_figure(7.0, 4.6)
    parts = figure.subplots(2, 2, sharex=True)
    for row, (name, text, factor) in zip(parts.T, _RIG, strict=True):
        known = monolithic()[f"rig.{name}"]
        row[0].plot(TIMES, factor * known, color=COLOURS[0], label="monolithic", linewidth=2)
        row[0].plot(TIMES, factor * coupled()[f"rig.{name}"], color=COLOURS[1], linestyle=DASHES[1],
                    label="co-simulation")  # fmt: skip
        row[0].set_ylabel(text, fontsize=TEXT)
        for number, interface in enumerate(("model-exchange", "co-simulation")):
            off = np.abs(coupled(2, interface)[f"rig.{name}"] - known) / np.ptp(known)
            row[1].semilogy(TIMES, np.maximum(off, 1e-17), color=COLOURS[1 + number], linewidth=0.8,
                            label=("by model exchange", "by the FMU's integrator")[number])  # fmt: skip
        row[1].set_ylabel("Difference, of the range", fontsize=TEXT)
        row[1].set_xlabel("Time in s", fontsize=TEXT)
        for axes in row:
            quiet(axes)
    both = [axes.get_legend_handles_labels() for axes in parts[:, 0]]
    legend_above(figure, *(both[0][part] + both[1][part] for part in (0, 1)))
    return figure
