"""Cases and results that no calculation is behind."""

from collections.abc import Iterator
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from validation.findings import Finding
from validation.registry import Case
from validation.results import CaseResult, Machine

GOOD = (Finding("a", 1.0, 1.0, "dB"), Finding("b", 0.0, 0.0, "", "no Wine here"))
BAD = (Finding("a", 1.0, 2.0, "dB"), Finding("c | d", 2.5, 2.0, "deg"))
MACHINE = Machine("Linux x86_64", "a processor", 2, "3.11.0")


def made_of(*findings: Finding) -> SimpleNamespace:
    return SimpleNamespace(
        run=lambda: iter(findings), pictures=lambda: {"a picture": Figure()}, notes=lambda: ("a note",)
    )


def broken() -> SimpleNamespace:
    def run() -> Iterator[Finding]:
        yield GOOD[0]
        raise ValueError("no good\nat all")

    return SimpleNamespace(run=run)


def drawing() -> SimpleNamespace:
    def run() -> Iterator[Finding]:
        for seed in (7, 3, 4, 5):
            yield Finding("below its limit", float(np.random.default_rng(seed).random()), 1.0, "")
        yield Finding("the same again", 0.0, 0.0, "", regression=True)

    return SimpleNamespace(run=run)


MODULES = {
    "good": made_of(*GOOD),
    "bad": made_of(*BAD),
    "nan": made_of(Finding("d", float("nan"), 2.0, "deg")),
    "broken": broken(),
}
CASES = {name: Case(f"validation.{name}.case", f"about {name}", "methods", quick=name == "good") for name in MODULES}


def result(name: str, *findings: Finding, date: str = "2026-01-02T03:04:05Z", error: str = "") -> CaseResult:
    return CaseResult(name, f"about {name}", "methods", date, 1.5, 2.5, MACHINE, findings, error)


def use(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the suite know these cases and no others."""
    modules = {**MODULES, "drawing": drawing()}
    monkeypatch.setattr("validation.registry.import_module", lambda module: modules[module.split(".")[1]])
    for module in ("validation.suite", "validation.summary", "validation.page", "validation.results"):
        monkeypatch.setattr(f"{module}.CASES", CASES)
    monkeypatch.setattr("validation.registry.CASES", CASES)
