"""All that was stored of the cases, folder by folder."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.store import CLOCKED, FOLLOWED, PLACES, Store


@dataclass(frozen=True)
class Kept:
    """Case -> answer, for each of the commands.

    Args:
        answers: verdicts, judged.
        places: where effects were located.
        followed: what became of ties once the next test was carried out.
        clocked: how long cases took with two cores.
    """

    answers: Mapping[str, Answer] = field(default_factory=dict)
    places: Mapping[str, Answer] = field(default_factory=dict)
    followed: Mapping[str, Answer] = field(default_factory=dict)
    clocked: Mapping[str, Answer] = field(default_factory=dict)


def read_kept(answers: Store | None = None) -> Kept:
    """What this package holds; its verdicts, or those of another folder."""
    return Kept((answers or Store()).read(), Store(PLACES).read(), Store(FOLLOWED).read(), Store(CLOCKED).read())
