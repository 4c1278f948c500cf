"""A case is measured and handed over without its truth; what comes back becomes an answer."""

from types import SimpleNamespace
from typing import Any

import pytest

from pysim.types import Candidate, Diagnosis
from validation.blind.benchmark import examine as module
from validation.blind.plant import Case
from validation.blind.plant import case as plant_case
from validation.blind.plant import programme as plant_programme

CASE = Case("c", "left-out", (("valve.deadband", "large"),), left_out=("valve.deadband",), seed=2)
KEPT = ("O+50_A20/8Hz.txt", "Tp1.0_fit.txt", "Tp0.5_heldout.txt")


def test_the_answer_of_a_case(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: dict[str, Any] = {}

    def fake(subject: Any, **settings: Any) -> Diagnosis:
        seen.update(settings, catalogue=[e.name for e in subject.catalogue], data=repr(subject.targets))
        names = (("oil.air", 1), ("valve.offset", 2), ("sensor.lag", 1), ("swash.bias", 1))
        candidates = tuple(Candidate(name, 1.0, 0.5, 0.1, round=number) for name, number in names)
        ledger = (SimpleNamespace(validate=2.5),)
        return Diagnosis("unknown", "", (), candidates, (("oil.air", "sensor.lag"),), ledger, (), (), {})  # type: ignore[arg-type]

    tests = tuple(test for test in plant_programme() if test.file.endswith(KEPT))
    monkeypatch.setattr(plant_case, "programme", lambda: tests)
    monkeypatch.setattr(module, "diagnose", fake)
    monkeypatch.setattr(module, "warm", module.workshop)
    answer = module.examine(CASE)
    assert (answer.case, answer.verdict, answer.added, answer.trouble) == ("c", "unknown", (), "")
    assert answer.ranking == ("oil.air", "sensor.lag")
    assert answer.confusable == (("oil.air", "sensor.lag"),)
    assert answer.held == 2.5
    assert answer.footprint is not None
    assert answer.footprint > 1000  # a large dead band
    assert answer.code == module.code()
    assert (seen["seed"], seen["workers"]) == (0, 1)
    assert "valve.deadband" not in seen["catalogue"]
    assert len(seen["catalogue"]) == len(module.workshop().catalogue) - 1
    assert "deadband" not in seen["data"]
