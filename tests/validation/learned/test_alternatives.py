"""What a sparse regression keeps, and what its library holds: answers are known."""

import numpy as np

from pysim.effects.law import Moment, read_law
from validation.learned.alternatives import _few, _library

Z = {name: np.random.default_rng(seed).standard_normal(2000) for seed, name in enumerate("xv")}


def test_terms_that_act_are_kept_and_no_others() -> None:
    library = _library(list(Z))
    table = np.column_stack([Moment(read_law(f"y = {term}"), Z)["y"] + 0 * Z["x"] for term in library])
    noise = 0.05 * np.random.default_rng(7).standard_normal(2000)
    acting = -0.8 * Z["x"] ** 2 * Z["v"] - 0.5 * np.abs(Z["v"]) + noise
    assert {library[k] for k in _few(table, acting)} == {"x*x*v", "abs(v)"}


def test_the_library_has_every_product_once() -> None:
    two, one = _library(["x", "v"]), _library(["s"])
    assert len(two) == len(set(two)) == 10 + 2 + 3  # all of degree 3 in two variables, two sizes, three with a sign
    assert one == ["1", "s", "s*s", "s*s*s", "abs(s)"]
