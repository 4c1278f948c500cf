"""Answers of an older code that a newer one gives too: a sample, answered again and compared field by field.

A change of words or of structure alone changes the fingerprint, but not one bit of what is computed; another changes
the answers to some cases only. Neither is taken on trust: cases drawn at random are answered again, and the older
answers count for the newer code only where all agree. Those expected to change are named before, and do not count.

Another computer gives other last bits, and a search makes them visible. There the sample is answered by the older code
too, in a checkout of its own, and those answers are compared.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from fnmatch import fnmatchcase
from pathlib import Path

from pysim.io import write_file
from pysim.types import BadInput
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.runs import Choice
from validation.blind.benchmark.stopwatch import today
from validation.blind.benchmark.store import Store
from validation.blind.benchmark.workers import Task, answers
from validation.blind.plant import Case

_OWN = ("code", "day", "wall", "cpu")  # fields that differ between two answers to one case


@dataclass(frozen=True)
class Carried:
    """That one code answers as another did.

    Args:
        older, newer: fingerprints.
        day: on which it was shown, as year-month-day.
        seed: by which the cases were drawn.
        cases: that were answered again, all alike.
        but: patterns of the names of cases for which nothing was shown.
        anew: whether the older code answered them again as well, on the same computer.
    """

    older: str
    newer: str
    day: str
    seed: int
    cases: tuple[str, ...]
    but: tuple[str, ...] = ()
    anew: bool = False


@dataclass(frozen=True)
class Draw:
    """Which answers to give again.

    Args:
        older: fingerprint of the code that gave them.
        sample: how many at random; all where there are fewer.
        seed: of the sample.
        but: patterns of names that are not drawn, with * and ?, since the newer code is to answer them otherwise.
    """

    older: str
    sample: int
    seed: int
    but: tuple[str, ...] = ()

    def of(self, table: Sequence[Case], store: Store) -> list[tuple[Case, Answer]]:
        """Each with its answer.

        Raises:
            BadInput: there are none.
        """
        known = {name: answer for name, answer in store.read().items() if self._asks_for(answer)}
        drawn = Choice(sample=self.sample, seed=self.seed).of([case for case in table if case.name in known])
        if not drawn:
            codes = sorted({answer.code for answer in store.read().values()})
            there = f"those of {', '.join(codes)}" if codes else "none"
            raise BadInput(f"--from {self.older}: the store holds no answers of that code; it holds {there}")
        return [(case, known[case.name]) for case in drawn]

    def _asks_for(self, answer: Answer) -> bool:
        return answer.code == self.older and not _any(self.but, answer.case)


def read_carried(store: Store) -> tuple[Carried, ...]:
    """Of a folder of answers, in the order in which they were shown; none where nothing was."""
    path = _path(store)
    if not path.is_file():
        return ()
    rows = json.loads(path.read_text("utf-8"))
    return tuple(Carried(**{**row, "cases": tuple(row["cases"]), "but": tuple(row["but"])}) for row in rows)


@dataclass(frozen=True)
class Standing:
    """Whose answers count as those of a code: its own, and those carried to it, step by step.

    Args:
        steps: that lead to it, the last first.
        but: fingerprint, the newest first -> patterns of names that some step to the code leaves out; none for its own.
    """

    steps: tuple[Carried, ...]
    but: Mapping[str, tuple[str, ...]]

    def counts(self, answer: Answer) -> bool:
        """Whether that answer stands."""
        return answer.code in self.but and not _any(self.but[answer.code], answer.case)

    def newer(self, one: Answer, other: Answer) -> bool:
        """Of two that stand, whether the one was given by code nearer to this."""
        order = list(self.but)
        return order.index(one.code) < order.index(other.code)


def standing(store: Store, code: str) -> Standing:
    """Of a folder of answers."""
    steps: list[Carried] = []
    but: dict[str, tuple[str, ...]] = {code: ()}
    for step in reversed(read_carried(store)):
        if step.newer in but and step.older not in but:
            steps.append(step)
            but[step.older] = (*but[step.newer], *step.but)
    return Standing(tuple(steps), but)


def carry(
    table: Sequence[Case],
    store: Store,
    task: Task,
    draw: Draw,
    code: str,
    *,
    anew: Store | None = None,
    workers: int = 2,
    limit: float = 900.0,
    say: Callable[[str], None] = print,
) -> bool:
    """Answer a sample of an older code's cases again, and note it where every answer is the same.

    Args:
        code: the fingerprint that answers again.
        anew: answers that the older code gave on this computer; those of `store` where None.
        workers, limit: processes, and s for one case.
    Returns:
        whether all are. Where they are not, nothing is noted or kept, and each difference was said.
    Raises:
        BadInput: nothing was answered by the older code.
    """
    known = dict(draw.of(table, anew or store))
    say(f"{len(known)} cases of code {draw.older} again, by code {code}")
    given: dict[Case, Answer] = {}
    different = 0
    for case, answer in answers(list(known), task, Answer("", code, today()), workers=workers, limit=limit):
        given[case] = Answer.read(answer.line())
        unlike = differences(known[case], given[case])
        different += bool(unlike)
        say(f"{len(given)}/{len(known)} {case.name}: {'; '.join(unlike) or 'the same'}; {answer.wall:.0f} s")
    if different:
        say(f"{different} of {len(known)} differ: the older answers do not stand for this code")
        return False
    for case, answer in given.items():
        store.add(case, answer)
    rows = (
        *read_carried(store),
        Carried(draw.older, code, today(), draw.seed, tuple(case.name for case in known), draw.but, anew is not None),
    )
    write_file(_path(store), json.dumps([asdict(row) for row in rows], indent=1) + "\n")
    return True


def differences(before: Answer, after: Answer) -> list[str]:
    """Fields in which two answers to one case differ, but for when, by which code and how fast they were given."""
    names = [f.name for f in fields(Answer) if f.name not in _OWN]
    return [
        f"{name} {getattr(before, name)!r} became {getattr(after, name)!r}"
        for name in names
        if getattr(before, name) != getattr(after, name)
    ]


def _any(patterns: Sequence[str], name: str) -> bool:
    return any(fnmatchcase(name, pattern) for pattern in patterns)


def _path(store: Store) -> Path:
    return store.folder / "carried.json"
