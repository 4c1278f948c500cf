"""What holds and what does not, as Markdown made from kept results; nothing in it is typed by hand."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path

from pysim.io import write_file
from validation.findings import Finding
from validation.registry import CASES, GROUPS
from validation.results import FAILS, HOLDS, SKIPPED, CaseResult, keep_results, newest, verdict_of

_SEEDS = 4  # shown in a row


def record(root: Path, results: Iterable[CaseResult]) -> Path:
    """Keep results in a checkout, and write its summary anew.

    Returns:
        the file of all that are kept.
    """
    kept_in = root / "validation" / "recorded.jsonl"
    kept = keep_results(kept_in, results)
    write_file(root / "validation" / "RESULTS.md", full_summary(kept))
    return kept_in


def short_summary(results: Iterable[CaseResult]) -> str:
    """A row per group, and which cases fail: of the commit that recorded most cases, and of no other."""
    last = newest(results)
    commit = _commit(last)
    now = {name: result for name, result in last.items() if result.commit == commit}
    rows = []
    for group, title in GROUPS.items():
        names = [name for name, case in CASES.items() if case.group == group]
        done = [now[name] for name in names if name in now]
        counts = [str(sum(result.count(verdict) for result in done)) for verdict in (HOLDS, FAILS, SKIPPED)]
        checks = [finding for result in done for finding in result.checks]
        kept = f"{sum(finding.holds for finding in checks)} of {len(checks)}" if checks else ""
        rows.append([title, f"{len(done)} of {len(names)}", *counts, kept])
    head = ["", "cases recorded", "claims that hold", "fail", "skipped", "regression checks that hold"]
    words = (
        f"Counted: what commit {commit or '-'} recorded. {_of_others(last, commit)} {_missing(last)}",
        _failing(now),
    )
    return "\n".join([*_table(head, rows), "", *words, ""])


def full_summary(results: Iterable[CaseResult], *, kept: bool = True) -> str:
    """A table of cases per group, and below each what fails or was skipped, with the numbers.

    Args:
        kept: of all that is kept, where cases without a result are named too, with links from this folder; else of
            one run.
    """
    results = list(results)
    last = newest(results)
    written = "by `pysim validate --record`: each case's last run" if kept else "by `pysim validate`: one run"
    lines = ["# What holds, and what does not", "", f"Written {written}."]
    lines += ["", short_summary(results).strip()] if kept else []
    head = ["case", "what", "holds", "fails", "skipped", "checks", "CPU s", "date", "commit", "seeds"]
    commit = _commit(last)
    for group, title in GROUPS.items():
        names = [name for name, case in CASES.items() if case.group == group and (kept or name in last)]
        if names:
            labels = {name: f"[{name}]({CASES[name].readme})" if kept else name for name in names}
            rows = [_row(name, labels[name], last.get(name), commit) for name in names]
            others = [f"- {name}: {text}" for name in names if name in last for text in _not_held(last[name])]
            lines += ["", f"## {title}", "", *_table(head, rows), *(["", *others] if others else [])]
    machines = sorted({str(result.machine) for result in last.values()})
    return "\n".join([*lines, "", "Machines: " + "; ".join(machines) + ".", ""])


def _row(name: str, label: str, result: CaseResult | None, commit: str) -> list[str]:
    if result is None:
        return [label, CASES[name].about, "", "", "", "", "", "not recorded", "", ""]
    counts = [str(result.count(verdict)) for verdict in (HOLDS, FAILS, SKIPPED)]
    checks = f"{sum(finding.holds for finding in result.checks)} of {len(result.checks)}" if result.checks else ""
    of = result.commit if result.commit == commit else f"other: {result.commit or '-'}"
    return [label, CASES[name].about, *counts, checks, f"{result.cpu:.0f}", result.date[:10], of, _few(result.seeds)]


def _few(seeds: str) -> str:
    """The first few of many; recorded.jsonl has all."""
    words = seeds.split(", ")
    return seeds if len(words) <= _SEEDS else f"{', '.join(words[:_SEEDS])} and {len(words) - _SEEDS} more"


def _commit(last: Mapping[str, CaseResult]) -> str:
    """The one that recorded most cases, the newest of those."""
    count = Counter(result.commit for result in last.values())
    return max(last.values(), key=lambda result: (count[result.commit], result.date)).commit if last else ""


def _of_others(last: Mapping[str, CaseResult], commit: str) -> str:
    """Which records another commit made, and that they are counted nowhere."""
    others = [name for name, result in last.items() if result.commit != commit]
    return (
        f"Of other commits, and counted nowhere: {', '.join(others)}." if others else "No record is of another commit."
    )


def _missing(last: Mapping[str, CaseResult]) -> str:
    """Which cases have no record at all."""
    missing = [name for name in CASES if name not in last]
    return f"Not recorded: {', '.join(missing)}." if missing else "Every case is recorded."


def _failing(last: Mapping[str, CaseResult]) -> str:
    """How many claims fail, by case."""
    named = [
        f"[{name}]({CASES[name].readme}) ({result.count(FAILS)}{', stopped' if result.error else ''})"
        for name, result in last.items()
        if result.verdict == FAILS
    ]
    return f"Claims that fail: {', '.join(named)}." if named else "No claim of these cases fails."


def _not_held(result: CaseResult) -> list[str]:
    texts = [_sentence(finding) for finding in result.findings if verdict_of(finding) != HOLDS]
    return [*texts, f"stopped: {result.error}"] if result.error else texts


def _sentence(finding: Finding) -> str:
    check = "regression check, " if finding.regression else ""
    return f"{check}{verdict_of(finding)}: {finding.outcome}"


def _table(head: list[str], rows: list[list[str]]) -> list[str]:
    text = [" | ".join(cell.replace("|", "\\|") for cell in row) for row in [head, ["---"] * len(head), *rows]]
    return [f"| {row} |" for row in text]
