"""A few cases of the blind benchmark answered by this commit, and the targets on all that it has answered."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from scipy import stats

from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.examine import examine
from validation.blind.benchmark.figures import Pair, detectable, figures, paired
from validation.blind.benchmark.runs import answer_cases, choose, folder_of
from validation.blind.plant import Case, cases
from validation.commit import this_commit
from validation.findings import Finding

TABLE_SEED = 1
SAMPLE = 12
"""Cases that are answered where the whole benchmark was not run; always the same."""
_WRONG = 0.1  # share of wrong verdicts that the targets allow, all kinds together


def run(count: int = SAMPLE, task: Callable[[Case], Answer] = examine, folder: Path | None = None) -> Iterator[Finding]:
    """Answer the first cases where this commit has not, then judge all that it has answered.

    Args:
        folder: of answers; this commit's where None.
    """
    commit, table = this_commit(), cases(TABLE_SEED)
    answers = answer_cases(choose(table, count=count), task, folder or folder_of(commit, TABLE_SEED), commit)
    pairs = paired(table, answers)
    yield wrong_verdicts(pairs)
    yield from targets(pairs)


def wrong_verdicts(pairs: Sequence[Pair]) -> Finding:
    """Of all detectable cases; more wrong than the limit would happen once in a thousand times at `_WRONG`."""
    large = [pair for pair in pairs if not pair[0].effects or detectable(pair)]
    wrong = [f"{case.name} ({answer.verdict or answer.trouble})" for case, answer in large if not _right(case, answer)]
    claim = f"wrong verdicts of {len(large)} detectable cases{': ' if wrong else ''}{', '.join(wrong[:5])}"
    return Finding(claim, len(wrong), float(stats.binom.ppf(0.999, len(large), _WRONG)), "")


def _right(case: Case, answer: Answer) -> bool:
    """The verdict is right, and of a pair both are added."""
    return answer.verdict in case.expected and (case.kind != "pair" or set(case.expected) <= set(answer.added))


def targets(pairs: Sequence[Pair]) -> Iterator[Finding]:
    """Every figure with a target as a claim; skipped where too few cases were answered to judge it."""
    for figure in figures(pairs):
        if figure.target is not None:
            claim = f"{figure.label}: {figure.hits} of {figure.of}, {figure.words}; beyond by"
            few = f"judged from {figure.least} cases on; run the whole benchmark" if figure.of < figure.least else ""
            yield Finding(claim, figure.beyond, 0, "%", skipped=few)
