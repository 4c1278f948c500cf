"""Strengths of the plant reach the catalogue's classes under their own names."""

import pytest

from pysim.effects import STANDARD_LIBRARY, Variant, fitting, read_catalogue
from pysim.types import BadInput
from validation.blind.catalogue import BASE, _overrides
from validation.blind.plant.effects import STANDARD

EFFECTS = {e.name: e for e in fitting(read_catalogue(STANDARD_LIBRARY), BASE, [STANDARD_LIBRARY])}


def test_plant_and_catalogue_have_the_same_effects_with_the_same_symbols() -> None:
    assert set(EFFECTS) == set(STANDARD)
    for name, parts in STANDARD.items():
        spoken = {parameter.inverse or parameter.name for parameter in EFFECTS[name].parameters}
        assert spoken == {part.symbol for part in parts}


def test_every_plausible_size_is_within_the_bounds_of_the_class() -> None:
    for name, parts in STANDARD.items():
        for part in parts:
            parameter = EFFECTS[name][part.symbol]
            for value in () if part.share_of else (part.weak, part.strong):
                assert parameter.min <= (1 / value if parameter.inverse else value) <= parameter.max


def test_a_limit_is_turned_over_and_a_stranger_refused() -> None:
    effect = EFFECTS["valve.rate_limit"]
    made = Variant("One", BASE, {effect.name: "spool"})
    assert _overrides(effect, made, {"r_max": 25.0}) == {"spool.inverse_r_max": 0.04}
    with pytest.raises(BadInput, match="no r_max"):
        _overrides(effect, made, {"u_max": 0.2})
