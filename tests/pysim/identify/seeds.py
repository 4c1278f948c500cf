"""Monte Carlo: 40 seeds in every run of the tests, all of them in the slow ones, and what their count may be.

Seeds are fixed, so a test passes always or never. Where the claim is true, one set of seeds in a hundred is beyond
its bound.
"""

import pytest
from scipy.stats import binom

FEW = 40
_CHANCE = 0.01


def seeds(many: int) -> pytest.MarkDecorator:
    """The argument `runs` of a test: 40, and as many as that where slow tests are asked for."""
    return pytest.mark.parametrize("runs", [FEW, pytest.param(many, marks=pytest.mark.slow)])


def at_most(share: float, runs: int) -> int:
    """How often an event of that probability occurs in so many runs; more of them has a chance of 1 percent."""
    return int(binom.isf(_CHANCE, runs, share))


def at_least(share: float, runs: int) -> int:
    """How often an event of that probability occurs in so many runs; fewer of them has a chance of 1 percent."""
    return int(binom.ppf(_CHANCE, runs, share))
