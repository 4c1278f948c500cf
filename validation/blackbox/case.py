"""Printed transfer functions come back from their own responses; intervals of noisy copies hold the truth."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, frequency_deviations
from pysim.identify.blackbox import THESIS_STRUCTURE, Structure, fit_transfer_function, from_thesis_row, thesis_row
from pysim.io import read_dataset
from pysim.thesis import FREQUENCIES_HZ, printed_table, published_deviations, write_dataset
from pysim.types import FrequencyResponse, SineTest
from validation.blackbox.coverage import BenchLog, Coverage, coverage
from validation.findings import Finding
from validation.pump_frequency.case import reference_responses

RUNS = 500
LOUD = 3.0  # percent of full angle: more than half the smallest amplitude
COEFFICIENT_LIMIT, POOLED_LIMIT, RARE = 0.1, 2.0, 1e-3  # percent; percent off 95; of a binomial test


def run() -> Iterator[Finding]:
    """Coefficients, then coverage, then what can be said about Tables 4.3 and 4.4."""
    yield from _own_responses()
    yield from _coverage()
    yield _load_against_no_load()
    yield from _five_poles_for_a_known_plant()


def printed_rows(table: str) -> list[tuple[SineTest, dict[str, float]]]:
    """Test and coefficients of every row of Table "4.1" or "4.3"."""
    rows = []
    for row in printed_table(table):
        test = SineTest(float(row["offset_percent"]), float(row["amplitude_percent"]), "alphaCMD", "alphaPercent")
        columns = {name.partition("_")[0]: name for name in row}
        rows.append((test, {name: float(row[columns[name]]) for name in ("b0", "a4", "a3", "a2", "a1", "a0")}))
    return rows


def worst_coefficient(response: FrequencyResponse, printed: dict[str, float], weights: str) -> float:
    """Largest relative error of a coefficient, percent, when the row is fitted to its own response."""
    found = thesis_row(fit_transfer_function(response, THESIS_STRUCTURE, weights=weights).function)
    return max(abs(found[name] / value - 1) for name, value in printed.items()) * 100


def _own_responses() -> Iterator[Finding]:
    with tempfile.TemporaryDirectory() as folder:  # through the files that stand for the measurements
        responses = read_dataset(write_dataset(Path(folder))).responses()
    rows = printed_rows("4.1")
    for weights in ("uniform", "relative"):
        worst = max(worst_coefficient(r, row, weights) for r, (_, row) in zip(responses, rows, strict=True))
        claim = f"Table 4.1: worst of {6 * len(rows)} coefficients of {len(rows)} rows, {weights} weights"
        yield Finding(claim, worst, COEFFICIENT_LIMIT, "%")
    own = [(from_thesis_row(row).response(np.array(FREQUENCIES_HZ), test), row) for test, row in printed_rows("4.3")]
    worst = max(worst_coefficient(response, row, "uniform") for response, row in own)
    yield Finding("Table 4.3: worst of 12 coefficients of 2 rows", worst, COEFFICIENT_LIMIT, "%")


def _coverage() -> Iterator[Finding]:
    rows = [(test, from_thesis_row(row)) for test, row in printed_rows("4.1") if test.offset > 0]
    known = [coverage(f, THESIS_STRUCTURE, test, runs=RUNS, seed=i) for i, (test, f) in enumerate(rows)]
    yield from judged("noise known, nine rows of Table 4.1", known)
    test, function = rows[4]
    alike, delayed = BenchLog(samples=500), replace(function, dead_time=0.005)
    unknown = coverage(function, THESIS_STRUCTURE, test, runs=RUNS, seed=100, log=alike, noise_known=False)
    yield from judged("noise from the residuals, row 50/10", [unknown])
    loud = coverage(function, THESIS_STRUCTURE, test, runs=RUNS, seed=102, log=BenchLog(noise=LOUD))
    yield from judged(f"noise {LOUD:g} % in place of 0.1 %, row 50/10", [loud])
    late = Structure(5, 0, dead_time_max=0.02)
    yield from judged("with 5 ms dead time, row 50/10", [coverage(delayed, late, test, runs=RUNS, seed=101)])


def judged(title: str, found: Sequence[Coverage]) -> Iterator[Finding]:
    """Pooled coverage, and how many numbers a plain two-sided 99.9 percent binomial test rejects."""
    inside = sum(int(c.inside.sum()) for c in found)
    tried = sum(c.runs * c.inside.size for c in found)
    pooled = 100 * inside / tried
    yield Finding(
        f"{title}: |pooled coverage - 95 %|, it is {pooled:.2f} % of {tried}", abs(pooled - 95), POOLED_LIMIT, "%"
    )
    out = [f"{c.label} {name}" for c in found for name, p in zip(c.names, c.rare, strict=True) if p < RARE]
    numbers = sum(c.inside.size for c in found)
    worst = min(100 * int(c.inside.min()) / c.runs for c in found)
    claim = f"{title}: of {numbers} numbers outside a 99.9 % binomial test (lowest coverage {worst:.1f} %)"
    yield Finding(f"{claim}{': ' if out else ''}{', '.join(out)}", len(out), 0, "numbers")


def _load_against_no_load() -> Finding:
    f = np.array(FREQUENCIES_HZ)
    free = {test: from_thesis_row(row).response(f, test) for test, row in printed_rows("4.1")}
    parts = []
    for test, row in printed_rows("4.3"):
        deviations = frequency_deviations(from_thesis_row(row).response(f, test), free[test])
        parts.append([d.value / d.criterion.limit for d in deviations])
    return Finding(
        "Table 4.3 against 4.1: largest part of a limit of Table 1.3 that load uses up", np.max(parts), 1, ""
    )


def _five_poles_for_a_known_plant() -> Iterator[Finding]:
    """Table 4.4 again, with the independent simulation in place of the measurements that were not published."""
    printed = {(row.offset, row.amplitude): row.values for row in published_deviations("4.4")}
    worst, beside = np.zeros(4), np.zeros(4)
    for response in reference_responses("free"):
        fit = fit_transfer_function(response, replace(THESIS_STRUCTURE, stable=True))
        found = frequency_deviations(fit.function.response(response.frequency, response.test), response)
        values = np.array([d.value for d in found])
        worst = np.maximum(worst, values)
        beside = np.maximum(beside, printed[response.test.offset, response.test.amplitude])
    for criterion, value, theirs in zip(FREQUENCY_CRITERIA, worst, beside, strict=True):
        claim = f"five stable poles against the free set's simulation, worst {criterion.name} (Table 4.4: {theirs:g})"
        yield Finding(claim, float(value), criterion.limit, criterion.unit)
