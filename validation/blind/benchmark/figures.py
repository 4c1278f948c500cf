"""The benchmark's figures: counts, shares with their intervals, and the targets they are held against."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from scipy import stats

from pysim.types.diagnosis import NONE, UNKNOWN
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.runs import KINDS
from validation.blind.plant import Case

DETECTABLE = 100.0
"""Detectability from which an effect ought to be named."""
WALL = 60.0  # s
_NOISE_ONLY = 1.05  # residual over noise
_TENTH, _TWICE = 0.1, 2.0  # of the base model's error, of the Cramer-Rao bound

Pair = tuple[Case, Answer]


@dataclass(frozen=True)
class Figure:
    """One figure.

    Args:
        label: what is counted, of what.
        hits, of: how many, of how many.
        target: percent, from and to; None where there is none.
    """

    label: str
    hits: int
    of: int
    target: tuple[float, float] | None = None

    @property
    def percent(self) -> float:
        """The share; not a number where nothing was counted."""
        return 100.0 * self.hits / self.of if self.of else math.nan

    @property
    def interval(self) -> tuple[float, float]:
        """95 percent, in percent (Clopper and Pearson 1934, Biometrika 26:404)."""
        if not self.of:
            return 0.0, 100.0
        found = stats.binomtest(self.hits, self.of).proportion_ci(0.95, method="exact")
        return 100.0 * float(found.low), 100.0 * float(found.high)

    @property
    def least(self) -> int:
        """Cases to be counted before the target is judged, so that one of them cannot decide it."""
        allowed = min(share for low, high in [self.target or (0.0, 100.0)] for share in (100.0 - low, high) if share)
        return math.ceil(100.0 / allowed)

    @property
    def beyond(self) -> float:
        """Percent by which the share misses its target; 0 where it is met."""
        low, high = self.target or (0.0, 100.0)
        return max(low - self.percent, self.percent - high, 0.0)

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


def figures(pairs: Sequence[Pair]) -> tuple[Figure, ...]:
    """How often a verdict is right, what the repaired model is worth, and how long it takes."""
    of_kind = {kind: [p for p in pairs if p[0].kind == kind] for kind in KINDS}
    return (
        *_named(of_kind["named"]),
        *_nulls(of_kind["none"]),
        *_outside([*of_kind["beyond"], *of_kind["left-out"]]),
        *_both(of_kind["pair"]),
        *_repair(of_kind["named"]),
        *_cover(of_kind),
        _share("cases without an answer", pairs, lambda p: bool(p[1].trouble), (0, 0)),
        _share(
            f"diagnosed within {WALL:g} s, one core (models compiled)", pairs, lambda p: p[1].wall <= WALL, among=_timed
        ),
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


def detectable(pair: Pair) -> bool:
    """Large enough for a name; one whose size is not known, for want of an answer, counts as such."""
    return pair[1].detectability is None or pair[1].detectability >= DETECTABLE


def names_something(pair: Pair) -> bool:
    """The verdict is an effect, whether right or wrong."""
    return pair[1].verdict not in ("", NONE, UNKNOWN)


def _timed(pair: Pair) -> bool:
    return pair[1].wall > 0


def _share(
    label: str,
    pairs: Sequence[Pair],
    hit: Callable[[Pair], bool],
    target: tuple[float, float] | None = None,
    among: Callable[[Pair], bool] = lambda pair: True,
) -> Figure:
    chosen = [pair for pair in pairs if among(pair)]
    return Figure(label, sum(hit(pair) for pair in chosen), len(chosen), target)


def _named(pairs: Sequence[Pair]) -> Iterator[Figure]:
    large, small = [p for p in pairs if detectable(p)], [p for p in pairs if not detectable(p)]
    yield _share("right effect named first, detectability 100 or more", large, right_first, (95, 100))
    yield _share("right effect among the first two, detectability 100 or more", large, _first_two, (99, 100))
    yield _share("another named first, in a set with the right one, detectability 100 or more", large, tied)
    yield _share("an effect added beside the right one", pairs, lambda p: len(p[1].added) > 1, None, right_first)
    yield _share("right effect named first, detectability below 100", small, right_first)
    yield _share("a wrong effect named, detectability below 100", small, _wrong)


def _first_two(pair: Pair) -> bool:
    return right_first(pair) or pair[0].effects[0][0] in pair[1].ranking


def _wrong(pair: Pair) -> bool:
    return names_something(pair) and not right_first(pair) and not tied(pair)


def _nulls(pairs: Sequence[Pair]) -> Iterator[Figure]:
    yield _share("a physical effect named although none is missing", pairs, names_something, (0, 1))
    yield _share("the same answered with unknown", pairs, lambda p: p[1].verdict == UNKNOWN)
    for kind, words in (
        ("", "white noise is there"),
        ("coloured", "the noise is coloured"),
        ("start", "logs begin before the plate is at rest"),
        ("offset", "the sensor has an offset"),
        ("gain", "the sensor's gain is off"),
        ("shift", "outputs are logged late"),
    ):
        alone = [pair for pair in pairs if pair[0].nuisances == ((kind,) if kind else ())]
        yield _share(f"named although only {words}", alone, names_something)
    several = [pair for pair in pairs if len(pair[0].nuisances) > 1]
    yield _share("named although two sensor errors or all five are in force", several, names_something)


def _outside(pairs: Sequence[Pair]) -> Iterator[Figure]:
    def unknown(pair: Pair) -> bool:
        return pair[1].verdict == UNKNOWN

    yield _share("an effect outside the catalogue answered with unknown", pairs, unknown, (90, 100))
    yield _share("a name given to an effect outside the catalogue", pairs, names_something, (0, 5))
    yield _share("answered with unknown, detectability 100 or more", pairs, unknown, None, detectable)
    yield _share("a name given, detectability 100 or more", pairs, names_something, None, detectable)


def _both(pairs: Sequence[Pair]) -> Iterator[Figure]:
    def named(pair: Pair) -> int:
        return len({name for name, _ in pair[0].effects} & set(pair[1].added))

    yield _share("two effects at once, both named", pairs, lambda p: named(p) == 2, (80, 100))
    yield _share("one of the two named", pairs, lambda p: named(p) == 1)


def _repair(pairs: Sequence[Pair]) -> Iterator[Figure]:
    yield _share(
        "error against the truth after adding at most the larger of a tenth and twice the bound",
        pairs, repaired, (90, 100), lambda p: right_first(p) and None not in (p[1].base, p[1].final, p[1].bound),
    )  # fmt: skip
    yield _share(
        "held-out residual after adding at most 1.05 of the noise",
        pairs, lambda p: (p[1].residual or math.inf) <= _NOISE_ONLY, (95, 100), lambda p: bool(p[1].added),
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
