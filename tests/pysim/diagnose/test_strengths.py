"""What is tried of an effect, and names in a model."""

import numpy as np
import pytest

from pysim.diagnose.strengths import amounted, declared, limits, strengths, translated, within
from pysim.diagnose.subject import extended
from pysim.effects import STANDARD_LIBRARY, read_catalogue
from tests.pysim.diagnose.toy import CATALOGUE, measured, toy_subject

STANDARD = {effect.name: effect for effect in read_catalogue(STANDARD_LIBRARY)}


def test_a_strength_is_tried_once_in_its_usual_size_and_shapes_stay_as_declared() -> None:
    assert [v["F_c"] for v in strengths(CATALOGUE["toy.friction"])] == pytest.approx([0.09])
    assert [v["T"] for v in strengths(STANDARD["supply.droop"])] == [0.02]
    assert [v["T_f"] for v in strengths(STANDARD["sensor.lag"])] == pytest.approx([1e-3])


def test_a_limit_is_tried_below_the_largest_size_that_the_tests_reach() -> None:
    limit = STANDARD["valve.saturation"]
    reached = [1 / v["inverse_u_max"] for v in strengths(limit, 0.4)]
    assert len(reached) == 4
    assert max(reached) == pytest.approx(0.92 * 0.4)
    assert min(reached) == pytest.approx(0.35 * 0.4)
    assert list(strengths(limit, 0.0)) == []  # the spool does not move: no limit can act
    assert len(list(strengths(limit))) == 7


def test_amounts_are_counted_from_off_and_stay_within_bounds() -> None:
    effect = CATALOGUE["toy.friction"]
    assert declared(effect) == {"F_c": 0.0}
    assert amounted(effect, {"F_c": 0.3}, 2.0) == pytest.approx({"F_c": 0.6})
    assert amounted(effect, {"F_c": 0.3}, -1.0) == {"F_c": 0.0}
    assert within(effect["F_c"], 7.0) == 5.0


def test_an_effect_that_shares_its_slot_is_found_under_its_new_name() -> None:
    subject = toy_subject(measured(0))
    friction, hardening = CATALOGUE["toy.friction"], CATALOGUE["toy.hardening"]
    one, place = extended(subject, [friction]), {"force.F_c": 0.3, "m": 1.0}
    both = extended(subject, [friction], model=None)
    assert translated(one, both, place) == place
    assert hardening.slot == friction.slot


def test_limits_go_down_in_even_steps_from_where_they_hardly_bite() -> None:
    effect = CATALOGUE["toy.stop"]
    found = [1 / values["inverse_x_m"] for values in limits(effect, 2.0)]
    assert found[0] == pytest.approx(1.9)
    assert found[-1] < 0.1 * found[0]
    ratios = np.array(found[1:]) / found[:-1]
    assert np.ptp(ratios) < 1e-12
