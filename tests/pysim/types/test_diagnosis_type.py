"""What a diagnosis' types add to what they hold."""

import pytest

from pysim.types import BadInput
from tests.pysim.diagnosis_story import nothing, story


def test_moves_are_counted_on_one_scale_in_half_widths_of_the_interval_afterwards() -> None:
    _, before, after = story().stages
    scaled = before.on_the_scale_of(after)
    assert scaled == pytest.approx({"m": 1.0, "k": 0.75, "d": 1.0})  # m halved, so k by the square of that
    moves = after.moves_from(before)
    assert moves["m"] is None  # held
    assert moves["k"] == pytest.approx(0.0, abs=1e-12)
    assert moves["d"] == pytest.approx(5.0)
    assert "F_o" not in moves


def test_none_has_no_effects() -> None:
    assert nothing().verdict == "none"
    with pytest.raises(BadInput, match="effects were added"):
        story(verdict="none")
