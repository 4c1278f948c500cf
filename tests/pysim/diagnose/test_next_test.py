import re
from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.bench import read_plan, run_plan
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.next_test import ENOUGH, next_test
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.subject import Subject, extended, subject
from pysim.identify.greybox import Rest
from pysim.types import BadInput, Dataset, Experiment, MeasuredSignal, Model, Outcome, Record
from tests.pysim.diagnose.toy import CATALOGUE, NOISE, base, build_variant, measured

NAMES = ("toy.friction", "toy.hardening")
module = import_module("pysim.diagnose.next_test")  # the package has a function of that name


def fitted(own: Subject, ruler: Ruler, name: str, start: Fitted | None) -> Fitted:
    what = extended(own, [CATALOGUE[name]])
    x = what.space.to_search(what.space.start) if start is None else start.point.x
    return Fitted(what, refit(ruler, what, ruler.evaluation(what, x), rounds=8))


def rivals(data: Dataset, *names: str, starts: Sequence[Fitted | None] = (None, None)) -> tuple[Subject, list[Fitted]]:
    own = subject(base(), data, [CATALOGUE[name] for name in names], build_variant, rest=Rest(hold=20.0))
    ruler, _ = rulers(own.targets, told=own.specified)
    return own, [fitted(own, ruler, name, at) for name, at in zip(names, starts, strict=True)]


def tied() -> Dataset:
    """Of a mass with friction, one log too short to tell it from another effect."""
    data = measured(4, "toy.friction", F_c=0.012)
    first = data.records[0]
    short = replace(first.data, time=first.data.time[:120], values=first.data.values[:120])
    return replace(data, records=(replace(first, data=short),))


@pytest.fixture(scope="module")
def two() -> tuple[Subject, list[Fitted]]:
    return rivals(tied(), *NAMES)


def retold(data: Dataset, **told: float | None) -> Dataset:
    """The same data with something else told of the output's noise."""
    return replace(data, signals=tuple(replace(s, **told) if s.role == "output" else s for s in data.signals))


def test_the_plan_separates_as_far_as_it_promises(two: tuple[Subject, list[Fitted]], tmp_path: Path) -> None:
    data, (own, (one, other)) = tied(), two
    before = other.point.cost - one.point.cost
    found = next_test(own, one, other)
    assert found is not None
    assert found.separates == NAMES
    assert found.gain >= ENOUGH > abs(before)
    path = tmp_path / "plan.toml"
    path.write_text(found.plan)
    truth, places = build_variant([CATALOGUE["toy.friction"]])
    true = {"m": 1.05, "d": 0.75, "k": 21.0, f"{places['toy.friction']}.F_c": 0.012}
    new = run_plan(truth, read_plan(path), 5, parameters=true).dataset
    joined = replace(data, records=(*data.records, *new.records))
    _, (right, wrong) = rivals(joined, *NAMES, starts=(one, other))
    gained = wrong.point.cost - right.point.cost - before
    assert gained > 0.4 * found.gain  # promised to first order: the longer way of larger amplitudes tells more
    assert gained > 20


def test_twins_stay_twins() -> None:
    own, (one, other) = rivals(tied(), "toy.friction", "toy.twin")
    assert next_test(own, one, other) is None


def test_noise_that_is_not_told_is_taken_as_residuals_are_counted(tmp_path: Path) -> None:
    data = retold(tied(), noise=None, resolution=1e-3)
    never_logged = MeasuredSignal("speed", "output", "m/s", "", "v")
    own, (one, other) = rivals(replace(data, signals=(*data.signals, never_logged)), *NAMES)
    found = next_test(own, one, other)
    assert found is not None
    assert found.gain >= ENOUGH
    path = tmp_path / "plan.toml"
    path.write_text(found.plan)
    (planned,) = (sensor.signal for sensor in read_plan(path).sensors if sensor.signal.name == "x")
    (counted,) = rulers(own.targets, told=False)[0].noise.values()
    assert planned.deviation == pytest.approx(counted.deviation, rel=1e-5)
    assert planned.deviation == pytest.approx(NOISE, rel=0.3)  # seen in 120 samples
    assert planned.resolution == 1e-3


def test_where_the_logged_are_not_enough_an_output_is_asked_for() -> None:
    own, (one, other) = rivals(retold(tied(), noise=0.05), *NAMES)
    found = next_test(own, one, other)
    assert found is not None
    assert re.search(r"Log x, v \(new: v, 0\.0\d+ m/s of noise assumed\)\.$", found.about)
    assert '[signals."v"]' in found.plan


def test_without_any_noise_to_go_by_it_is_refused(two: tuple[Subject, list[Fitted]]) -> None:
    own, (one, other) = two
    unseen = replace(own, dataset=retold(tied(), noise=None), targets=())
    with pytest.raises(BadInput, match="needs an output whose noise is known"):
        next_test(unseen, one, other)


@pytest.mark.parametrize("reached", [0, 100])
def test_a_look_ahead_that_ends_early_waits_to_its_end(
    two: tuple[Subject, list[Fitted]], monkeypatch: pytest.MonkeyPatch, reached: int
) -> None:
    def simulate(model: Model, run: Experiment, **_: Any) -> Record:
        values = np.zeros((reached, len(run.record)))
        return Record(run.times[:reached], values, run.record, ("m",), Outcome.STEP_TOO_SMALL)

    own, (one, _) = two
    assert own.dataset is not None
    monkeypatch.setattr(module, "simulate", simulate)
    asked = Experiment(np.arange(0.0, 200.0, 0.02), ("x",))
    outputs = [signal for signal in own.dataset.signals if signal.role == "output"]
    assert module._settled(own, one, outputs, asked) == asked.times[-1]
