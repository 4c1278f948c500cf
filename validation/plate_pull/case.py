"""Load and no load (Section 4.2): the pistons' pull on the swash plate, beside the difference that was measured."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import fmu_build
from pysim.identify import compare_responses, magnitude_db
from pysim.io import read_model
from pysim.present.style import COLOURS, DASHES, MARKERS, SMALL, TEXT, new_figure, quiet
from pysim.simulate import Rodas, simulate
from pysim.thesis import read_csv
from pysim.types import Experiment, FrequencyResponse, Model, Signal
from validation.findings import Finding
from validation.plate_pull.kinematics import at_zero_angle, mean_pull, pull
from validation.pump_flow.kinematics import Geometry
from validation.real_measurements.load import load_differences, unloaded_at_75

Array = NDArray[np.float64]

P_LOW = 25e5  # Pa, of the refilled side, thesis Section 3.1.2
# Free set, Table 4.6: effective mass, stroke, and the lever of Eq. 3.8
_MASS_FREE, _STROKE_FREE = 62.384, 47.011e-3
_LEVER_FREE = _STROKE_FREE / (2 * np.tan(np.deg2rad(15)))
_LEVER = "pump.a"
_TABLE = Path(__file__).parents[1] / "thesis" / "table_4_2" / "published.csv"


def notes() -> Sequence[str]:
    """What was chosen."""
    return (
        "The pressure follows the angle at once, by the law that Table 4.2 obeys: oil and hoses between pump and "
        "orifice would let it lag and reach the plate less. The free set of Table 4.6 stands for the pump.",
    )


def run() -> Iterator[Finding]:
    """The component against kinematics, then the responses with and without it, beside the measured difference."""
    yield from _against_kinematics()
    yield from _sawtooth()
    yield from _responses()


@cache
def model() -> Model:
    """The pump whose load pulls at its plate, under the law of Table 4.2."""
    return read_model(fmu_build.build("LoadedPump", libraries=[Path(__file__).parent / "LoadedPump.mo"]))


@cache
def load_law() -> tuple[float, float]:
    """c in Pa/rad2 and a_0 in rad: the drops of Table 4.2 are c (alpha - a_0)^2."""
    rows = read_csv(_TABLE)
    angle = np.deg2rad(15) / 100 * np.array([float(row["angle_percent"]) for row in rows])
    slope, zero = np.polyfit(angle, np.sqrt(1e5 * np.array([float(row["drop_bar"]) for row in rows])), 1)
    return float(slope**2), float(-zero / slope)


def _against_kinematics() -> Iterator[Finding]:
    pump = Geometry()
    exact = at_zero_angle(pump, 52e5)
    found = mean_pull(pump, 0.0, P_LOW + 52e5, P_LOW)
    yield Finding(
        f"all pistons at no angle and 52 bar: {found:.3f} N m, closed form {exact:.3f}; off by",
        abs(found / exact - 1),
        2e-3,
        "of it",
        alternative="the virtual work counts another lever or port",
        source="4,000 steps of a revolution, of which two lie on the edge of a port",
    )
    c, a_0 = load_law()
    times = np.linspace(0.0, 60.0, 121)
    sweep = Experiment(
        times,
        ("pump.alpha", "dp", "f", _LEVER),
        {"alphaCMD": Signal.lines([0.0, 60.0], [0.0, 90.0])},
        {"c": c, "a_0": a_0},
        rates={"alphaCMD_t": "alphaCMD"},
    )
    record = simulate(model(), sweep, solver=Rodas(rtol=1e-7, atol=1e-7))
    alpha, lever = record["pump.alpha"], record[_LEVER][0]
    torque = record["f"] * lever / np.cos(alpha) ** 2
    whole = np.array(
        [mean_pull(pump, a, P_LOW + dp, P_LOW) for a, dp in zip(alpha[::10], record["dp"][::10], strict=True)]
    )
    largest = float(np.abs(torque).max())
    yield Finding(
        f"FMU against all pistons, 0 to 90 % under the load of Table 4.2: at most {largest:.1f} N m; off by",
        float(np.abs(torque[::10] - whole).max()),
        0.6,
        "N m",
        alternative="the formula of the mean leaves out a part of the kinematics that counts",
        source="first order in the angle: 7 % of two parts of 8 N m that nearly cancel",
    )


def _sawtooth() -> Iterator[Finding]:
    """What is left out: the pull jumps as each chamber changes its port, at 435 Hz."""
    pump = Geometry()
    theta = np.linspace(0, 2 * np.pi, 7201)
    swing = float(np.ptp(pull(pump, theta, np.deg2rad(11.25), P_LOW + 52e5, P_LOW)))
    moved = swing / _LEVER_FREE / _MASS_FREE / (2 * np.pi * 435) ** 2
    yield Finding(
        f"the sawtooth left out swings by {swing:.0f} N m at 435 Hz; by it the piston moves, of its stroke",
        1e6 * moved / _STROKE_FREE,
        100.0,
        "millionths",
        alternative="the sawtooth shakes the plate, and a mean will not do",
        source="0.01 % of the stroke: a sixth of a step of the angle's reading",
    )


@cache
def answered(share: float) -> tuple[FrequencyResponse, ...]:
    """At 75 % and 5 and 10 %, with this share of the pull: 0 is the unloaded plate."""
    c, a_0 = load_law()
    overrides = {"c": c, "a_0": a_0, "pump.pistonForce.share": share}
    found = compare_responses(model(), unloaded_at_75(), overrides=overrides, solver=Rodas(rtol=1e-7, atol=1e-7))
    return tuple(one.simulated for one in found.tests if one.simulated is not None)


@cache
def predicted() -> tuple[tuple[Array, Array], ...]:
    """With the pull less without: dB relative to the lowest frequency and degrees, per amplitude."""
    rows = []
    for on, off in zip(answered(1.0), answered(0.0), strict=True):
        db = magnitude_db(on) - magnitude_db(off)
        rows.append((db - db[0], np.degrees(on.phase - off.phase)))
    return tuple(rows)


def _responses() -> Iterator[Finding]:
    for measured, (db, deg) in zip(load_differences(), predicted(), strict=True):
        for what, own, seen, unit in (("gain", db, measured.db, "dB"), ("phase", deg, measured.deg, "deg")):
            size, found = float(np.abs(seen).mean()), float(np.abs(own).mean())
            yield Finding(
                f"75/{measured.amplitude:g}, mean {what}: measured {size:.3f}, by the pull {found:.4f} {unit}; share",
                found / size,
                0.25,
                "",
                alternative="the pull explains the measured difference",
                source="a quarter: less than the functions' own misfit hides",
            )


def pictures() -> Mapping[str, Figure]:
    """The two parts of the pull over the angle, and both differences over frequency."""
    figure = new_figure(7.2, 3.0)
    left, right = figure.subplots(1, 2)
    pump, (c, a_0) = Geometry(), load_law()
    angle = np.linspace(0, 90, 46)
    alpha = np.deg2rad(15) * angle / 100
    dp = c * np.maximum(alpha - a_0, 0) ** 2
    for words, colour, dash, low, over in (
        ("under load", COLOURS[0], DASHES[0], P_LOW, dp),
        ("25 bar on both sides", COLOURS[1], DASHES[1], P_LOW, 0 * dp),
        ("pressure difference alone", COLOURS[2], DASHES[2], 0.0, dp),
    ):
        rows = [mean_pull(pump, a, low + d, low) for a, d in zip(alpha, over, strict=True)]
        left.plot(angle, rows, color=colour, linestyle=dash, linewidth=1.4, label=words)
    left.set_xlabel("Swash plate angle (%)", fontsize=TEXT)
    left.set_ylabel("Mean torque on the plate (N m)", fontsize=TEXT)
    for measured, (db, _), colour, marker in zip(load_differences(), predicted(), COLOURS, MARKERS, strict=False):
        words = f"75/{measured.amplitude:g}"
        right.semilogx(
            measured.frequency,
            measured.db,
            color=colour,
            marker=marker,
            markersize=3,
            linewidth=0.8,
            label=f"{words} thesis",
        )
        right.semilogx(measured.frequency, db, color=colour, linestyle=DASHES[1], linewidth=1.4, label=f"{words} pull")
    right.set_xlabel("Frequency (Hz)", fontsize=TEXT)
    right.set_ylabel("Loaded less unloaded (dB)", fontsize=TEXT)
    for axes in (left, right):
        quiet(axes)
        axes.legend(fontsize=SMALL, frameon=False)
    return {"Left: pull of the pistons. Right: what load changes, measured (Tables 4.1, 4.3) and by the pull.": figure}
