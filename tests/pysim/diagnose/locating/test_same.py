"""Places in a row are the same place; places that see something else are not."""

from dataclasses import replace

import numpy as np

from pysim.diagnose.adapter import bad_point
from pysim.diagnose.locating.fit import Estimate, Solution, Table
from pysim.diagnose.locating.found import Found
from pysim.diagnose.locating.laws import KNOTS, Copy, Law
from pysim.diagnose.locating.same import alike, different, neighbours
from tests.pysim.diagnose.toy import base

K = np.linspace(-1, 1, KNOTS)


def law(slot: str, argument: str = "s", *, lag: float = 0.0, of_rate: bool = False) -> Law:
    return Law(slot, f"{slot}.{argument}", (Copy(f"{slot}.y", f"{slot}.{argument}"),), lag, of_rate)


def found(of: Law, evidence: float, *, knots: np.ndarray = K, unit: float = 1.0) -> Found:
    nothing = Solution(np.zeros(KNOTS), np.eye(KNOTS), 0.0, 0.0, 0.0, np.zeros(2), 0.0)
    return Found(of, Estimate(Table(of, base(), knots, unit), bad_point(K, ""), nothing), False, evidence, 0.5)


def test_laws_run_over_the_same_values_at_two_places() -> None:
    assert alike(law("a"), K, law("b"), K * (1 + 1e-6))
    assert alike(law("a"), 1e3 * K, law("b"), 1e3 * K + 1.0)  # a thousandth of its range
    assert not alike(law("a"), 1e-3 * K, law("b"), 1e-3 * K + 1e-5)
    assert not alike(law("a"), K, law("a"), K)  # one place
    assert not alike(law("a"), K, law("b"), 2 * K)
    assert not alike(law("a"), K, law("b", of_rate=True), K)
    assert not alike(law("a"), K, law("b", lag=5e-3), K)


def test_what_does_the_same_is_tried_once() -> None:
    first, second, other = found(law("a"), 50.0), found(law("b"), 50.0), found(law("c"), 50.0, unit=3.0)
    own, twins = different([first, second, other])
    assert [one.law.slot for one in own] == ["a", "c"]
    assert [twin.slot for twin in twins[id(first.law)]] == ["b"]


def test_neighbours_share_every_law() -> None:
    a, b = found(law("a"), 50.0), found(law("b"), 50.0)
    assert neighbours([a, b]) == {"a": ["b"], "b": ["a"]}
    rate = replace(found(law("a", of_rate=True), 20.0), law=law("a", of_rate=True))
    assert neighbours([a, b, rate]) == {"a": [], "b": ["a"]}  # something was looked at there that b has not
    assert neighbours([a, found(law("b"), 40.0)]) == {"a": [], "b": []}
