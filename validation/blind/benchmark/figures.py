"""The benchmark's figures: counts, shares with their intervals, and the targets they are held against."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from scipy import stats

from pysim.types.diagnosis import NONE, UNKNOWN
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.kept import Kept
from validation.blind.plant import Case

VISIBLE = 100.0
"""Footprint from which an effect ought to be named."""
WALL = 60.0  # s
_HELD = 1.05  # residual over noise
_RANGE = 0.9  # in which a band has to hold the true term
_TENTH, _TWICE = 0.1, 2.0  # of the base model's error, of the Cramer-Rao bound

Pair = tuple[Case, Answer]


@dataclass(frozen=True)
class Figure:
    """One figure.

    Args:
        label: what is counted, of what.
        hits, of: how many, of how many.
        target: percent, from and to; None where there is none.
        note: what a reader must know beside it.
    """

    label: str
    hits: int
    of: int
    target: tuple[float, float] | None = None
    note: str = ""

    @property
    def percent(self) -> float:
        """The share; not a number where nothing was counted."""
        return 100.0 * self.hits / self.of if self.of else float("nan")

    @property
    def interval(self) -> tuple[float, float]:
        """95 percent, in percent (Clopper and Pearson 1934, Biometrika 26:404)."""
        if not self.of:
            return 0.0, 100.0
        found = stats.binomtest(self.hits, self.of).proportion_ci(0.95, method="exact")
        return 100.0 * float(found.low), 100.0 * float(found.high)

    @property
    def holds(self) -> bool | None:
        """Whether the share is within the target; None where there is none, or nothing to count."""
        if self.target is None or not self.of:
            return None
        return self.target[0] <= self.percent <= self.target[1]

    @property
    def words(self) -> str:
        """The target as a reader says it."""
        if self.target is None:
            return ""
        low, high = self.target
        return f"at least {low:g} %" if high == 100 else f"at most {high:g} %" if low == 0 else f"{low:g} to {high:g} %"


def paired(table: Iterable[Case], answers: Mapping[str, Answer]) -> list[Pair]:
    """Cases of the table that have an answer, with it."""
    return [(case, answers[case.name]) for case in table if case.name in answers]


def figures(table: Sequence[Case], kept: Kept) -> tuple[Figure, ...]:
    """All of them."""
    return (
        *verdict_figures(table, kept.answers),
        *time_figures(table, kept.answers, kept.clocked),
        *place_figures(table, kept.answers, kept.places),
        *tie_figures(table, kept.followed),
        again_figure(table, kept),
    )


def verdict_figures(table: Sequence[Case], answers: Mapping[str, Answer]) -> tuple[Figure, ...]:
    """How often a verdict is right, and what the repaired model is worth."""
    pairs = paired(table, answers)
    of_kind = {
        kind: [p for p in pairs if p[0].kind == kind] for kind in ("none", "named", "beyond", "left-out", "pair")
    }
    return (
        *_named(of_kind["named"]),
        *_nulls(of_kind["none"]),
        *_outside([*of_kind["beyond"], *of_kind["left-out"]]),
        *_both(of_kind["pair"]),
        *_repair(of_kind["named"]),
        *_cover(of_kind),
        _share("cases without an answer", pairs, lambda p: bool(p[1].trouble), (0, 0)),
    )


def right_first(pair: Pair) -> bool:
    """The verdict is the effect."""
    case, answer = pair
    return bool(case.effects) and answer.verdict == case.effects[0][0]


def tied(pair: Pair) -> bool:
    """Another effect is named first, in a set that holds the right one."""
    case, answer = pair
    right = case.effects[0][0]
    return not right_first(pair) and any(right in group and answer.verdict in group for group in answer.confusable)


def visible(pair: Pair) -> bool:
    """The footprint is large enough for a name; one that is not known, for want of an answer, counts as such."""
    return pair[1].footprint is None or pair[1].footprint >= VISIBLE


def names_something(pair: Pair) -> bool:
    """The verdict is an effect, whether right or wrong."""
    return pair[1].verdict not in ("", NONE, UNKNOWN)


def _share(
    label: str,
    pairs: Sequence[Pair],
    hit: Callable[[Pair], bool],
    target: tuple[float, float] | None = None,
    among: Callable[[Pair], bool] = lambda pair: True,
    note: str = "",
) -> Figure:
    chosen = [pair for pair in pairs if among(pair)]
    return Figure(label, sum(hit(pair) for pair in chosen), len(chosen), target, note)


def _named(pairs: Sequence[Pair]) -> Iterator[Figure]:
    yield _share("right effect named first, footprint 100 or more", pairs, right_first, (95, 100), visible)
    yield _share("right effect among the first two, footprint 100 or more", pairs, _first_two, (99, 100), visible)
    yield _share("another named first, in a set with the right one, footprint 100 or more", pairs, tied, None, visible)
    yield _share("an effect added beside the right one", pairs, lambda p: len(p[1].added) > 1, None, right_first)
    yield _share("right effect named first, footprint below 100", pairs, right_first, None, lambda p: not visible(p))
    yield _share("a wrong effect named, footprint below 100", pairs, _wrong, None, lambda p: not visible(p))


def _first_two(pair: Pair) -> bool:
    return right_first(pair) or pair[0].effects[0][0] in pair[1].ranking


def _wrong(pair: Pair) -> bool:
    return names_something(pair) and not right_first(pair) and not tied(pair)


def _nulls(pairs: Sequence[Pair]) -> Iterator[Figure]:
    yield _share("a physical effect named although none is missing", pairs, names_something, (0, 1))
    yield _share("the same answered with unknown", pairs, lambda p: p[1].verdict == UNKNOWN)
    for kind in ("", "coloured", "start", "offset", "gain", "shift"):
        alone = [pair for pair in pairs if pair[0].nuisances == ((kind,) if kind else ())]
        yield _share(f"named although only {_SPOKEN[kind]}", alone, names_something)
    label = "named although two nuisances or all five are in force"
    yield _share(label, pairs, names_something, None, lambda p: len(p[0].nuisances) > 1)


_SPOKEN = {
    "": "white noise is there",
    "coloured": "the noise is coloured",
    "start": "logs begin before the plate is at rest",
    "offset": "the sensor has an offset",
    "gain": "the sensor's gain is off",
    "shift": "outputs are logged late",
}


def _outside(pairs: Sequence[Pair]) -> Iterator[Figure]:
    def unknown(pair: Pair) -> bool:
        return pair[1].verdict == UNKNOWN

    yield _share("an effect outside the catalogue answered with unknown", pairs, unknown, (90, 100))
    yield _share("a name given to an effect outside the catalogue", pairs, names_something, (0, 5))
    yield _share("answered with unknown, footprint 100 or more", pairs, unknown, None, visible)
    yield _share("a name given, footprint 100 or more", pairs, names_something, None, visible)


def _both(pairs: Sequence[Pair]) -> Iterator[Figure]:
    def both(pair: Pair) -> bool:
        return {name for name, _ in pair[0].effects} <= set(pair[1].added)

    def seen(pair: Pair) -> bool:
        return all(part is None or part >= VISIBLE for part in pair[1].parts.values())

    yield _share("two effects at once, both named", pairs, both, (80, 100))
    yield _share("both named, each with a footprint of 100 or more beside the other", pairs, both, None, seen)
    yield _share("one of the two named", pairs, lambda p: len({n for n, _ in p[0].effects} & set(p[1].added)) == 1)


def _repair(pairs: Sequence[Pair]) -> Iterator[Figure]:
    yield _share(
        "error against the truth after adding at most the larger of a tenth and twice the bound",
        pairs, repaired, (90, 100), lambda p: right_first(p) and None not in (p[1].base, p[1].final, p[1].bound),
    )  # fmt: skip
    yield _share(
        "held-out residual after adding at most 1.05 of the noise",
        pairs, lambda p: (p[1].held or 9.9) <= _HELD, (95, 100), lambda p: bool(p[1].added),
    )  # fmt: skip


def repaired(pair: Pair) -> bool:
    """The error after adding is at most the larger of a tenth of that before and twice the Cramer-Rao bound."""
    answer = pair[1]
    if answer.base is None or answer.final is None or answer.bound is None:
        return False
    return answer.final <= max(_TENTH * answer.base, _TWICE * answer.bound)


def _cover(of_kind: Mapping[str, Sequence[Pair]]) -> Iterator[Figure]:
    for label, kind, target in (
        ("95 percent intervals after the repair that hold the truth", "named", (93.0, 97.0)),
        ("the same of pairs, both named", "pair", None),
        ("the same of the base model where nothing is missing and only white noise is there", "none", None),
    ):
        rows = [a for case, a in of_kind[kind] if a.determined and not case.nuisances]
        total = sum(a.determined for a in rows)
        yield Figure(label, total - sum(len(a.missed) for a in rows), total, target)


def time_figures(
    table: Sequence[Case], answers: Mapping[str, Answer], clocked: Mapping[str, Answer]
) -> Iterator[Figure]:
    """How often a diagnosis is soon enough, and whether two threads answer as one does."""

    def soon(pair: Pair) -> bool:
        return pair[1].wall <= WALL

    def timed(pair: Pair) -> bool:
        return pair[1].wall > 0

    def alike(pair: Pair) -> bool:
        return _same(answers[pair[0].name], pair[1])

    def comparable(pair: Pair) -> bool:
        return pair[0].name in answers

    two = paired(table, clocked)
    yield _share("diagnosed within 60 s, two cores", two, soon, (100, 100), timed, "models compiled")
    yield _share("the same answer with two cores as with one", two, alike, (100, 100), comparable)
    yield _share("diagnosed within 60 s, one core", paired(table, answers), soon, None, timed, "models compiled")


def place_figures(
    table: Sequence[Case], answers: Mapping[str, Answer], places: Mapping[str, Answer]
) -> Iterator[Figure]:
    """Where effects were located without being named; footprints are those of the answers."""
    pairs = paired(table, places)
    large = [pair for pair in pairs if pair[0].name not in answers or visible((pair[0], answers[pair[0].name]))]
    told = [pair for pair in pairs if pair[1].cover is not None]
    yield _share("the slot of the effect located first", pairs, _first_place, (90, 100))
    yield _share("the same, footprint 100 or more", large, _first_place)
    yield _share("the same, or tied with that which is first", large, _tied_place)
    yield _share("the band holds the true term over nine tenths of its range", told, _covered, (90, 100))
    yield _share("the same, its slot located first", told, _covered, None, _first_place)


def tie_figures(table: Sequence[Case], followed: Mapping[str, Answer]) -> Iterator[Figure]:
    """What became of ties once the test that was proposed for them was carried out."""
    ties = [pair for pair in paired(table, followed) if pair[1].settled is not None]
    right = [pair for pair in ties if pair[0].effects[0][0] in pair[1].rivals]
    yield _share("a tie settled by its next test, for the right effect", right, lambda p: bool(p[1].settled), (90, 100))
    yield _share("ties with a next test that the right effect had no part in", ties, lambda p: p not in right)


def again_figure(table: Sequence[Case], kept: Kept) -> Figure:
    """How far answers of older codes, which count by steps of `carry`, are those that newer code gives."""

    def alike(pair: Pair) -> bool:
        return _same(pair[1], kept.answers[pair[0].name])

    label = "the same verdict and effects, where a newer code has answered again what an older one had"
    return _share(label, paired(table, kept.before), alike)


def _first_place(pair: Pair) -> bool:
    return pair[1].rank == 1


def _tied_place(pair: Pair) -> bool:
    from validation.blind.benchmark.slots import SLOTS

    return pair[1].rank == 1 or SLOTS[pair[0].effects[0][0]] in pair[1].alike


def _covered(pair: Pair) -> bool:
    return (pair[1].cover or 0.0) >= _RANGE


def _same(one: Answer, other: Answer) -> bool:
    return (one.verdict, one.added) == (other.verdict, other.added)
