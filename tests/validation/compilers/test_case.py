"""The comparison of compilers, with FMUs of our own in the place of OpenModelica's."""

from pathlib import Path

import numpy as np
import pytest

import fmu_build
from pysim.io import read_model
from validation.compilers import case
from validation.examples.catalogue import Example, examples

STEP = next(example for example in examples() if example.short == "Validation.SpoolStep")


@pytest.fixture
def other(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """What the other compiler makes: the same model at a spool that is that much faster."""
    faster = [1.0]

    def built(example: Example, compiler: str = "rumoca") -> Path:
        omega = 2 * np.pi * 28.05 * (faster[0] if compiler == "openmodelica" else 1.0)
        return fmu_build.build(example.name, overrides={"spool.omega_v": omega})

    monkeypatch.setattr(case, "built", built)
    return faster


def test_the_same_model_holds_in_both_kinds(other: list[float]) -> None:
    lost, exchange, cosimulation = case.compared(STEP)
    assert (lost.value, lost.limit) == (0, 0)
    assert exchange.value == 0
    assert cosimulation.value == 0
    assert (exchange.limit, cosimulation.limit) == (1e-4, 1e-3)


def test_another_model_fails_and_is_named(other: list[float]) -> None:
    other[0] = 1.01
    _, exchange, cosimulation = case.compared(STEP)
    assert not exchange.holds
    assert "spool." in exchange.claim
    assert not cosimulation.holds


def test_a_class_that_the_other_refuses_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(example: Example, compiler: str = "rumoca") -> Path:
        raise fmu_build.BuildError("omc: Too few equations")

    monkeypatch.setattr(case, "built", refuse)
    [finding] = case.compared(STEP)
    assert not finding.holds
    assert "omc: Too few equations" in finding.claim


def test_a_value_that_is_no_number_is_the_furthest() -> None:
    model = read_model(fmu_build.build(STEP.name))
    line = np.linspace(0, 1, 5)
    ours = {"spool.u": line, "spool.u_t": line}
    finding = case.furthest("x", ours, {"spool.u": line + 0.5, "spool.u_t": line * np.nan}, model, 1.0)
    assert "spool.u_t" in finding.claim
    assert not finding.holds


def test_without_openmodelica_it_is_skipped_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(case, "what_is_missing", lambda: "omc is not installed: get it")
    [finding] = case.run()
    assert finding.skipped == "omc is not installed: get it"


def test_what_both_have_is_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    model = read_model(fmu_build.build(STEP.name))
    names = case.common(model, model)
    assert set(model.abilities.states) <= set(names)
    assert "time" not in names
    assert "spool.omega_v" not in names  # a parameter
