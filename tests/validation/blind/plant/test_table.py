"""The table of cases: complete, unique, the same for the same seed."""

from collections import Counter

from validation.blind.plant.effects import BEYOND, SIZES, STANDARD
from validation.blind.plant.nuisance import KINDS
from validation.blind.plant.table import cases


def test_it_holds_what_the_benchmark_asks_for() -> None:
    table = cases(1)
    counts = Counter(case.kind for case in table)
    assert counts == {"named": 324, "none": 386, "beyond": 120, "left-out": 108, "pair": 152}
    named = [case for case in table if case.kind == "named"]
    assert {(*case.effects[0], case.spool, case.noise) for case in named} == {
        (effect, size, spool, noise)
        for effect in STANDARD
        for size in SIZES
        for spool in (0, 1)
        for noise in (0.02, 0.1, 0.5)
    }
    assert {case.effects[0][0] for case in table if case.kind == "beyond"} == set(BEYOND)
    assert not set(BEYOND) & set(STANDARD)
    assert {kind for case in table for kind in case.nuisances} == set(KINDS)
    assert all(case.left_out == (case.effects[0][0],) for case in table if case.kind == "left-out")


def test_names_and_seeds_are_unique_and_repeat() -> None:
    table = cases(1)
    assert len({case.name for case in table}) == len({case.seed for case in table}) == len(table)
    assert table == cases(1)
    assert [case.name for case in cases(2)] == [case.name for case in table]
    assert cases(2)[0].seed != table[0].seed


def test_names_are_file_names() -> None:
    assert all(
        set(case.name) <= set("abcdefghijklmnopqrstuvwxyz0123456789_.+-") and len(case.name) < 120 for case in cases(1)
    )
