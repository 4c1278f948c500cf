"""`pysim friction`."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import number, positive, text
from pysim.cli.options import DATASET, JSON, OUTPUT

if TYPE_CHECKING:
    from pysim.present.friction import Friction


def run(given: Given) -> Friction:
    """By pulses, with the thesis' way beside it where the log allows it; or by filter alone."""
    from pysim.identify.friction import ShaftColumns, filtered_samples, fit_friction, pulse_samples, shaft_tests
    from pysim.present.friction import Friction
    from pysim.types import BadInput

    inertia = given.inertia
    if not (math.isfinite(inertia) and inertia >= 0):
        raise BadInput(f"--inertia {inertia}: write the moment of inertia in kg.m2, 0 or above")
    for option, gain in (("--supply-gain", given.supply_gain), ("--load-gain", given.load_gain)):
        if not math.isfinite(gain) or gain == 0:
            raise BadInput(f"{option} {gain}: write the torque per pressure in m3/rad, of either sign")
    if given.load is None and given.load_gain != 1:
        raise BadInput("--load-gain: no torque of a load is named; add --load, or leave --load-gain out")
    columns = ShaftColumns(given.speed, given.supply, given.load, given.supply_gain, given.load_gain)
    tests, name = shaft_tests(given.dataset, columns), str(given.typed["dataset"])
    cutoff = {"cutoff_hz": given.cutoff_hz} if given.cutoff_hz else {}
    try:
        filtered = [filtered_samples(test, inertia, **cutoff) for test in tests]
    except BadInput:  # where there are pulses, an uneven log does without the filter that nobody asked for
        if given.pulses is None or cutoff:
            raise
        filtered = []
    if given.pulses is None:
        return Friction(fit_friction(filtered), None, name, columns, inertia)
    fit = fit_friction([pulse_samples(test, inertia, pulses=given.pulses) for test in tests])
    by_filter = fit_friction(filtered, weighted=False) if filtered else None
    return Friction(fit, by_filter, name, columns, inertia)


def _pulses(word: str) -> int | None:
    """Pulses per revolution, or None."""
    if word == "none":
        return None
    if not word.isdecimal() or int(word) < 1:
        raise argparse.ArgumentTypeError(f"{word!r} is no number of pulses; write one above 0, or none")
    return int(word)


COMMAND = Command(
    "friction",
    "Fit the friction of a shaft (thesis Eq. 5.38) to logs of its speed and torques.",
    run,
    options=(
        DATASET,
        text("--speed", "COLUMN", "speed of the shaft", required=True),
        text("--supply", "COLUMN", "torque or pressure of the supply motor", required=True),
        number("--supply-gain", "K", 1.0, "torque per pressure, m3/rad"),
        text("--load", "COLUMN", "torque or pressure of the load motor, against the motion"),
        number("--load-gain", "K", 1.0, "torque per pressure, m3/rad"),
        number("--inertia", "J", None, "inertia of motors and shaft, kg.m2", required=True),
        number("--pulses", "N", 10, "pulses per revolution; none for a continuous speed", convert=_pulses),
        number("--cutoff-hz", "HZ", None, "cutoff of the zero-phase filter (5)", convert=positive),
        JSON,
        OUTPUT,
    ),
)
