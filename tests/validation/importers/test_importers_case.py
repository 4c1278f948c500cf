"""What the case makes of importers' answers; the importers themselves are tried by `pysim validate importers`."""

import numpy as np
import pytest

from validation.importers import case
from validation.importers.derivatives import by_differences, points
from validation.importers.exported import EXPORTED

PUMP = EXPORTED[0]


@pytest.mark.parametrize("exported", EXPORTED, ids=lambda exported: exported.name)
def test_stored_results_are_complete(exported) -> None:
    assert exported.reference().shape == (exported.times.size, len(exported.outputs))
    assert exported.times[-1] == pytest.approx(exported.stop)
    assert exported.off(exported.reference()) == 0.0


def answering(monkeypatch: pytest.MonkeyPatch, values: object, why: str = "") -> None:
    monkeypatch.setattr(case, "answer", lambda *_: (values, why))


def test_the_same_values_hold_and_others_fail(monkeypatch: pytest.MonkeyPatch) -> None:
    reference = PUMP.reference()
    answering(monkeypatch, reference.tolist())
    assert case._imported(PUMP, 2, "pysim").holds
    moved = reference + 2e-4 * np.ptp(reference, axis=0)
    answering(monkeypatch, moved.tolist())
    found = case._imported(PUMP, 2, "pysim")
    assert not found.holds
    assert found.value == pytest.approx(2e-4)


@pytest.mark.parametrize(
    ("importer", "why", "skipped"),
    [
        ("libcosimpy", "it ended with -11: ", True),
        ("CasADi", "RuntimeError: CVode returned CV_FIRST_RHSFUNC_ERR", False),
        ("CasADi", case._MISSING, True),
        ("CasADi", "RuntimeError: something new", False),
        ("pysim", "RuntimeError: Unsupported", False),
    ],
)
def test_what_an_importer_cannot_do_is_told_apart(
    importer: str, why: str, skipped: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    answering(monkeypatch, None, why)
    found = case._imported(PUMP, 3, importer)
    assert bool(found.skipped) is skipped
    assert not found.holds


def test_events_are_beyond_casadi_and_its_partials_are_judged(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = EXPORTED[2]
    assert "events" in case._imported(bench, 2, "CasADi").skipped
    mine = by_differences(bench, 2)
    n = len(points(bench.name).states)
    answering(monkeypatch, mine.tolist())
    assert all(found.holds and found.value == 0.0 for found in case._evaluated(bench, 2, "CasADi, partials"))
    missed = mine.copy()
    missed[:, n + np.abs(mine[-1, n:]).argmax()] = 0.0  # a dependency that the description keeps quiet about
    answering(monkeypatch, missed.tolist())
    derivatives, jacobian = case._evaluated(bench, 2, "CasADi, partials")
    assert derivatives.holds
    assert not jacobian.holds
    assert jacobian.value > 0.1
