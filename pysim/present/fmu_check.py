"""What was found about FMUs, shown: text, JSON and page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from pysim.fmu_check import DOUBTFUL, FmuReport
from pysim.present.page import cell, heading, paragraph, statement, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing, Picture

_KIND = {"holds": "pass", "fails": "fail", "doubtful": "beyond", "skipped": ""}
_WORDS = {"holds": "claims hold", "fails": "fail", "doubtful": "are doubtful", "skipped": "were skipped"}


@dataclass(frozen=True)
class Checked:
    """FMUs that were tried.

    Args:
        strict: what is doubtful counts as failing.
    """

    reports: tuple[FmuReport, ...]
    strict: bool = False

    @property
    def passes(self) -> bool:
        return all(one.passes and not (self.strict and one.count(DOUBTFUL)) for one in self.reports)


def text(result: Checked) -> str:
    """Of each FMU the counts in a sentence, and every claim that does not hold."""
    lines = []
    for report in result.reports:
        lines.append(_sentence(report))
        lines += [f"  {one}" for one in report.results if one.verdict in ("fails", "doubtful")]
    return "\n".join(lines)


def data(result: Checked) -> list[dict[str, Any]]:
    """Everything, an entry per FMU."""
    return [
        {"model": one.model, "fmi": one.fmi, "tool": one.tool, "results": [found.data() for found in one.results]}
        for one in result.reports
    ]


def figures(result: Checked) -> Iterator[Picture]:
    """None: claims hold or do not."""
    yield from ()


def page(result: Checked, drawings: Sequence[Drawing], redo: str) -> str:
    """A section per FMU with every claim."""
    parts = [part for report in result.reports for part in _section(report)]
    return whole_page("FMUs under check", "As a strict importer would try them.", parts, redo)


def _sentence(report: FmuReport) -> str:
    """The counts, in a sentence."""
    counts = ", ".join(f"{report.count(verdict)} {words}" for verdict, words in _WORDS.items() if report.count(verdict))
    return f"{report.model} (FMI {report.fmi}{f', {report.tool}' if report.tool else ''}): {counts}."


def _section(report: FmuReport) -> list[str]:
    rows = [
        [
            result.check,
            result.claim,
            "" if result.value is None else f"{result.value:.3g} {result.unit}".strip(),
            "" if result.limit is None else f"{result.limit:g}",
            cell(result.verdict, _KIND[result.verdict]),
            result.detail,
        ]
        for result in report.results
    ]
    return [
        heading(report.model),
        statement(_sentence(report)),
        table("Every claim.", ["check", "claim", "value", "limit", "verdict", "detail"], rows, words=[0, 1, 5]),
        paragraph(
            "Doubtful is what FMI allows, or what samples cannot prove, and what should be looked at: a parameter that "
            "moved nothing, a solver bound to the communication step, a forbidden call that is not refused."
        ),
    ]
