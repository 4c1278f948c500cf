"""What counts as a tie that was settled, and what the virtual bench adds to a short log."""

import numpy as np
import pytest

from pysim.diagnosis import session
from validation.batch import Line
from validation.ties.case import shares
from validation.ties.plant import drawn


def test_only_what_is_right_and_in_no_tie_is_settled() -> None:
    tie = {"tie": "a | b", "test": "run this", "right": True, "settled": True}
    lines: list[Line] = [
        {"case": "0", **tie},
        {"case": "1", **tie, "settled": False},
        {"case": "2", **tie, "test": "", "right": False, "settled": False},
        {"case": "3", "tie": "", "test": ""},
        {"case": "4", "trouble": "ended"},
    ]
    found = [(share.hits, share.of) for share in shares(lines)]
    assert found == [(1, 2), (2, 2), (1, 3), (1, 5)]


def test_a_short_log_is_what_the_plant_does_beside_its_noise() -> None:
    """With its own numbers and no effect left out, the plant's model leaves noise of the size that is stated."""
    rng = np.random.default_rng(1)
    plant = drawn("mass", "mass.hardening", rng)
    data = plant.first_log(rng, 20.0)
    beside = session(plant.model, data, free=["m"], overrides={n: v for n, v in plant.values.items() if n != "m"})
    one, _ = beside.problems
    x = one.space.to_search(np.array([plant.values["m"]]))
    left = one.residuals().evaluate(one.model, one.space, x)
    assert left.good
    assert float(np.sqrt(left.squares[0] / one.residuals().samples[0])) == pytest.approx(1e-3, rel=0.1)
