"""The next test is carried out with the case's own effect and numbers, and its logs join the others."""

import numpy as np
import pytest

from pysim.types import MeasuredRecord, NextTest, Record
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.follow import carried_out, follow_case, joined, ties
from validation.blind.benchmark.truth import Truth
from validation.blind.benchmark.workshop import workshop
from validation.blind.plant import Case, measure

PLAN = """
[plan]
name = "next-test"

[signals.alphaCMD]
role = "input"
unit = "%"

[signals.alphaPercent]
role = "output"
unit = "%"
noise = 1e-9

[signals.u]
role = "output"
unit = "1"
noise = 1e-9

[logging]
rate = 250

[[tests]]
kind = "step"
outputs = ["alphaPercent", "u"]
offset = 0
height = 40
length = 2
"""


def stepped(*effects: tuple[str, str]) -> MeasuredRecord:
    case = Case("a", "named", effects, noise=0.1, spool=False, seed=5)
    truth = Truth(case, measure(case), workshop())
    data = carried_out(truth, NextTest(("valve.offset", "none"), 60.0, "", PLAN))
    (record,) = data.records
    both = joined(truth.measured.dataset, data)
    assert [signal.name for signal in both.signals] == ["alphaCMD", "alphaPercent", "u"]
    assert both.records[-1].source == f"next/{record.source}"
    assert len(both.records) == 1 + len(truth.measured.dataset.records)
    return record


def test_the_bench_has_the_effect() -> None:
    plain, moved = (stepped(*effects).data for effects in ((), (("valve.offset", "large"),)))
    assert isinstance(plain, Record)
    assert isinstance(moved, Record)
    apart = moved["u"][-1] - plain["u"][-1]
    neutral = Case("a", "named", (("valve.offset", "large"),), seed=5).strengths()
    assert abs(apart) == pytest.approx(abs(neutral.offset__u_n), rel=0.05)
    assert np.ptp(plain["alphaPercent"]) > 30


def test_ties_are_what_was_answered_by_several_effects() -> None:
    tied, named, open_ = (Case(name, "named", (("valve.deadband", "middle"),)) for name in "abc")
    answers = {
        "a": Answer("a", "0", "2026-01-01", verdict="x", confusable=(("x", "y"),)),
        "b": Answer("b", "0", "2026-01-01", verdict="x"),
    }
    assert ties([tied, named, open_], answers) == [tied]


@pytest.mark.slow
def test_a_case_is_followed() -> None:
    answer = follow_case(Case("a", "named", (("valve.deadband", "middle"),), noise=0.5, spool=False, seed=5))
    assert answer.rivals == () or answer.settled is not None
