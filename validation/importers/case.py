"""Every importer that is there takes our FMUs and gets the stored results out of them; the checker finds no fault."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

import numpy as np

from pysim.fmu_check import DOUBTFUL, FAILS, FmuReport, check_fmu
from pysim.io import read_model
from validation.findings import Finding
from validation.importers import fmusim
from validation.importers.derivatives import apart, by_differences
from validation.importers.exported import EXPORTED, Exported
from validation.importers.try_one import EULER_STEP, EULERS, EVALUATORS, IMPORTERS

VERSIONS = (2, 3)
_CLOSE, _SAME = 1e-4, 1e-6  # of an output's range: solvers at 1e-6 with events, and the stored results' own digits
_BITS = 1e-13  # the same function called with the same numbers
_DIFFERENCES = 1e-6  # central ones, where the friction's curve is steep
_LONGEST_S = 300.0
_PACKAGES = {"libcosimpy": "libcosimpy", "CasADi": "casadi"}
# What an importer cannot do is no fault of an FMU, and is said in the table; anything else it says is a failure
_NO_FMI_3 = "libcosim knows FMI 1 and 2, and crashes on an FMI 3 archive"
_NO_EVENTS = "its FMU import takes no events into account, and this run goes past some"
_NO_RESTART = (
    "its CVODE is not restarted at an event that changes no state, and from rest one step of it goes past all of them"
)


def notes() -> Sequence[str]:
    """The compatibility information, a line per FMU and per importer."""
    return tuple(" | ".join(row) for row in (*exports(), *compatibility()))


def run() -> Iterator[Finding]:
    """Stored results, importers, checker."""
    for exported in EXPORTED:
        off = exported.off(exported.tight())
        yield Finding(
            f"{exported.name}: stored results against the native loop at 1e-9",
            off,
            _SAME,
            "of the range",
            regression=True,
        )
        for fmi in VERSIONS:
            for importer in IMPORTERS:
                yield _imported(exported, fmi, importer)
            for euler in EULERS:
                yield _by_euler(exported, fmi, euler)
            for evaluator in EVALUATORS:
                yield from _evaluated(exported, fmi, evaluator)
            report = checked(exported.name, fmi)
            told = "; ".join(f"{r.check}: {r.detail}" for r in report.results if r.verdict == FAILS)
            claim = f"{exported.name}, FMI {fmi}: checks that fail{f' ({told})' if told else ''}"
            yield Finding(claim, float(report.count(FAILS)), 0, f"of {len(report.results)}")


def _imported(exported: Exported, fmi: int, importer: str) -> Finding:
    claim = f"{exported.name}, FMI {fmi}, by {importer}: largest difference from the stored results"
    unsupported = _unsupported(exported, fmi, importer)
    if unsupported:
        return Finding(claim, float("nan"), _CLOSE, "of the range", unsupported)
    values, why = answer(exported.name, fmi, importer)
    if values is None:
        return _unanswered(claim, why, _CLOSE, "of the range")
    return Finding(claim, exported.off(np.array(values)), _CLOSE, "of the range")


def _by_euler(exported: Exported, fmi: int, importer: str) -> Finding:
    """The error of first order is twice as large in the coarse run as in the fine one, so their difference takes it."""
    steps = f"{1e6 * EULER_STEP:g} and {5e5 * EULER_STEP:g} us"
    claim = f"{exported.name}, FMI {fmi}, by {importer}, extrapolated from steps of {steps}: largest difference"
    values, why = answer(exported.name, fmi, importer)
    if values is None:
        return _unanswered(claim, why, _CLOSE, "of the range")
    coarse, fine = np.array(values)
    return Finding(claim, exported.off(2.0 * fine - coarse), _CLOSE, "of the range")


def _unsupported(exported: Exported, fmi: int, importer: str) -> str:
    if importer.startswith("libcosimpy") and fmi == 3:
        return _NO_FMI_3
    if importer.startswith("CasADi") and exported.events:
        return _NO_EVENTS
    return _NO_RESTART if importer.startswith("fmusim") and "CVODE" in importer and exported.at_rest else ""


def _unanswered(claim: str, why: str, limit: float, unit: str) -> Finding:
    if why == _MISSING:
        return Finding(claim, float("nan"), limit, unit, "not installed")
    return Finding(f"{claim} ({why})", float("nan"), limit, unit)


def _evaluated(exported: Exported, fmi: int, evaluator: str) -> Iterator[Finding]:
    """What it gets from the same point at the same time as we do, be there events or not."""
    claim = f"{exported.name}, FMI {fmi}, by {evaluator.partition(',')[0]}: derivatives along the run, off ours by"
    values, why = answer(exported.name, fmi, evaluator)
    if values is None:
        yield _unanswered(claim, why, _BITS, "of the largest")
        return
    off, jacobian = apart(exported.name, by_differences(exported, fmi), np.array(values))
    yield Finding(claim, off, _BITS, "of the largest")
    claim = claim.replace("derivatives along the run, off ours by", "Jacobian there, off differences of ours by")
    yield Finding(claim, jacobian, _DIFFERENCES, "of the largest in its row")


_MISSING = "missing"


@cache
def answer(name: str, fmi: int, importer: str) -> tuple[list[list[float]] | None, str]:
    """Values at the communication points, or what the importer said instead."""
    program = importer.partition(",")[0]
    if program in _PACKAGES and importlib.util.find_spec(_PACKAGES[program]) is None:
        return None, _MISSING
    if program == "fmusim" and not fmusim.installed():
        return None, _MISSING
    words = [sys.executable, "-m", "validation.importers.try_one", importer, name, str(fmi)]
    root = Path(__file__).resolve().parents[2]
    try:
        done = subprocess.run(words, cwd=root, capture_output=True, text=True, timeout=_LONGEST_S, check=False)
        data = json.loads(done.stdout)
    except subprocess.TimeoutExpired:
        return None, f"no answer in {_LONGEST_S:g} s"
    except json.JSONDecodeError:
        return None, f"it ended with {done.returncode}: {' '.join(done.stderr.split())[-300:]}"
    return data.get("values"), data.get("error", "")


@cache
def checked(name: str, fmi: int) -> FmuReport:
    """The checker's report."""
    return check_fmu(next(exported for exported in EXPORTED if exported.name == name).build(fmi))


def exports() -> list[list[str]]:
    """A row per FMU: model, FMI, options, inputs, the checker's counts."""
    rows = []
    for exported, fmi in subjects():
        report = checked(exported.name, fmi)
        counts = f"{report.count('holds')} hold, {report.count(DOUBTFUL)} doubtful, {report.count(FAILS)} fail"
        inputs = ", ".join(f"{name} = {value:g}" for name, value in exported.inputs.items()) or "none"
        rows.append([exported.model, f"FMI {fmi}", _options(exported, fmi), inputs, counts])
    return rows


def compatibility() -> list[list[str]]:
    """A row per importer and kind: its name, and what it gets out of each of the FMUs."""
    rows = [[name, *(_word(exported, fmi, name) for exported, fmi in subjects())] for name in IMPORTERS]
    rows += [[name, *(_first_order(exported, fmi, name) for exported, fmi in subjects())] for name in EULERS]
    return rows + [[name, *(_partials(exported, fmi, name) for exported, fmi in subjects())] for name in EVALUATORS]


def subjects() -> list[tuple[Exported, int]]:
    """Every FMU, by class and version."""
    return [(exported, fmi) for exported in EXPORTED for fmi in VERSIONS]


def _word(exported: Exported, fmi: int, importer: str) -> str:
    finding = _imported(exported, fmi, importer)
    return finding.skipped or f"{finding.value:.1e}"


def _first_order(exported: Exported, fmi: int, importer: str) -> str:
    finding = _by_euler(exported, fmi, importer)
    values, _ = answer(exported.name, fmi, importer)
    if values is None:
        return finding.skipped or finding.claim
    return f"{exported.off(np.array(values)[1]):.1e}, extrapolated {finding.value:.1e}"


def _partials(exported: Exported, fmi: int, evaluator: str) -> str:
    found = list(_evaluated(exported, fmi, evaluator))
    return found[0].skipped or " and ".join(f"{finding.value:.1e}" for finding in found)


def _options(exported: Exported, fmi: int) -> str:
    abilities = read_model(exported.build(fmi)).abilities
    told = {
        "model exchange": abilities.model_exchange,
        "co-simulation": abilities.co_simulation,
        "directional derivatives": abilities.directional_derivatives,
        "saved states": abilities.state_handling,
    }
    events = f", {abilities.event_indicators} event indicators" if abilities.event_indicators else ""
    return ", ".join(name for name, there in told.items() if there) + f", {len(abilities.states)} states{events}"
