"""Who is blamed, where the truth was put together from known columns."""

import numpy as np
import pytest

from pysim.diagnose.blame import Blame, Evidence
from pysim.diagnose.nuisance import GAIN, OFFSET, SHIFT, Suspect

N = 2000
X, U, CLOCK = Suspect(OFFSET, "d", "x", 0.5), Suspect(OFFSET, "d", "u", 0.1), Suspect(SHIFT, "d", "", 1e-3)
ALL = (X, U, CLOCK)


def columns(rng: np.random.Generator) -> np.ndarray:
    """What one unit of each does: two signals in turn, and a wave in both."""
    found = np.zeros((N, 3))
    found[::2, 0] = found[1::2, 1] = 50.0
    found[:, 2] = 2e4 * np.sin(0.05 * np.arange(N))
    return found


def evidence(residual: np.ndarray, changes: np.ndarray, rng: np.random.Generator) -> Evidence:
    reach = np.linalg.qr(rng.standard_normal((N, 3)))[0]
    return Evidence.of(ALL, columns(rng), residual, changes, reach)


def test_cost_and_price_are_those_of_the_marginal_likelihood() -> None:
    """Against the normal density with the nuisances' covariance written out."""
    rng = np.random.default_rng(0)
    noise, few = rng.standard_normal(40), rng.standard_normal((40, 2))
    two = (Suspect(GAIN, "d", "x", 0.7), Suspect(OFFSET, "d", "x", 1.5))
    residual = noise + few @ [1.1, -0.9]
    found = Evidence.of(two, few, residual, np.zeros((40, 0)), np.zeros((40, 0)))
    covariance = np.eye(40) + few @ np.diag([0.7**2, 1.5**2]) @ few.T
    both = next(one.blame for one in found._sets() if len(one.blame.suspects) == 2)
    assert both.cost == pytest.approx(residual @ np.linalg.solve(covariance, residual))
    assert both.price == pytest.approx(np.linalg.slogdet(covariance)[1])


def test_noise_blames_nobody_and_an_offset_blames_its_sensor() -> None:
    rng = np.random.default_rng(1)
    blamed = 0
    for _ in range(40):
        noise = rng.standard_normal(N)
        blamed += bool(evidence(noise, np.zeros((N, 0)), rng).alone().suspects)
        assert evidence(noise - 0.4 * columns(rng)[:, 0], np.zeros((N, 0)), rng).alone().suspects == {X}
    assert blamed <= 1


def test_a_suspect_that_the_data_hardly_show_is_not_asked() -> None:
    rng = np.random.default_rng(7)
    for size, asked in ((0.9, False), (1.1, True)):
        faint = np.zeros((N, 1))
        faint[0] = size / X.width  # so much at one usual size
        residual = rng.standard_normal(N)
        residual[0] = 2.5
        found = Evidence.of((X,), faint, residual, np.zeros((N, 0)), np.zeros((N, 0)))
        assert found.suspects == ((X,) if asked else ())
        assert found.alone().suspects == ({X} if asked else set())


def test_an_effect_like_one_nuisance_is_a_tie_and_one_like_two_is_their_cause() -> None:
    rng = np.random.default_rng(2)
    c = columns(rng)
    change = np.column_stack([c[:, 0], 0.5 * c[:, 0] + 0.15 * c[:, 1]])
    one = evidence(rng.standard_normal(N) - 0.4 * c[:, 0], change, rng)
    (like_one, _), none = one.beside([True, True]), one.alone()
    assert none.suspects == {X}
    assert like_one.suspects == set()
    assert like_one.over(none) < 10 < none.price
    two = evidence(rng.standard_normal(N) - 0.8 * change[:, 1], change, rng)
    none, (_, like_two) = two.alone(), two.beside([True, True])
    assert none.suspects == {X, U}
    assert like_two.suspects == set()
    assert like_two.over(none) > 15


def test_what_is_far_beyond_the_usual_is_no_nuisance() -> None:
    rng = np.random.default_rng(3)
    c = columns(rng)
    found = evidence(rng.standard_normal(N) - 1.0 * c[:, 1], c[:, 1:2], rng)
    assert U not in found.alone().suspects
    (effect,) = found.beside([True])
    assert effect.over(found.alone()) > 1000
    (against,) = found.beside([False])
    assert against.cost < 2 * N  # the residual falls with the effect, so its sign is the allowed one
    (wrong,) = evidence(rng.standard_normal(N) + 1.0 * c[:, 1], c[:, 1:2], rng).beside([False])
    assert wrong.over(found.alone()) < 50


def test_of_many_suspects_those_that_explain_most_are_asked() -> None:
    rng = np.random.default_rng(4)
    many = tuple(Suspect(OFFSET, "d", f"s{k}", 1.0) for k in range(14))
    own = np.repeat(np.eye(14), 2000, axis=0)
    residual = rng.standard_normal(28_000) + 0.5 * own[:, 12]
    found = Evidence.of(many, own, residual, np.zeros((28_000, 0)), np.zeros((28_000, 0)))
    assert len(found.suspects) == 10
    assert found.alone().suspects == {many[12]}


def test_over_counts_what_is_spared() -> None:
    none = Blame(frozenset({X}), 100.0, 15.0)
    assert Blame(frozenset(), 98.0, 0.0).over(none) == 2.0
    assert Blame(frozenset({X}), 98.0, 15.0).over(none) == 2.0
    assert Blame(frozenset({U}), 98.0, 15.0).over(none) == 2.0
    assert Blame(frozenset(), 98.0, 0.0).over(Blame(frozenset({X, U}), 100.0, 30.0)) == 32.0
