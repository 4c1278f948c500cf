"""`python -m validation`: every case can be found, and what it finds decides the exit code."""

from collections.abc import Iterator
from importlib import import_module
from types import SimpleNamespace

import pytest

from validation import __main__ as command
from validation.findings import Finding
from validation.registry import CASES, Case


@pytest.mark.parametrize("name", CASES)
def test_every_case_has_a_run(name: str) -> None:
    assert callable(import_module(CASES[name].module).run)


@pytest.fixture
def cases(monkeypatch: pytest.MonkeyPatch) -> None:
    def made_of(*findings: Finding) -> SimpleNamespace:
        def run() -> Iterator[Finding]:
            yield from findings

        return SimpleNamespace(run=run)

    modules = {
        "good": made_of(Finding("a", 1.0, 1.0, "dB"), Finding("b", 0.0, 0.0, "", "no Wine here")),
        "bad": made_of(Finding("a", 1.0, 2.0, "dB"), Finding("c", 2.5, 2.0, "deg")),
        "nan": made_of(Finding("d", float("nan"), 2.0, "deg")),
    }
    monkeypatch.setattr("validation.registry.import_module", modules.__getitem__)
    monkeypatch.setattr(command, "CASES", {name: Case(name, f"about {name}") for name in modules})


@pytest.mark.usefixtures("cases")
@pytest.mark.parametrize(
    ("words", "code"),
    [(["good"], 0), (["bad"], 1), (["nan"], 1), (["bad", "good"], 1), (["--all"], 1), (["--list"], 0)],
)
def test_exit_code(words: list[str], code: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert command.main(words) == code
    out = capsys.readouterr().out
    if "bad" in words:
        assert "FAILS    c: 2.5 deg, limit 2" in out
    if "good" in words:
        assert "skipped  b: no Wine here" in out


@pytest.mark.usefixtures("cases")
@pytest.mark.parametrize("words", [[], ["none"], ["--nonsense"]])
def test_wrong_use(words: list[str]) -> None:
    assert command.main(words) == 2
