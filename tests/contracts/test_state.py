"""Saved states of every model: a restored run repeats bit for bit."""

import numpy as np
import pytest

from tests.cases import Case
from tests.contracts.fmu import Fmu, Instance

STEPS = 20


def trace(instance: Instance, names: list[str], first: int, last: int, size: float) -> np.ndarray:
    """Values after each communication step."""
    rows = []
    for k in range(first, last):
        instance.step(k * size, size)
        rows.append(instance.get(names))
    return np.array(rows)


def shown(fmu: Fmu) -> list[str]:
    return [v.name for v in fmu.description.modelVariables if v.causality != "independent"]


def test_a_serialised_run_continues_in_another_instance(fmu: Fmu, case: Case) -> None:
    size, names = case.stop / STEPS, shown(fmu)
    with fmu.open("cs") as first, fmu.open("cs") as second:
        first.start(case.settings)
        trace(first, names, 0, STEPS // 2, size)
        saved = first.save()
        expected = trace(first, names, STEPS // 2, STEPS, size)
        second.start(case.settings)
        second.restore(saved)
        np.testing.assert_array_equal(trace(second, names, STEPS // 2, STEPS, size), expected)
        second.restore(saved)
        np.testing.assert_array_equal(trace(second, names, STEPS // 2, STEPS, size), expected)
        assert first.save() == second.save()


def test_a_state_of_model_exchange_comes_back(fmu: Fmu, case: Case) -> None:
    names = shown(fmu)
    with fmu.open("me") as instance:
        instance.start(case.settings)
        before, saved = instance.get(names), instance.save()
        if fmu.states:
            instance.x = instance.x + 0.1
        instance.raw.setTime(0.01)
        instance.restore(saved)
        np.testing.assert_array_equal(instance.get(names), before)


def test_a_damaged_state_is_refused(fmu: Fmu, case: Case) -> None:
    with fmu.open("cs") as instance:
        instance.start(case.settings)
        saved = instance.save()
        with pytest.raises(Exception, match=r"(?i)deserialize"):
            instance.restore(saved[:-1])
        assert instance.messages


def test_reset_starts_all_over(fmu: Fmu, case: Case) -> None:
    size, names = case.stop / STEPS, shown(fmu)
    with fmu.open("cs") as instance:
        instance.start(case.settings)
        expected = trace(instance, names, 0, 5, size)
        instance.raw.reset()
        instance.start(case.settings)
        np.testing.assert_array_equal(trace(instance, names, 0, 5, size), expected)
