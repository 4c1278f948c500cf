"""The table of cases: every effect at every size with and without the spool's signal, nulls, pairs, unknowns."""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from itertools import combinations, cycle

from validation.blind.plant.case import Case
from validation.blind.plant.effects import BEYOND, SIZES, STANDARD
from validation.blind.plant.nuisance import KINDS

NOISES = (0.02, 0.1, 0.5)  # percent
_NULLS_PER_NUISANCE = 48
_TWICE = ("friction.coulomb", "friction.stribeck")  # one of them is the other with equal forces: no pair


def cases(seed: int) -> tuple[Case, ...]:
    """The whole table; the seed changes every number that is drawn, and not what is asked.

    324 named (18 effects, 3 sizes, 3 noise levels, with and without spool), 386 nulls (plain, each nuisance, all
    together and two by two), 120 beyond the list, 108 left out of the catalogue, 152 pairs.
    """
    rows = [*_named(), *_nulls(), *_beyond(), *_left_out(), *_pairs()]
    return tuple(
        Case(name, kind, effects, nuisances, noise, spool, left_out, zlib.crc32(f"{seed} {name}".encode()))
        for name, kind, effects, nuisances, noise, spool, left_out in rows
    )


_Row = tuple[str, str, tuple[tuple[str, str], ...], tuple[str, ...], float, bool, tuple[str, ...]]


def _tail(noise: float, spool: bool) -> str:
    return f"n{noise:g}-{'u' if spool else 'angle'}"


def _named() -> Iterator[_Row]:
    for effect in STANDARD:
        for size in SIZES:
            for noise in NOISES:
                for spool in (True, False):
                    name = f"named-{effect}-{size}-{_tail(noise, spool)}"
                    yield name, "named", ((effect, size),), (), noise, spool, ()


def _nulls() -> Iterator[_Row]:
    kinds: list[tuple[str, ...]] = [(), *((kind,) for kind in KINDS), KINDS]
    for nuisances in kinds:
        yield from _null(nuisances, _NULLS_PER_NUISANCE)
    for two in combinations(KINDS, 2):
        yield from _null(two, 5)


def _null(nuisances: tuple[str, ...], count: int) -> Iterator[_Row]:
    word = "plain" if not nuisances else "all" if nuisances == KINDS else "+".join(nuisances)
    for n in range(count):
        noise, spool = NOISES[n % 3], n // 3 % 2 == 0
        yield f"none-{word}-{n:02d}-{_tail(noise, spool)}", "none", (), nuisances, noise, spool, ()


def _beyond() -> Iterator[_Row]:
    for effect in BEYOND:
        for size in SIZES:
            for noise in (0.02, 0.1):
                for spool in (True, False):
                    name = f"beyond-{effect}-{size}-{_tail(noise, spool)}"
                    yield name, "beyond", ((effect, size),), (), noise, spool, ()


def _left_out() -> Iterator[_Row]:
    noises = cycle(NOISES)
    for effect in STANDARD:
        for size in SIZES:
            for spool in (True, False):
                noise = next(noises)
                name = f"left-out-{effect}-{size}-{_tail(noise, spool)}"
                yield name, "left-out", ((effect, size),), (), noise, spool, (effect,)


def _pairs() -> Iterator[_Row]:
    sizes = cycle((("large", "large"), ("middle", "large"), ("large", "middle"), ("middle", "middle")))
    spools = cycle((True, False, True))
    for one, other in combinations(STANDARD, 2):
        if (one, other) == _TWICE:
            continue
        (first, second), spool = next(sizes), next(spools)
        name = f"pair-{one}-{first}+{other}-{second}-{_tail(0.1, spool)}"
        yield name, "pair", ((one, first), (other, second)), (), 0.1, spool, ()
