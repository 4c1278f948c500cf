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
from validation.importers.exported import EXPORTED, Exported
from validation.importers.try_one import IMPORTERS

VERSIONS = (2, 3)
_CLOSE, _SAME = 1e-4, 1e-6  # of an output's range: solvers at 1e-6 with events, and the stored results' own digits
_LONGEST_S = 300.0
_PACKAGES = {"libcosimpy": "libcosimpy", "CasADi": "casadi"}
# What an importer cannot do is no fault of an FMU, and is said in the table; anything else it says is a failure
_UNSUPPORTED = {("libcosimpy", 3): "libcosim knows FMI 1 and 2, and crashes on an FMI 3 archive"}
_KNOWN = {
    (
        "CasADi",
        "CV_FIRST_RHSFUNC_ERR",
    ): "it sets states by fmi2SetReal in event mode; FMI 2.0 Section 3.2.3 forbids that",
}


def notes() -> Sequence[str]:
    """The compatibility information, a line per FMU."""
    return tuple(" | ".join(row) for row in compatibility())


def run() -> Iterator[Finding]:
    """Stored results, importers, checker."""
    for exported in EXPORTED:
        off = exported.off(exported.tight())
        yield Finding(f"{exported.name}: stored results against the native loop at 1e-9", off, _SAME, "of the range")
        for fmi in VERSIONS:
            for importer in IMPORTERS:
                yield _imported(exported, fmi, importer)
            report = checked(exported.name, fmi)
            told = "; ".join(f"{r.check}: {r.detail}" for r in report.results if r.verdict == FAILS)
            claim = f"{exported.name}, FMI {fmi}: checks that fail{f' ({told})' if told else ''}"
            yield Finding(claim, float(report.count(FAILS)), 0, f"of {len(report.results)}")


def _imported(exported: Exported, fmi: int, importer: str) -> Finding:
    claim = f"{exported.name}, FMI {fmi}, by {importer}: largest difference from the stored results"
    if (importer, fmi) in _UNSUPPORTED:
        return Finding(claim, float("nan"), _CLOSE, "of the range", _UNSUPPORTED[importer, fmi])
    values, why = answer(exported.name, fmi, importer)
    if values is not None:
        return Finding(claim, exported.off(np.array(values)), _CLOSE, "of the range")
    known = [text for (name, word), text in _KNOWN.items() if name == importer and word in why]
    missing = "not installed" if why == _MISSING else ""
    if known or missing:
        return Finding(claim, float("nan"), _CLOSE, "of the range", missing or known[0])
    return Finding(f"{claim} ({why})", float("nan"), _CLOSE, "of the range")


_MISSING = "missing"


@cache
def answer(name: str, fmi: int, importer: str) -> tuple[list[list[float]] | None, str]:
    """Values at the communication points, or what the importer said instead."""
    if importer in _PACKAGES and importlib.util.find_spec(_PACKAGES[importer]) is None:
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


def compatibility() -> list[list[str]]:
    """A row per FMU: model, FMI, options, inputs, importers with their difference, the checker's counts."""
    rows = []
    for exported in EXPORTED:
        for fmi in VERSIONS:
            report = checked(exported.name, fmi)
            counts = f"{report.count('holds')} hold, {report.count(DOUBTFUL)} doubtful, {report.count(FAILS)} fail"
            importers = [f"{name}: {_word(exported, fmi, name)}" for name in IMPORTERS]
            inputs = ", ".join(f"{name} = {value:g}" for name, value in exported.inputs.items()) or "none"
            rows.append([exported.model, f"FMI {fmi}", _options(exported, fmi), inputs, *importers, counts])
    return rows


def _word(exported: Exported, fmi: int, importer: str) -> str:
    finding = _imported(exported, fmi, importer)
    return finding.skipped or f"{finding.value:.1e}"


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
