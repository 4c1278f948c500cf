"""Two solvers on one FMU, the measure of their difference, and the quickest examples against their stored results."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from validation.examples import runs, stored
from validation.examples.__main__ import main
from validation.examples.case import compared
from validation.examples.catalogue import Example, examples

QUICK = ("Validation.ChamberFilling", "Validation.SpoolStep", "Validation.EndStop", "Validation.CoastDown")
BY_NAME = {example.short: example for example in examples()}


def test_off_is_over_the_span_or_what_the_solvers_resolve() -> None:
    ramp = np.array([0.0, 5.0, 10.0])
    assert runs.off(ramp + np.array([0, 0.1, 0]), ramp, None) == pytest.approx(0.01)
    flat = np.full(3, 2e5)
    assert runs.off(flat + 2.0, flat, 1e6) == pytest.approx(2e-3)  # a thousandth of the nominal 1e6 counts
    assert runs.off(np.full(3, 1e-9), np.zeros(3), None) == pytest.approx(1e-6)


@pytest.mark.parametrize("name", QUICK)
def test_a_quick_example_is_as_it_was(name: str) -> None:
    finding = compared(BY_NAME[name])
    assert finding.holds, finding
    assert not finding.skipped


def test_a_changed_model_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    example = BY_NAME["Validation.SpoolStep"]
    text = example.file.read_text(encoding="utf-8").splitlines()
    time, first, *rest = text[100].split(",")
    text[100] = ",".join([time, repr(float(first) + 1e-3), *rest])
    monkeypatch.setattr("validation.examples.catalogue.RESULTS", tmp_path)
    example.file.write_text("\n".join(text), encoding="utf-8")
    finding = compared(example)
    assert not finding.holds
    assert "spool.u" in finding.claim


def test_storing_gives_the_stored_result_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The command that made the file, to the digits a different machine may have."""
    example = BY_NAME["Validation.SpoolStep"]
    before = stored.read(example)
    monkeypatch.setattr("validation.examples.catalogue.RESULTS", tmp_path)
    assert main(["store", example.short]) == 0
    after = stored.read(example)
    assert list(before) == list(after)
    assert all(np.allclose(before[name], after[name], rtol=1e-6, atol=1e-8) for name in before)


def test_states_are_thinned_out_evenly() -> None:
    def with_states(count: int) -> SimpleNamespace:
        names = tuple(f"x{k}" for k in range(count))
        return SimpleNamespace(abilities=SimpleNamespace(states=names), variables=())

    assert runs.columns(with_states(12)) == tuple(f"x{k}" for k in range(12))
    assert runs.columns(with_states(25)) == tuple(f"x{k}" for k in range(0, 25, 3))


def test_wrong_names_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["store", "Examples.Nothing"]) == 2
    assert "no example named Examples.Nothing; there are Examples.ActiveHeave" in capsys.readouterr().err
    assert main(["list", "Examples.SteadyFlow"]) == 0


def test_an_example_whose_library_is_missing_is_skipped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MODELICAPATH", raising=False)
    finding = compared(Example("HydraulicTestBenchMSL.Examples.Payload", 5.0))
    assert finding.skipped == "no Modelica 4.0.0 on MODELICAPATH"
