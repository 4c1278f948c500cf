"""What was found about FMUs, in words, as a page's parts and as data."""

from __future__ import annotations

from typing import Any

from pysim.fmu_check import FmuReport
from pysim.present.page import cell, heading, paragraph, statement, table

_KIND = {"holds": "pass", "fails": "fail", "doubtful": "beyond", "skipped": ""}


def fmu_check_sentence(report: FmuReport) -> str:
    """The counts, in a sentence."""
    counts = ", ".join(f"{report.count(verdict)} {words}" for verdict, words in _WORDS.items() if report.count(verdict))
    return f"{report.model} (FMI {report.fmi}{f', {report.tool}' if report.tool else ''}): {counts}."


def fmu_check_text(report: FmuReport) -> str:
    """The sentence, and every claim that does not hold."""
    told = [f"  {result}" for result in report.results if result.verdict in ("fails", "doubtful")]
    return "\n".join([fmu_check_sentence(report), *told])


def fmu_check_parts(report: FmuReport) -> list[str]:
    """A section of a page."""
    rows = [
        [
            cell(result.check, "words"),
            cell(result.claim, "words"),
            cell("" if result.value is None else f"{result.value:.3g} {result.unit}".strip()),
            cell("" if result.limit is None else f"{result.limit:g}"),
            cell(result.verdict, _KIND[result.verdict]),
            cell(result.detail, "words"),
        ]
        for result in report.results
    ]
    return [
        heading(report.model),
        statement(fmu_check_sentence(report)),
        table("Every claim.", ["check", "claim", "value", "limit", "verdict", "detail"], rows),
        paragraph(
            "Doubtful is what FMI allows, or what samples cannot prove, and what should be looked at: a parameter that "
            "moved nothing, a solver bound to the communication step, a forbidden call that is not refused."
        ),
    ]


def fmu_check_data(report: FmuReport) -> dict[str, Any]:
    """For JSON."""
    return {
        "model": report.model,
        "fmi": report.fmi,
        "tool": report.tool,
        "results": [result.data() for result in report.results],
    }


_WORDS = {"holds": "claims hold", "fails": "fail", "doubtful": "are doubtful", "skipped": "were skipped"}
