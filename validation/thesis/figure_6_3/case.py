"""Friction of both motors measured on the virtual bench and fitted (Figure 6.3), against Table 6.2."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache

from matplotlib.figure import Figure

import fmu_build
from pysim.identify.friction import FRICTION_NAMES, FRICTION_UNITS, FrictionFit, fit_friction, pulse_samples
from pysim.io import read_model
from pysim.present.friction import friction_figure
from validation.findings import Finding
from validation.friction.case import INERTIA, _measured, _simulated
from validation.thesis.numbers import published

_SEED = 3


def notes() -> Sequence[str]:
    """What stands in."""
    return (
        "The measured torques were never published. A driven shaft with the friction of Table 6.2 stands in, with the "
        "bench's ten pulses per revolution and noise of the pressures: the method finds the printed numbers again.",
        "Pulses tell r from below only, as none comes at standstill: its interval has no upper end. What a "
        "filter makes of it is shown by the case `friction`.",
    )


def run() -> Iterator[Finding]:
    """Every parameter within two half widths of its interval, one draw."""
    told, fit = published(__file__), _fit()
    for name, unit in zip(FRICTION_NAMES[1:], FRICTION_UNITS[1:], strict=True):
        low, high = fit.intervals[name]
        claim = f"{name} of Table 6.2, {told[name]:g} {unit}: distance of {fit.parameters[name]:.4g}"
        yield Finding(
            claim, abs(fit.parameters[name] - told[name]) / ((high - low) / 2), 2.0, "half widths of its interval"
        )
    yield Finding(
        "r of Table 6.2: below the lower end of its interval by",
        max(0.0, fit.intervals["r"][0] - told["r"]),
        0,
        "s/rad",
    )


@cache
def _fit() -> FrictionFit:
    model = read_model(fmu_build.build("HydraulicTestBench.Mechanics.DrivenShaft"))
    record, direction = _simulated(model)
    return fit_friction([pulse_samples(_measured(record, direction, _SEED), INERTIA)])


def pictures() -> Mapping[str, Figure]:
    """All speeds, and those near standstill."""
    return {"Figure 6.3 redone: measured (virtual bench) and fitted friction.": friction_figure(_fit())}
