"""Steady flow over the command, theoretical and of the pump block (Figure 4.1)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from pysim.present.style import COLOURS, DASHES, LIMIT, SMALL, TEXT, new_figure, quiet
from pysim.types import Record
from validation.findings import Finding
from validation.pump_flow.case import swept
from validation.pump_flow.kinematics import LITRES, Geometry
from validation.thesis.figure_4_1 import flow_test
from validation.thesis.figure_4_1.flow_test import DRIVE, PRINTED, RPM, STROKE, SYNCHRONOUS
from validation.thesis.numbers import published


def notes() -> Sequence[str]:
    """What stands in."""
    return (
        "The measured curves were not published; of them the text says that they are somewhat steeper than the "
        "theoretical flow, and end near 95 %. The pump block stands in: it ends there, and is not steeper.",
        f"The flow test is simulated: a drive at {DRIVE:g} rpm, a stop at {STROKE:g} of the stroke, noise of 0.3 % of "
        "the largest flow. That the drive and the stop come back is shown; what they were on the thesis' bench is not.",
    )


def run() -> Iterator[Finding]:
    """The end of the flow, and the way there."""
    told, record = published(__file__), swept()
    flow, theory, command = record["pump.QActual"], record["Q_theory"], record["pump.alphaCMD"]
    share = 100 * float(flow.max()) / Geometry().mean
    yield Finding(f"flow ends at {share:.1f} % of the largest, off the printed by", abs(share - told["stop"]), 0.5, "%")
    inside = np.abs(command) < told["stop"] - 1
    off = 100 * float(np.abs(flow - theory)[inside].max()) / Geometry().mean
    yield Finding("before, off the theoretical flow by", off, told["accuracy"], "% (what the sensors were good for)")
    yield from _mechanical_stop()
    yield from _identified()
    yield from _what_flow_cannot_tell(told["accuracy"])


def _mechanical_stop() -> Iterator[Finding]:
    """The flow stops rising where the piston's stop begins to push, wherever that is."""
    for stroke in (0.90, STROKE):
        record = flow_test.sweep(stroke, 80.0, 100.0)
        exact = 100 * np.rad2deg(np.arctan(stroke * np.tan(np.deg2rad(15)))) / 15
        end, touch = flow_test.end_of_rise(record), flow_test.contact(record)
        yield Finding(
            f"stop at {stroke:g} of the stroke: rise ends at {end:.1f} %, the stop pushes from {touch:.1f} %; apart",
            abs(end - touch),
            0.2,
            "% of the command",
            alternative="a limit of the command or of the flow ends the rise while no stop pushes",
            source="two samples of the command, 0.1 % each",
        )
        share = 100 * float(record["Q"].max()) / (Geometry().mean * DRIVE / PRINTED)
        yield Finding(
            f"stop at {stroke:g} of the stroke: the flow ends at {share:.2f} %; off arctan({stroke:g} tan 15 deg) by",
            abs(share - exact),
            0.1,
            "%",
            source="the stop gives way by 7 um under the cylinder's force, 0.03 %; the rest is the solver's",
        )
    whole = flow_test.sweep(1.0, 80.0, 100.0)
    yield Finding(
        "whole stroke: the flow rises to the end of the command, short of it by",
        100.0 - flow_test.end_of_rise(whole),
        0.0,
        "%",
        alternative="something else than the stop ends the rise",
    )


def _identified() -> Iterator[Finding]:
    """Drive and stop from the two flow meters' logs, and what is left where one of them is held."""
    both = flow_test.fitted("omega", "pump.stroke_share")
    for name, true, factor, unit, narrow in (
        ("omega", DRIVE, RPM, "rpm", 5.0),
        ("pump.stroke_share", STROKE, 1.0, "", 0.005),
    ):
        one = both[name]
        low, high = (factor * end for end in one.interval)
        text = f"{name} {factor * one.value:.5g} {unit} ({low:.5g} to {high:.5g}), true {true:g}".replace("  ", " ")
        off = abs(factor * one.value - true) / (0.5 * (high - low))
        yield Finding(f"{text}; off by", off, 2.0, "half widths", source="beyond by chance once in 10,000")
        yield Finding(f"{name}: half width of its 95 % interval", 0.5 * (high - low), narrow, unit)
    low = RPM * both["omega"].interval[0]
    yield Finding(
        f"the drive's interval begins {low - PRINTED:.1f} rpm above {PRINTED:g} rpm; short of that by",
        max(0.0, PRINTED - low),
        0.0,
        "rpm",
        alternative="1450 rpm explain the slope too",
    )
    for held, name in (("drive held at 1450 rpm", "pump.stroke_share"), ("no stop", "omega")):
        left = flow_test.fitted(name).misfit
        yield Finding(
            f"{held}: {left:.2f} times the noise is left; short of 1.5 by",
            max(0.0, 1.5 - left),
            0.0,
            "times the noise",
            alternative="one of the two explains the log alone",
        )


def _what_flow_cannot_tell(accuracy: float) -> Iterator[Finding]:
    """Speed and displacement act as a product; a meter's own scale error is as large as what a drive can add."""
    three = flow_test.fitted("omega", "pump.stroke_share", "pump.V_d_max")
    yield Finding(
        "drive and displacement both free: directions that the flow does not determine, short of one by",
        max(0.0, 1.0 - len(three.undetermined)),
        0.0,
        "",
        alternative="the flow tells a faster drive from a larger displacement",
    )
    most = 100 * (SYNCHRONOUS / PRINTED - 1)
    yield Finding(
        f"a drive below {SYNCHRONOUS:g} rpm makes the slope steeper by {most:.2f} % at most; two meters of "
        f"{accuracy:g} % may differ by",
        most,
        2 * accuracy,
        "%",
        alternative="a steeper slope is seen that meters of this accuracy cannot feign",
        source="Appendix D.7: twice the meters' accuracy",
    )


def pictures() -> Mapping[str, Figure]:
    """Both curves; grey: what neither sensor saw."""
    record, told = swept(), published(__file__)
    order = np.argsort(record["pump.alphaCMD"])
    command = record["pump.alphaCMD"][order]
    figure = new_figure(7.2, 3.2)
    axes = figure.subplots()
    quiet(axes)
    axes.axhspan(told["small_sensor"], told["large_sensor"], color="#ececec", label="seen by neither flow sensor")
    axes.plot(command, LITRES * record["Q_theory"][order], color=LIMIT, linewidth=1.4, label="theoretical")
    flow = LITRES * record["pump.QActual"][order]
    axes.plot(command, flow, color=COLOURS[0], linestyle=DASHES[1], linewidth=1.4, label="pump block, 1450 rpm")
    for log in flow_test.logged().records:
        values = log.data
        assert isinstance(values, Record)
        label = f"flow test, {DRIVE:g} rpm" if values["alphaCMD"][0] < 10 else None
        axes.plot(values["alphaCMD"], LITRES * values["Q"], ".", color=COLOURS[1], markersize=1.5, label=label)
    found = flow_test.fitted("omega", "pump.stroke_share")["omega"].value * RPM / PRINTED
    slope = LITRES * Geometry().mean * found / 100
    axes.plot(
        [0, 100], [0, 100 * slope], color=COLOURS[2], linestyle=DASHES[2], linewidth=1.0, label="its drive, no stop"
    )
    axes.set_xlim(0, 100)
    axes.set_ylim(0, 115)
    axes.set_xlabel("Command of the angle (%)", fontsize=TEXT)
    axes.set_ylabel("Flow (l/min)", fontsize=TEXT)
    axes.legend(frameon=False, fontsize=SMALL)
    return {"Figure 4.1 redone: steady flow without load; the pump block stands in for the measurement.": figure}
