"""The table of cases: what a seed draws numbers for, 240 in all."""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Iterator
from itertools import combinations, cycle

from validation.blind.plant.case import Case
from validation.blind.plant.effects import BEYOND, SHAPED, SIZES, STANDARD
from validation.blind.plant.nuisance import KINDS, SENSORS

NOISES = (0.02, 0.1, 0.5)  # percent
_NULLS = 6  # of each nuisance
_TWICE = ("friction.coulomb", "friction.stribeck")  # one of them is the other with equal forces: no pair
_PAIRS = 56


def cases(seed: int) -> tuple[Case, ...]:
    """The whole table; the seed changes every number that is drawn, and not what is asked.

    54 named (18 effects, 3 sizes), 20 shaped differently, 72 without any effect (plain, each nuisance, all errors of
    the sensor), 20 beyond the list, 18 left out of the catalogue, 56 pairs.
    """
    rows = [*_named(), *_nulls(), *_others("shaped", SHAPED), *_others("beyond", BEYOND), *_left_out(), *_pairs()]
    return tuple(
        Case(name, kind, effects, nuisances, noise, spool, left_out, zlib.crc32(f"{seed} {name}".encode()))
        for name, kind, effects, nuisances, noise, spool, left_out in rows
    )


_Row = tuple[str, str, tuple[tuple[str, str], ...], tuple[str, ...], float, bool, tuple[str, ...]]


def _tail(noise: float, spool: bool) -> str:
    return f"n{noise:g}-{'u' if spool else 'angle'}"


def _named() -> Iterator[_Row]:
    """At each noise, with and without the spool, but not at all of them."""
    for k, effect in enumerate(STANDARD):
        for j, size in enumerate(SIZES):
            noise, spool = NOISES[(j + k) % 3], (j + k // 3) % 2 == 0
            yield f"named-{effect}-{size}-{_tail(noise, spool)}", "named", ((effect, size),), (), noise, spool, ()


def _nulls() -> Iterator[_Row]:
    kinds: list[tuple[str, ...]] = [(), *((kind,) for kind in KINDS), SENSORS]
    for nuisances in kinds:
        word = "plain" if not nuisances else "sensor" if nuisances == SENSORS else nuisances[0]
        for n in range(_NULLS):
            noise, spool = NOISES[n % 3], n // 3 % 2 == 0
            yield f"none-{word}-{n}-{_tail(noise, spool)}", "none", (), nuisances, noise, spool, ()


def _others(kind: str, names: Iterable[str]) -> Iterator[_Row]:
    for k, name in enumerate(names):
        for j, size in enumerate(SIZES[1:]):
            noise, spool = NOISES[(j + k) % 2], (j + k // 2) % 2 == 0
            yield f"{kind}-{name}-{size}-{_tail(noise, spool)}", kind, ((name, size),), (), noise, spool, ()


def _left_out() -> Iterator[_Row]:
    for k, effect in enumerate(STANDARD):
        size, noise, spool = SIZES[1 + k % 2], NOISES[k % 3], k // 2 % 2 == 0
        name = f"left-out-{effect}-{size}-{_tail(noise, spool)}"
        yield name, "left-out", ((effect, size),), (), noise, spool, (effect,)


def _pairs() -> Iterator[_Row]:
    """Evenly out of all, each effect three to nine times."""
    sizes = cycle((("large", "large"), ("middle", "large"), ("large", "middle"), ("middle", "middle")))
    spools = cycle((True, False, True))
    every = [two for two in combinations(STANDARD, 2) if two != _TWICE]
    for k in range(_PAIRS):
        (one, other), (first, second), spool = every[k * len(every) // _PAIRS], next(sizes), next(spools)
        name = f"pair-{one}-{first}+{other}-{second}-{_tail(0.1, spool)}"
        yield name, "pair", ((one, first), (other, second)), (), 0.1, spool, ()
