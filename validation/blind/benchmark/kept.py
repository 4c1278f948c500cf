"""What was stored of the cases and stands for this code, folder by folder."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.carry import Carried, Standing, standing
from validation.blind.benchmark.fingerprint import fingerprint
from validation.blind.benchmark.store import AGAIN, CLOCKED, FOLLOWED, PLACES, Store


@dataclass(frozen=True)
class Kept:
    """Case -> answer, for each of the commands.

    Args:
        answers: verdicts, judged; where an older code has answered and a newer one again, what the newer one says.
        places: where effects were located.
        followed: what became of ties once the next test was carried out.
        clocked: how long cases took with two cores.
        before: what older codes have said where a newer one has answered again.
        stale: how many verdicts of other code are stored that do not count.
        carried: why those of other code that are among `answers` count.
    """

    answers: Mapping[str, Answer] = field(default_factory=dict)
    places: Mapping[str, Answer] = field(default_factory=dict)
    followed: Mapping[str, Answer] = field(default_factory=dict)
    clocked: Mapping[str, Answer] = field(default_factory=dict)
    before: Mapping[str, Answer] = field(default_factory=dict)
    stale: int = 0
    carried: tuple[Carried, ...] = ()


def read_kept(answers: Store | None = None) -> Kept:
    """What this package holds; its verdicts, or those of another folder."""
    store, code = answers or Store(), fingerprint()
    stored, alike = store.read(), standing(store, code)
    counted = _counted(stored, alike)
    places, followed, clocked = (
        _counted(one.read(), standing(one, own))
        for one, own in (
            (Store(PLACES), fingerprint(places=True)),
            (Store(FOLLOWED), code),
            (Store(CLOCKED), code),
        )
    )
    again = _counted(Store(AGAIN).read(), alike)  # what carries one answer to a case carries another
    before = {n: a for n, a in counted.items() if n in again and alike.newer(again[n], a)}
    newest = {**counted, **{name: again[name] for name in before}}
    return Kept(newest, places, followed, clocked, before, stale=len(stored) - len(counted), carried=alike.steps)


def _counted(stored: Mapping[str, Answer], alike: Standing) -> dict[str, Answer]:
    return {name: answer for name, answer in stored.items() if alike.counts(answer)}
