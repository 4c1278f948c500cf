import numpy as np
import pytest

from pysim.diagnose.separation import MOST, REPEATS, cheapest, evidence


def test_gain_is_what_a_fit_to_old_and_new_data_leaves() -> None:
    rng = np.random.default_rng(3)
    apart, slopes, old = rng.standard_normal(40), rng.standard_normal((40, 3)), rng.standard_normal((60, 3))
    rows, values = np.vstack([slopes, old]), np.append(apart, np.zeros(60))
    left = np.linalg.lstsq(rows, values, rcond=None)[1][0]
    assert evidence(apart, slopes).gain(old.T @ old) == pytest.approx(left)


def test_a_difference_that_a_refit_makes_is_worth_nothing() -> None:
    slopes = np.random.default_rng(3).standard_normal((40, 3))
    own = evidence(slopes @ np.array([1.0, -2.0, 0.5]), slopes)
    assert own.gain(np.zeros((3, 3))) == pytest.approx(0.0, abs=1e-9)
    assert own.gain(1e6 * np.eye(3)) > 1.0


def test_the_shortest_way_to_enough_is_taken() -> None:
    known = (np.zeros((1, 1)), np.zeros((1, 1)))

    def says(size: float) -> dict[str, tuple]:
        own = evidence(np.array([0.0, size]), np.array([[1.0], [0.0]]))
        return {"y": (own, own)}

    table = [says(4.0), says(10.0), {}, says(1.0)]
    assert cheapest([1.0, 20.0, 1.0, 1.0], table, ["y"], known, 50.0) == (pytest.approx(64.0), [(0, 4)])
    assert cheapest([1.0, 2.0, 1.0, 1.0], table, ["y"], known, 50.0) == (pytest.approx(100.0), [(1, 1)])
    gain, chosen = cheapest([1.0] * 6, [says(0.1)] * 6, ["y"], known, 50.0)
    assert gain == pytest.approx(MOST * REPEATS * 0.01)
    assert [count for _, count in chosen] == [REPEATS] * MOST


def test_the_weaker_of_both_truths_counts() -> None:
    strong, weak = evidence(np.array([10.0]), np.zeros((1, 1))), evidence(np.array([1.0]), np.zeros((1, 1)))
    known = (np.zeros((1, 1)), np.zeros((1, 1)))
    assert cheapest([1.0], [{"y": (strong, weak)}], ["y"], known, 50.0)[0] == pytest.approx(REPEATS)
