"""Thesis Fig. 4.8 and 4.9: how much of the ripple a hose of 3 m lets through, and why."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record
from validation.findings import Finding
from validation.ripple.line import Hose

Array = NDArray[np.float64]

EXAMPLE = "HydraulicTestBench.Examples.RippleHose"
STROKES = 435.0  # Hz, 18 per revolution at 1450 rpm
SEGMENTS = 32  # of the example
LAST = 0.2  # s, 87 strokes
LAGS = (0.0, 5e-5, 1e-4, 2e-4)  # s
NEAR = np.linspace(390, 480, 181)  # Hz, 1300 to 1600 rpm: any place between two resonances


@cache
def measured(segments: int = SEGMENTS, lag: float = 1e-4) -> Record:
    """Flow before and after the hose over the last 87 strokes, once the pump has reached its angle."""
    model = read_model(fmu_build.build(EXAMPLE, overrides={"hose.n": segments}))
    times = 0.6 - LAST + LAST * np.arange(87 * 64) / (87 * 64)
    run = Experiment(times, ("before.Q", "after.Q"), overrides={"hose.T_w": lag})
    return simulate(model, run, solver=Rodas(rtol=1e-8, atol=1e-8))


def amplitude(values: Array, times: Array, hertz: float = STROKES) -> float:
    """Of the sine at `hertz`, over whole periods."""
    return float(2 * np.abs(np.mean((values - values.mean()) * np.exp(-2j * np.pi * hertz * times))))


def passed(record: Record) -> float:
    """Ripple after the hose over ripple before, at the strokes' frequency."""
    return amplitude(record["after.Q"], record.time) / amplitude(record["before.Q"], record.time)


def findings() -> Iterator[Finding]:
    """The FMU against closed forms, and what takes the ripple away."""
    record, hose = measured(), Hose()
    flow, strokes = float(record["before.Q"].mean()), np.array([STROKES])
    share = passed(record)
    swing = np.ptp(record["after.Q"]) / np.ptp(record["before.Q"])
    for words, arrives in (("435 Hz ripple", share), ("whole swing", float(swing))):
        yield Finding(
            f"hose of {SEGMENTS} segments: {arrives:.2f} of the {words} arrives; short of what a figure shows by",
            max(0.0, UNSEEN - arrives),
            0.0,
            "",
            alternative="none is seen behind the hose, as in Figure 4.9",
            source=_LINE,
        )
    for segments, lag in ((SEGMENTS, 1e-4), (SEGMENTS, 5e-5), (1, 1e-4)):
        exact = hose.with_lag(lag).passed_by_segments(segments, strokes, flow)[0]
        claim = f"FMU against the closed form, {segments} segments, wall's lag {1e6 * lag:g} us"
        yield Finding(claim, 100 * abs(passed(measured(segments, lag)) / exact - 1), 0.5, "percent")
    line = hose.passed(strokes, flow)[0]
    once, twice = (hose.passed_by_segments(n, strokes, flow)[0] / line - 1 for n in (SEGMENTS, 2 * SEGMENTS))
    yield Finding(
        f"{SEGMENTS} and {2 * SEGMENTS} segments, extrapolated to their limit, against the wave equation",
        100 * abs((4 * twice - once) / 3),
        100 * once**2,
        "percent",
        alternative="segments tend to something else, or not with the square of their length",
        source=f"square of the {100 * abs(once):.1f} percent by which {SEGMENTS} segments are off: the next term",
    )
    single = passed(measured(1))
    yield Finding("one segment: share that arrives, whatever the wall", single, 0.02, "")
    yield from _by_cause(hose, flow)
    yield from _gone(flow)


def _by_cause(hose: Hose, flow: float) -> Iterator[Finding]:
    """Wall, friction and end, each for itself, by the wave equation over all frequencies near the strokes'."""
    near = NEAR
    span = "by the wave equation, 1300 to 1600 rpm,"
    bare = hose.with_lag(0.0).passed(near, flow)
    yield Finding(
        f"{span} wall without damping: least share that arrives, short of 1 by", 1 - float(bare.min()), 0.02, ""
    )
    yield Finding(
        f"{span} loss factor of 0.27: most that arrives over the least without damping",
        float(hose.passed(near, flow).max() / bare.min()),
        0.5,
        "",
        alternative="the wall's damping hardly matters beside where the strokes stand between resonances",
        source="half",
    )
    closed = replace(hose, end=2 * 100e5 / flow).passed(near, flow)  # slope of an orifice that takes 100 bar
    yield Finding(f"{span} the same on an orifice of 100 bar: at most", float(closed.max()), 0.1, "")


# What a hose and its oil may be at most. Oil: VG 46 at 0 degC, 580 mm2/s by the line of ASTM D341 through 46 mm2/s at
# 40 and 6.8 at 100 degC. Wall: Merritt, Hydraulic Control Systems, Chapter 2
_COLD, _SOFT = 600e-6, 70e6  # m2/s, Pa
UNSEEN = 0.04  # 0.05 l/min of a ripple of 1.3 l/min: a line's width in a figure of 50 l/min
_LINE = "0.05 of 1.3 l/min, the width of a line"


def causes() -> Mapping[str, tuple[Hose, float]]:
    """Friction and wall, each as strong as it may be: a hose without damping in its wall, and what it lets through."""
    bare = replace(Hose().with_lag(0.0), unsteady=True)
    return {
        "friction that depends on frequency": (bare, 0.5),
        "such friction of oil at 0 degC, 600 mm2/s": (replace(bare, viscosity=_COLD), 0.5),
        "such friction and the softest wall, 70 MPa": (replace(bare, wall=_SOFT), 0.5),
        "all three": (replace(bare, viscosity=_COLD, wall=_SOFT), 0.1),
    }


def damped() -> Hose:
    """The softest wall with a loss factor of 0.27."""
    return replace(Hose(), unsteady=True, wall=_SOFT)


def _gone(flow: float) -> Iterator[Finding]:
    """Which causes, each as strong as it may be, leave nothing of the ripple to be seen, and which do not."""
    for words, (line, least) in causes().items():
        share = float(line.passed(NEAR, flow).min())
        yield Finding(
            f"{words}, wall without damping: at least {share:.2f} of the ripple arrives; short of {least:g} by",
            max(0.0, least - share),
            0.0,
            "",
            alternative="this cause alone has the ripple gone, as Figure 4.9 shows it",
            source="ten times what a figure would hide, or more",
        )
    strokes = np.array([STROKES])
    few = max(float(Hose().with_lag(0.0).passed_by_segments(n, strokes, flow)[0]) for n in (1, 2, 3, 4))
    soft = float(damped().passed(NEAR, flow).max())
    for words, share in (
        ("one to four segments, no damping", few),
        ("a wall of 70 MPa and a loss factor of 0.27", soft),
    ):
        yield Finding(
            f"{words}: at most this share of the ripple arrives",
            share,
            UNSEEN,
            "",
            alternative="only one cause is left, so that the thesis' hose could be known",
            source=_LINE,
        )


def table(flow: float) -> list[tuple[str, list[float]]]:
    """Share that arrives at 435 Hz: a row per number of segments and one of the wave equation, a column per lag."""
    strokes = np.array([STROKES])
    rows = []
    for segments in (1, 2, 4, 8, 16, 32, 64):
        shares = [Hose().with_lag(lag).passed_by_segments(segments, strokes, flow)[0] for lag in LAGS]
        rows.append((str(segments), [float(share) for share in shares]))
    rows.append(("line", [float(Hose().with_lag(lag).passed(strokes, flow)[0]) for lag in LAGS]))
    return rows
