"""A made-up diagnosis beside a made-up truth: errors and intervals as they were put in."""

import math
from dataclasses import replace
from types import MappingProxyType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from pysim.types import (
    AddedEffect,
    Diagnosis,
    Direction,
    Effect,
    EffectParameter,
    Estimate,
    LedgerStep,
    Missing,
    Record,
    RecordFit,
    Shape,
    Stage,
)
from validation.blind.benchmark.judged import error, intervals, judged
from validation.blind.plant import Case

TIMES = np.arange(4.0)
CLEAN = np.array([[1.0, 0.1], [2.0, 0.2], [3.0, 0.3], [4.0, 0.4]])
FRICTION = Effect("f", "pistonForce", "F", (EffectParameter("F_c", "N", 0, 500, 100, 0, 0.0),))
STEP = LedgerStep("f", 1.0, 1.01, {}, True, 100.0)


def record(off: float, *, use: str = "validate", spool: bool = True) -> RecordFit:
    names, units = (("alphaPercent", "u"), ("%", "1")) if spool else (("alphaPercent",), ("%",))
    measured = Record(TIMES, CLEAN[:, : len(names)], names, units)
    noise = (0.1, 0.002)[: len(names)]
    simulated = replace(measured, values=measured.values + off * np.array(noise))
    return RecordFit("d", "log", "stochastic", use, measured, simulated, noise)


def estimate(name: str, value: float, low: float, high: float, *, std: float = 0.1, at: str = "") -> Estimate:
    return Estimate(name, "", value, value, 0.0, 10.0, std, (low, high), at)


def diagnosis(parameters: tuple[Estimate, ...], force: Estimate, held: str = "") -> Diagnosis:
    open_ = (Direction({held: 1.0, "A_p": -1.0}, math.inf, ""),) if held else ()
    stages = [Stage(step, records=(record(off),)) for step, off in (("prior", 9.0), ("refit", 3.0), ("f", 0.5))]
    stages[-1] = replace(stages[-1], estimates=(*parameters, force), undetermined=open_)
    shape = Shape(TIMES, TIMES, TIMES, TIMES, "m/s", "N")
    return Diagnosis(
        "f", "", (AddedEffect(FRICTION, "pistonForce", (force,)),), (), (), (replace(STEP, validate=7.0), STEP),
        parameters, (), {}, missing=(Missing("pistonForce", 0.9, "v", shape),),
        stages=tuple(stages),
    )  # fmt: skip


class MadeUp(SimpleNamespace):
    case = Case("c", "named", (("f", "large"),))
    measured = SimpleNamespace(clean={"log": CLEAN})
    base = MappingProxyType({"tau": 1.0, "L": 2.0, "A_p": 0.5, "K_p": 4.0})

    def strengths(self, effect: Effect) -> dict[str, float]:
        return {"F_c": 100.0}

    def left(self, names: Any, near: Any = None) -> float:
        return 321.0 if not names else 5.0

    def held_out(self) -> tuple[float, float] | None:
        return 0.04, 0.003


def test_error_is_of_held_out_samples_in_units_of_noise() -> None:
    both = Stage("refit", records=(record(3.0), record(50.0, use="fit"), record(4.0, spool=False)))
    assert error(MadeUp.measured, both) == pytest.approx(math.sqrt((8 * 9 + 4 * 16) / 12))  # type: ignore[arg-type]
    assert error(MadeUp.measured, None) is None  # type: ignore[arg-type]
    assert error(MadeUp.measured, Stage("refit", records=(record(1.0, use="fit"),))) is None  # type: ignore[arg-type]


def test_all_fields() -> None:
    told = judged(MadeUp(), diagnosis((estimate("tau", 1.0, 0.9, 1.1),), estimate("x", 100, 90, 110)))  # type: ignore[arg-type]
    assert told["base"] == pytest.approx(3.0)
    assert told["final"] == pytest.approx(0.5)
    assert told["held"] == 1.01
    assert (told["footprint"], told["bound"], told["floor"]) == (321.0, 0.04, 0.003)
    assert "parts" not in told


def test_a_wrong_repair_has_no_intervals() -> None:
    wrong = MadeUp(case=Case("c", "named", (("other", "large"),)))
    told = judged(wrong, diagnosis((estimate("tau", 1.0, 0.9, 1.1),), estimate("x", 100, 90, 110)))  # type: ignore[arg-type]
    assert "determined" not in told


def test_intervals_of_what_is_determined_and_inside_its_bounds() -> None:
    parameters = (
        estimate("tau", 1.2, 1.1, 1.3),  # misses 1
        estimate("K_p", 4.1, 3.9, 4.3),  # holds 4
        replace(estimate("L", 2.0, 0.0, 10.0), std=math.inf),  # not determined
        estimate("volume", 3.0, 2.0, 4.0),  # not among those that differ from one pump to the next
    )
    force = replace(estimate("pistonForce.F_c", 101.0, 95.0, 107.0), upper=500.0)
    looked = dict(intervals(MadeUp(), diagnosis(parameters, force)))  # type: ignore[arg-type]
    assert looked == {"tau": False, "K_p": True, "pistonForce.F_c": True}
    at_bound = (estimate("tau", 1.0, 1.0, 1.3, at="lower"), replace(estimate("K_p", 4.1, 4.0, 4.3), lower=4.0))
    assert dict(intervals(MadeUp(), diagnosis(at_bound, replace(force, std=math.inf)))) == {}  # type: ignore[arg-type]


def test_forces_and_areas_move_along_the_open_direction_to_where_it_is_held() -> None:
    """A stroke held a tenth too long goes with an area and forces a tenth too small."""
    parameters = (estimate("L", 2.2, 2.1, 2.3), estimate("A_p", 0.455, 0.45, 0.46))
    force = replace(estimate("pistonForce.F_c", 91.0, 88.0, 94.0), upper=500.0)
    looked = dict(intervals(MadeUp(), diagnosis(parameters, force, held="L")))  # type: ignore[arg-type]
    assert looked == {"A_p": True, "pistonForce.F_c": True}
    looked = dict(intervals(MadeUp(), diagnosis(parameters, force)))  # type: ignore[arg-type]
    assert looked == {"L": False, "A_p": False, "pistonForce.F_c": False}
