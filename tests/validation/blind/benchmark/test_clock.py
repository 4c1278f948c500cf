"""Both cores are handed to the diagnosis, the left-out effect is not, and only the time is kept beside the verdict."""

from types import SimpleNamespace
from typing import Any

import pytest

from validation.blind.benchmark import clock as module
from validation.blind.benchmark import stopwatch
from validation.blind.plant import Case

CASE = Case("c", "left-out", (("oil.air", "large"),), left_out=("oil.air",), seed=2)


def test_a_case_is_timed(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: dict[str, Any] = {}
    now = iter([100.0, 130.0])
    effects = tuple(SimpleNamespace(name=name) for name in ("oil.air", "sensor.lag"))
    shop = SimpleNamespace(model="model", variant=None, catalogue=effects, seconds=4.0)

    def fake(subject: Any, **settings: Any) -> SimpleNamespace:
        seen.update(settings, catalogue=subject)
        shop.seconds += 7.0  # of compiling, which does not count
        return SimpleNamespace(verdict="sensor.lag", added=(SimpleNamespace(effect=effects[1]),))

    monkeypatch.setattr(module, "warm", lambda: shop)
    monkeypatch.setattr(module, "measure", lambda case: SimpleNamespace(dataset=case.name))
    monkeypatch.setattr(module, "subject", lambda model, dataset, catalogue, variant: catalogue)
    monkeypatch.setattr(module, "diagnose", fake)
    monkeypatch.setattr(stopwatch.time, "monotonic", lambda: next(now))
    answer = module.clock_case(CASE)
    assert (answer.case, answer.verdict, answer.added, answer.wall) == ("c", "sensor.lag", ("sensor.lag",), 23.0)
    assert answer.code == module.code()
    assert answer.footprint is None
    assert seen == {"seed": 0, "workers": 2, "catalogue": effects[1:]}
