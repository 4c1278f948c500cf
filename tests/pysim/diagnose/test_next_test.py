from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from pysim.bench import read_plan, run_plan
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.next_test import ENOUGH, next_test
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.subject import Subject, extended, subject
from pysim.identify.greybox import Rest
from pysim.types import Dataset
from tests.pysim.diagnose.toy import CATALOGUE, base, build_variant, measured


def fitted(own: Subject, ruler: Ruler, name: str, start: Fitted | None) -> Fitted:
    what = extended(own, [CATALOGUE[name]])
    x = what.space.to_search(what.space.start) if start is None else start.point.x
    return Fitted(what, refit(ruler, what, ruler.evaluation(what, x), rounds=8))


def rivals(data: Dataset, *names: str, starts: Sequence[Fitted | None] = (None, None)) -> tuple[Subject, list[Fitted]]:
    own = subject(base(), data, [CATALOGUE[name] for name in names], build_variant, rest=Rest(hold=20.0))
    ruler, _ = rulers(own.targets)
    return own, [fitted(own, ruler, name, at) for name, at in zip(names, starts, strict=True)]


def test_the_plan_separates_as_far_as_it_promises(tmp_path: Path) -> None:
    data = measured(4, "toy.friction", F_c=0.012)
    first = data.records[0]
    short = replace(first.data, time=first.data.time[:120], values=first.data.values[:120])
    data = replace(data, records=(replace(first, data=short),))
    names = ("toy.friction", "toy.hardening")
    own, (one, other) = rivals(data, *names)
    before = other.point.cost - one.point.cost
    found = next_test(own, one, other)
    assert found is not None
    assert found.separates == names
    assert found.gain >= ENOUGH > abs(before)
    path = tmp_path / "plan.toml"
    path.write_text(found.plan)
    truth, places = build_variant([CATALOGUE["toy.friction"]])
    true = {"m": 1.05, "d": 0.75, "k": 21.0, f"{places['toy.friction']}.F_c": 0.012}
    new = run_plan(truth, read_plan(path), 5, parameters=true).dataset
    joined = replace(data, records=(*data.records, *new.records))
    _, (right, wrong) = rivals(joined, *names, starts=(one, other))
    gained = wrong.point.cost - right.point.cost - before
    assert gained > 0.4 * found.gain  # promised to first order: the longer way of larger amplitudes tells more
    assert gained > 20


def test_twins_stay_twins() -> None:
    data = measured(1, "toy.friction", F_c=0.4)
    own, (one, other) = rivals(data, "toy.friction", "toy.twin")
    assert next_test(own, one, other) is None
