"""Sizes: within the plausible range of the standard list, told by its symbols."""

import math

import numpy as np
import pytest

from validation.blind.plant.effects import BEYOND, SIZES, STANDARD, draw_effect, told
from validation.blind.plant.quantities import Strengths


@pytest.mark.parametrize("name", [*STANDARD, *BEYOND])
def test_every_size_is_within_its_range_and_in_order(name: str) -> None:
    part = {**STANDARD, **BEYOND}[name][0]
    low, high = sorted((part.weak, part.strong))
    for seed in range(5):
        drawn = [abs(draw_effect(name, size, np.random.default_rng(seed))[part.field]) for size in SIZES]
        assert all(low * (1 - 1e-12) <= value <= high * (1 + 1e-12) for value in drawn)
        assert (drawn == sorted(drawn)) if part.strong > part.weak else (drawn == sorted(drawn, reverse=True))


def test_shares_and_shapes() -> None:
    drawn = draw_effect("friction.stribeck", "large", np.random.default_rng(1))
    assert 0.3 <= drawn["stribeck__F_c"] / drawn["stribeck__F_s"] <= 0.8
    assert 2e-3 <= drawn["stribeck__v_s"] <= 20e-3
    assert set(told("friction.stribeck", Strengths(**drawn))) == {"F_c", "F_s", "v_s"}


def test_both_signs_are_drawn() -> None:
    signs = {
        math.copysign(1, draw_effect("swash.bias", "small", np.random.default_rng(n))["bias__F_b"]) for n in range(9)
    }
    assert signs == {-1.0, 1.0}


def test_fields_of_effects_do_not_overlap() -> None:
    fields = [part.field for parts in (*STANDARD.values(), *BEYOND.values()) for part in parts]
    assert len(fields) == len(set(fields))
    assert set(fields) <= set(Strengths._fields)
