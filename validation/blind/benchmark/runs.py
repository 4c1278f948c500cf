"""Which cases to answer, and the run that answers them."""

from __future__ import annotations

import time
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase

import numpy as np

from pysim.types import BadInput
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.stopwatch import today
from validation.blind.benchmark.store import Store
from validation.blind.benchmark.workers import Task, answers
from validation.blind.plant import Case

KINDS = ("none", "named", "beyond", "left-out", "pair")


@dataclass(frozen=True)
class Choice:
    """Some cases of a table.

    Args:
        kinds: of them; all where empty.
        names: pattern of their names, with * and ?.
        sample: how many at random; None takes all.
        seed: of the sample.
        shard: the k-th of n equal parts, (k, n) with k from 1.
    Raises:
        BadInput: an unknown kind, or a part that is not there.
    """

    kinds: tuple[str, ...] = ()
    names: str = "*"
    sample: int | None = None
    seed: int = 0
    shard: tuple[int, int] = (1, 1)

    def __post_init__(self) -> None:
        for kind in self.kinds:
            if kind not in KINDS:
                raise BadInput(f"--kinds: there is no kind {kind!r}; there are {', '.join(KINDS)}")
        k, n = self.shard
        if not 1 <= k <= n:
            raise BadInput(f"--shard {k}/{n}: there is no such part; the first of n is 1/n, the last n/n")

    def of(self, table: Sequence[Case]) -> list[Case]:
        """In an order that mixes all kinds, so that what is done after a while stands for the whole."""
        found = [c for c in table if (not self.kinds or c.kind in self.kinds) and fnmatchcase(c.name, self.names)]
        found.sort(key=lambda case: zlib.crc32(case.name.encode()))
        if self.sample is not None and self.sample < len(found):
            taken = np.random.default_rng(self.seed).choice(len(found), self.sample, replace=False)
            found = [found[i] for i in sorted(taken.tolist())]
        k, n = self.shard
        return found[k - 1 :: n]


def run(
    chosen: Sequence[Case],
    store: Store,
    task: Task,
    code: str,
    *,
    counts: Callable[[Answer], bool] | None = None,
    workers: int = 2,
    limit: float = 900.0,
    say: Callable[[str], None] = print,
) -> int:
    """Answer what the store does not hold of this code, and add it there case by case.

    Args:
        code: fingerprint; answers of another code are given again.
        counts: whether an answer need not be given again; those of this code alone where None.
        workers: processes, of one thread each.
        limit: s for one case, judging and the start of its process included.
    Returns:
        how many cases were answered.
    """
    known = store.read()
    done_with = counts or (lambda answer: answer.code == code)
    open_ = [case for case in chosen if case.name not in known or not done_with(known[case.name])]
    say(f"{len(open_)} of {len(chosen)} cases to answer, code {code}")
    blank = Answer("", code, today())
    begun = time.monotonic()
    for done, (case, answer) in enumerate(answers(open_, task, blank, workers=workers, limit=limit), start=1):
        store.add(case, answer)
        left = (time.monotonic() - begun) / done * (len(open_) - done)
        said = answer.verdict or answer.trouble
        say(f"{done}/{len(open_)} {case.name}: {said}; {answer.wall:.0f} s; {_spoken(left)} left")
    return len(open_)


def _spoken(seconds: float) -> str:
    return f"{seconds / 3600:.1f} h" if seconds > 5400 else f"{seconds / 60:.0f} min"
