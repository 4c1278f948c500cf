"""The torque that the bench's linear friction lacks, over speed."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pysim.present.style import BAND, COLOURS, DASHES, LIMIT, TEXT, legend_above, new_figure, quiet
from pysim.types.answer import Diagnosis
from validation.rig_diagnosis.machines import truth

_FASTEST = 40.0  # rad/s, about what the tests reach


def friction_torque(values: Mapping[str, float], speed: NDArray[np.float64]) -> NDArray[np.float64]:
    """Linear friction and that of thesis Eq. 5.38, N.m, at speeds (n,) in rad/s.

    Args:
        values: `c`, and of `shaftFriction` its four numbers where the model has it.
    """
    linear = values["c"] * speed
    if "shaftFriction.tau_c" not in values:
        return np.asarray(linear)
    tau_c, tau_s, omega_0, r = (values[f"shaftFriction.{name}"] for name in ("tau_c", "tau_s", "omega_0", "r"))
    return np.asarray(linear + np.tanh(r * speed) * (tau_c + (tau_s - tau_c) * np.exp(-np.abs(speed) / omega_0)))


def friction_figure(found: Diagnosis) -> Figure:
    """Friction torque of the refitted model, of the one with the effect, and of the machine; all speeds and near 0."""
    before, after = ({one.name: one.value for one in found.history[k].estimates} for k in (1, -1))
    figure = new_figure(8.0, 3.8)
    wide, near = figure.subplots(1, 2, width_ratios=(2.0, 1.0))
    handles = {}
    for axes, fastest in ((wide, _FASTEST), (near, 0.5)):
        speed = np.linspace(-fastest, fastest, 4001)
        base, full, true = (friction_torque(values, speed) for values in (before, after, truth("shaft.friction")))
        handles["missing"] = axes.fill_between(speed, base, true, color=BAND, linewidth=0)
        (handles["the machine's"],) = axes.plot(speed, true, color=LIMIT, linewidth=4.0)
        (handles["refitted without it"],) = axes.plot(speed, base, color=COLOURS[1], linestyle=DASHES[1], linewidth=1.5)
        (handles["as it was found"],) = axes.plot(speed, full, color=COLOURS[0], linewidth=1.3)
        axes.set_xlim(-fastest, fastest)
        axes.set_xlabel("Speed of the shaft (rad/s)", fontsize=TEXT)
        quiet(axes)
    wide.set_ylabel("Friction torque (N m)", fontsize=TEXT)
    legend_above(figure, list(handles.values()), list(handles))
    return figure
