"""Which parameters a fit moves, where they begin, and what the others are."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.greybox import Tie, fit
from pysim.types import BadInput, Record
from pysim.workflow import fit_problem, model_of
from tests.toy import library, measured

MASS = model_of("Toy.Mass", [library()])
DATA = measured(1, "toy.friction", F_c=0.0)


def test_what_is_free_is_what_the_model_suggests_and_nobody_set() -> None:
    assert fit_problem(MASS, [DATA]).space.keys == ("m", "d", "k")
    task = fit_problem(MASS, [DATA], values={"m": 1.3}, fixed={"k": 19.0})
    assert (task.space.keys, dict(task.space.fixed)) == (("d",), {"m": 1.3, "k": 19.0})
    assert fit_problem(MASS, [DATA], ties=[Tie("d", "m", 2.0)]).space.keys == ("m", "k")


def test_values_are_where_what_is_named_begins_unless_a_start_says_otherwise() -> None:
    task = fit_problem(MASS, [DATA], free=["m", "d"], values={"m": 1.3, "d": 0.4, "k": 21.0}, starts={"d": 0.6})
    assert task.space.values(task.space.to_search(task.space.start)) == pytest.approx({"m": 1.3, "d": 0.6, "k": 21.0})


def test_the_fit_finds_what_was_simulated() -> None:
    """The toy's measurements are of m = 1.05, d = 0.75, k = 21."""
    found = fit(fit_problem(MASS, [DATA], free=["m", "k"], fixed={"d": 0.75}))
    for name, true in (("m", 1.05), ("k", 21.0)):
        assert abs(found[name].value - true) < 4 * found[name].std


@pytest.mark.parametrize("more", [{"starts": {"k": 1.0}}, {"bounds": {"k": (1.0, 2.0)}}])
def test_what_is_not_fitted_has_no_start_and_no_bounds(more: dict[str, dict[str, float]]) -> None:
    with pytest.raises(BadInput, match="k has a start or bounds but is not free"):
        fit_problem(MASS, [DATA], free=["m"], **more)  # type: ignore[arg-type]


def test_logs_in_which_no_input_moves_are_refused() -> None:
    still = []
    for record in DATA.records:
        assert isinstance(record.data, Record)
        still.append(replace(record, data=replace(record.data, values=record.data.values * np.array([0.0, 1.0]))))
    with pytest.raises(BadInput, match="the input F is constant"):
        fit_problem(MASS, [replace(DATA, records=tuple(still))])
    assert fit_problem(MASS, [replace(DATA, records=tuple(still), name="still"), DATA]).observations
