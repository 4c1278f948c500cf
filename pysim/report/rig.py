"""Tests of the rig under its controllers as text, as data and as pages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pysim.io import json_number
from pysim.present.page import cell, commands, heading, items, page, picture, table
from pysim.rig import HeaveFigures, HeaveTest, StepFigures, StepTest

_BAR = 1e-5
_STEP_HEAD = ("step of", "size", "steady error", "overshoot (%)", "rise (s)", "settling (s)")
_HEAVE_HEAD = (
    "speed rms (rad/s)",
    "max",
    "pressure rms (bar)",
    "max",
    "below 1 Hz (bar)",
    "supply (bar)",
    "standstills",
    "longest (s)",
)
_STEP_METHOD = (
    "Both references come up by ramps within a second; one of them steps, the other one is held (thesis Section 6.4).",
    "The steady error is the mean of the last second less the reference. Rise: from a tenth to nine tenths of the "
    "step. Settling: until the answer stays within 5 percent of the step.",
)
_HEAVE_METHOD = (
    "A vessel heaves in a stochastic wave; the crane makes references of it, drum speed and load pressure, and the rig "
    "follows (thesis Sections 5.7 and 6.3).",
    "Errors are true speed and load pressure less their references, the start left out. Below 1 Hz: what the waves "
    "leave, without stick and slip.",
    "The shaft stands still where it turns by less than 0.5 rad/s for 50 ms or more; the reference's own longest such "
    "span is given beside it.",
)

Steps = Sequence[tuple[StepTest, StepFigures]]


def step_text(steps: Steps) -> str:
    """A row per step."""
    lines = ["".join(f"{name:>16}" for name in _STEP_HEAD)]
    return "\n".join(lines + ["".join(f"{x:>16}" for x in _step_cells(*one)) for one in steps])


def step_data(steps: Steps) -> list[dict[str, Any]]:
    """SI numbers; null where an answer did not get there."""
    return [
        {
            "kind": test.kind,
            "size": test.size,
            "steady_error": found.steady_error,
            "overshoot": found.overshoot,
            "rise_time_s": json_number(found.rise_time),
            "settling_time_s": json_number(found.settling_time),
            "settling_band": found.band,
        }
        for test, found in steps
    ]


def step_page(steps: Steps, *, pictures: Mapping[str, bytes], redo: str) -> str:
    """A self-contained HTML page; redo is the command line that makes it again."""
    rows = [[cell(x) for x in _step_cells(*one)] for one in steps]
    parts = [heading("How it was done"), items(_STEP_METHOD), table("Answers to steps", _STEP_HEAD, rows)]
    parts += [picture(svg, caption) for caption, svg in pictures.items()]
    parts += [heading("Do it again"), commands(redo)]
    return page("Step tests of the rig", "Speed and load pressure of the test bench under its controllers.", parts)


def _step_cells(test: StepTest, found: StepFigures) -> list[str]:
    speed = test.kind == "speed"
    scale, unit = (1.0, "rad/s") if speed else (_BAR, "bar")
    return [
        "speed" if speed else "load pressure",
        f"{test.size * scale:g} {unit}",
        f"{found.steady_error * scale:.2g} {unit}",
        f"{100 * found.overshoot:.1f}",
        f"{found.rise_time:.3f}",
        f"{found.settling_time:.2f}",
    ]


def heave_text(runs: Mapping[str, HeaveFigures]) -> str:
    """A row per controller."""
    width = max(len(label) for label in runs)
    lines = [" " * width + "".join(f"{name:>20}" for name in _HEAVE_HEAD)]
    lines += [f"{label:<{width}}" + "".join(f"{x:>20}" for x in _heave_cells(found)) for label, found in runs.items()]
    return "\n".join(lines)


def heave_data(runs: Mapping[str, HeaveFigures], test: HeaveTest) -> dict[str, Any]:
    """SI numbers, and the wave."""
    return {
        "wave": {
            "significant_height_m": test.significant_height,
            "peak_period_s": test.peak_period,
            "length_s": test.length,
            "seed": test.seed,
        },
        "controllers": {
            label: {
                "speed_rms": f.speed_rms,
                "speed_max": f.speed_max,
                "pressure_rms": f.pressure_rms,
                "pressure_max": f.pressure_max,
                "pressure_slow_rms": f.pressure_slow_rms,
                "supply_low": f.supply_low,
                "supply_high": f.supply_high,
                "standstills": f.held.tolist(),
                "standstill_longest_s": f.held_longest,
                "standstill_longest_of_reference_s": f.held_reference,
            }
            for label, f in runs.items()
        },
    }


def heave_page(runs: Mapping[str, HeaveFigures], test: HeaveTest, *, pictures: Mapping[str, bytes], redo: str) -> str:
    """A self-contained HTML page; redo is the command line that makes it again."""
    rows = [[cell(label, "words"), *(cell(x) for x in _heave_cells(f))] for label, f in runs.items()]
    lead = (
        f"Significant height {test.significant_height:g} m, peak period {test.peak_period:g} s, {test.length:g} s, "
        f"seed {test.seed}."
    )
    parts = [heading("How it was done"), items(_HEAVE_METHOD)]
    parts.append(table("How well the references were followed", ["controller", *_HEAVE_HEAD], rows))
    parts += [picture(svg, caption) for caption, svg in pictures.items()]
    parts += [heading("Do it again"), commands(redo)]
    return page("Heave compensation on the rig", lead, parts)


def _heave_cells(f: HeaveFigures) -> list[str]:
    return [
        f"{f.speed_rms:.2f}",
        f"{f.speed_max:.1f}",
        f"{_BAR * f.pressure_rms:.2f}",
        f"{_BAR * f.pressure_max:.1f}",
        f"{_BAR * f.pressure_slow_rms:.2f}",
        f"{_BAR * f.supply_low:.0f} ... {_BAR * f.supply_high:.0f}",
        f"{f.held.shape[0]}",
        f"{f.held_longest:.2f} ({f.held_reference:.2f})",
    ]
