"""The suite's HTML page: what holds, what does not, and why, with the figures redone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from pysim.io import write_file
from pysim.present.page import cell, commands, heading, items, page, paragraph, picture, statement, table
from pysim.present.render import render
from validation.findings import Finding
from validation.registry import CASES, GROUPS
from validation.results import FAILS, HOLDS, SKIPPED, CaseResult, verdict_of
from validation.summary import full_summary

_KIND = {HOLDS: "pass", FAILS: "fail", SKIPPED: ""}


def write_page(folder: Path, results: Sequence[CaseResult]) -> None:
    """Write report.html, summary.md and the pictures of a run, which are made anew."""
    drawn: dict[str, Mapping[str, Figure]] = {}
    for result in results:
        drawn[result.case] = {} if result.error else CASES[result.case].pictures()
        for k, figure in enumerate(drawn[result.case].values(), 1):
            write_file(folder / f"{result.case}-{k}.png", render(figure, "png"))
    write_file(folder / "report.html", suite_page(results, drawn))
    write_file(folder / "summary.md", full_summary(results, kept=False))


def suite_page(results: Sequence[CaseResult], drawn: Mapping[str, Mapping[str, Figure]]) -> str:
    """The page of one run.

    Args:
        results: of this run, in the order they ran.
        drawn: case -> caption -> figure.
    """
    parts = [statement(_verdict(results)), _overview(results)]
    for group, title in GROUPS.items():
        for result in (result for result in results if result.group == group):
            parts += [heading(f"{title}: {result.case}"), *_case(result)]
            figures = drawn.get(result.case, {})
            parts += [picture(render(figure, "svg"), caption) for caption, figure in figures.items()]
    lead = f"{len(results)} cases on {results[0].machine}, {results[0].date}" if results else "no case was run"
    commit = f", commit {results[0].commit}" if results and results[0].commit else ""
    return page("Validation", f"{lead}{commit}", parts)


def _verdict(results: Sequence[CaseResult]) -> str:
    counts = {verdict: sum(result.count(verdict) for result in results) for verdict in (HOLDS, FAILS, SKIPPED)}
    stopped = sum(bool(result.error) for result in results)
    text = f"{counts[HOLDS]} claims hold, {counts[FAILS]} fail, {counts[SKIPPED]} could not be tried here."
    checks = [finding for result in results for finding in result.checks]
    if checks:
        text += f" Of {len(checks)} regression checks {sum(finding.holds for finding in checks)} hold."
    return f"{text} {stopped} cases stopped early." if stopped else text


def _overview(results: Sequence[CaseResult]) -> str:
    rows = [
        [
            result.case,
            CASES[result.case].about if result.case in CASES else result.about,
            *(str(result.count(verdict)) for verdict in (HOLDS, FAILS, SKIPPED)),
            f"{result.seconds:.1f}",
            f"{result.cpu:.1f}",
            cell(result.verdict, _KIND[result.verdict]),
        ]
        for result in results
    ]
    head = ["case", "what", "holds", "fails", "skipped", "seconds", "CPU s", "verdict"]
    return table("Every case of this run.", head, rows, words=[0, 1])


def _case(result: CaseResult) -> list[str]:
    notes = CASES[result.case].notes() if result.case in CASES else ()
    parts = [paragraph(f"{result.about[:1].upper()}{result.about[1:]}."), commands(f"pysim validate {result.case}")]
    if result.error:
        parts.append(paragraph(f"Stopped: {result.error}", note=True))
    if notes:
        parts.append(items(notes))
    head = ["claim", "value", "limit", "unit", "verdict"]
    return [*parts, table("Claims.", head, [*map(_claim, result.findings)], words=[0])]


def _claim(finding: Finding) -> list[str]:
    verdict = verdict_of(finding)
    said = finding.skipped or ""
    value = "" if finding.skipped else f"{finding.value:.4g}"
    claim = f"{finding.claim} ({said})" if said else finding.claim
    claim = f"regression check: {claim}" if finding.regression else claim
    beside = [f"if wrong: {finding.alternative}"] if finding.alternative else []
    beside += [f"limit: {finding.source}"] if finding.source else []
    claim = f"{claim} [{'; '.join(beside)}]" if beside else claim
    return [claim, value, f"{finding.limit:g}", finding.unit, cell(verdict, _KIND[verdict])]
