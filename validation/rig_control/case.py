"""Every way of running the rig, the experiments of thesis Sections 6.3 and 6.4, and what they cost."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache

import numpy as np
from matplotlib.figure import Figure

from pysim.present.rig.heave import rig_error_figure, rig_heave_figure
from pysim.present.rig.steps import rig_step_figure
from pysim.rig import HeaveTest, StepTest, step_figures
from validation.findings import Finding
from validation.rig_control import experiments, ways

HEAVE = HeaveTest()
STEPS = (
    StepTest("speed", 30.0, at=2.0, length=30.0),
    StepTest("load", 40e5, speed=30.0, at=10.0, length=20.0),
)


def run() -> Iterator[Finding]:
    """Ways, steps, heave, cost."""
    yield from ways.run()
    yield from _steps()
    yield from _heave()
    yield from experiments.cost()


def pictures() -> Mapping[str, Figure]:
    """In the form of thesis Figures 6.4 to 6.8."""
    runs = experiments.heave(HEAVE)
    found = {
        "Figures 6.4 to 6.6: heave compensation under the thesis' controllers.": rig_heave_figure(
            runs["thesis"], HEAVE
        ),
        "Load-pressure error before and after.": rig_error_figure(runs),
    }
    for test, number in zip(STEPS, ("6.7", "6.8"), strict=True):
        found[f"Figure {number}, as the text numbers it: step of the {test.kind}."] = rig_step_figure(
            experiments.step(test), test
        )
    return found


def notes() -> tuple[str, ...]:
    """What stood in for what was not published."""
    return ("The sea state, the crane and the sizes of the steps are chosen; the thesis' logs are not published.",)


def _steps() -> Iterator[Finding]:
    """Section 6.4: zero steady-state error, as a number."""
    for test in STEPS:
        found = step_figures(experiments.step(test), test)
        claim = (
            f"step of the {test.kind}: overshoot {100 * found.overshoot:.0f} percent, rise {found.rise_time:.3f} s, "
            f"settling {found.settling_time:.2f} s; steady error"
        )
        yield Finding(claim, 100 * abs(found.steady_error / test.size), 0.01, "percent of the step")


def _heave() -> Iterator[Finding]:
    """Section 6.3, and what Section 6.1 proposes."""
    found = _figures()
    thesis = found["thesis"]
    yield Finding(
        f"speed off its reference by {thesis.speed_rms:.2f} rad/s rms, load pressure by "
        f"{thesis.pressure_rms / 1e5:.1f} bar; supply pressure {thesis.supply_low / 1e5:.0f} to "
        f"{thesis.supply_high / 1e5:.0f} bar; in the mean the load pressure is off by",
        _mean_pressure_error() / 1e5,
        0.1,
        "bar",
    )
    yield Finding(
        f"stiction holds the shaft for up to {thesis.held_longest:.2f} s where the reference asks for "
        f"{thesis.held_reference:.2f} s; twice of this, short of that by",
        2 * thesis.held_reference - thesis.held_longest,
        0.0,
        "s",
    )
    for plain, better in (("thesis", "compensated"), ("gain for the shaft", "both")):
        before, after = found[plain].pressure_slow_rms, found[better].pressure_slow_rms
        yield Finding(
            f"load-pressure error below 1 Hz, {plain}: {before / 1e5:.2f} bar; with the valve turned round",
            after / before,
            0.6,
            "of it",
        )
    yield Finding(
        f"load-pressure error, thesis: {thesis.pressure_rms / 1e5:.1f} bar; with the valve turned round alone",
        found["compensated"].pressure_rms / thesis.pressure_rms,
        1.0,
        "of it",
    )
    yield Finding(
        f"load-pressure error, thesis: {thesis.pressure_rms / 1e5:.1f} bar; with the gain that calms the shaft and the "
        "valve turned round",
        found["both"].pressure_rms / thesis.pressure_rms,
        0.33,
        "of it",
    )
    matlab = found["MATLAB tuned"].pressure_rms
    yield Finding(
        f"load-pressure error, MATLAB's gains: {matlab / 1e5:.1f} bar; manually tuned",
        thesis.pressure_rms / matlab,
        0.8,
        "of it",
    )


@cache
def _figures() -> Mapping[str, experiments.HeaveFigures]:
    return experiments.heave_numbers(HEAVE)


def _mean_pressure_error() -> float:
    """Pa; an integral leaves none."""
    record = experiments.heave(HEAVE)["thesis"]
    late = record.time >= HEAVE.settle
    return float(abs(np.mean((record["rig.pL"] - record["crane.pL_ref"])[late])))
