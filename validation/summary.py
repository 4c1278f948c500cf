"""What holds and what does not, as Markdown made from kept results; nothing in it is typed by hand."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path

from pysim.io import write_file
from validation.findings import Finding
from validation.registry import CASES, GROUPS
from validation.results import FAILS, HOLDS, SKIPPED, CaseResult, keep_results, newest, verdict_of


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
    """A row per group, and which cases fail."""
    last = newest(results)
    rows = []
    for group, title in GROUPS.items():
        names = [name for name, case in CASES.items() if case.group == group]
        done = [last[name] for name in names if name in last]
        counts = [str(sum(result.count(verdict) for result in done)) for verdict in (HOLDS, FAILS, SKIPPED)]
        rows.append([title, f"{len(done)} of {len(names)}", *counts])
    head = ["", "cases recorded", "claims that hold", "fail", "skipped"]
    words = (_failing(last), _commits(last))
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
    head = ["case", "what", "holds", "fails", "skipped", "CPU s", "date", "commit"]
    for group, title in GROUPS.items():
        names = [name for name, case in CASES.items() if case.group == group and (kept or name in last)]
        if names:
            rows = [_row(name, f"[{name}]({CASES[name].readme})" if kept else name, last.get(name)) for name in names]
            others = [f"- {name}: {text}" for name in names if name in last for text in _not_held(last[name])]
            lines += ["", f"## {title}", "", *_table(head, rows), *(["", *others] if others else [])]
    machines = sorted({str(result.machine) for result in last.values()})
    return "\n".join([*lines, "", "Machines: " + "; ".join(machines) + ".", ""])


def _row(name: str, label: str, result: CaseResult | None) -> list[str]:
    if result is None:
        return [label, CASES[name].about, "", "", "", "", "not recorded", ""]
    counts = [str(result.count(verdict)) for verdict in (HOLDS, FAILS, SKIPPED)]
    return [label, CASES[name].about, *counts, f"{result.cpu:.0f}", result.date[:10], result.commit or "-"]


def _commits(last: Mapping[str, CaseResult]) -> str:
    """How many cases each commit has recorded."""
    counts = Counter(result.commit for result in last.values())
    named = [f"{count} by commit {commit}" for commit, count in counts.most_common() if commit]
    if counts[""]:
        named.append(f"{counts['']} before commits were noted")
    return f"Cases recorded: {', '.join(named)}." if named else ""


def _failing(last: Mapping[str, CaseResult]) -> str:
    """How many claims fail, by case."""
    named = [
        f"[{name}]({CASES[name].readme}) ({result.count(FAILS)}{', stopped' if result.error else ''})"
        for name, result in last.items()
        if result.verdict == FAILS
    ]
    return f"Claims that fail: {', '.join(named)}." if named else "No claim of a recorded case fails."


def _not_held(result: CaseResult) -> list[str]:
    texts = [_sentence(finding) for finding in result.findings if verdict_of(finding) != HOLDS]
    return [*texts, f"stopped: {result.error}"] if result.error else texts


def _sentence(finding: Finding) -> str:
    return f"{verdict_of(finding)}: {finding.outcome}"


def _table(head: list[str], rows: list[list[str]]) -> list[str]:
    text = [" | ".join(cell.replace("|", "\\|") for cell in row) for row in [head, ["---"] * len(head), *rows]]
    return [f"| {row} |" for row in text]
