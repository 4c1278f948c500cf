"""An effect's own checks, and how it is switched on in an experiment."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.types import BadInput, Effect, EffectParameter, Experiment

FRICTION = EffectParameter("F_c", "N", 0.0, 600.0, 80.0, 0.0, 0.0)
WIDTH = EffectParameter("v_s", "m/s", 1e-3, 50e-3, 5e-3, 5e-3, None)
STOP = EffectParameter("inverse_u_max", "1", 0.0, 20.0, 3.0, 0.0, 0.0, "", "u_max")
EFFECT = Effect("friction.test", "pistonForce", "L.Friction", (FRICTION, WIDTH, STOP))
RUN = Experiment(np.arange(3.0), ("x",))


def test_settings_go_to_the_slot_or_another_place() -> None:
    assert dict(EFFECT.on(RUN, F_c=80.0, v_s=2e-3).overrides) == {"pistonForce.F_c": 80.0, "pistonForce.v_s": 2e-3}
    assert dict(EFFECT.on(RUN, place="pistonForce.first", F_c=80.0).overrides) == {"pistonForce.first.F_c": 80.0}


def test_names_that_people_use_are_turned_over() -> None:
    assert dict(EFFECT.on(RUN, u_max=0.25).overrides) == {"pistonForce.inverse_u_max": 4.0}
    assert dict(EFFECT.on(RUN, u_max=math.inf).overrides) == {"pistonForce.inverse_u_max": 0.0}
    assert STOP.reported(4.0) == ("u_max", 0.25)
    assert STOP.reported(0.0) == ("u_max", math.inf)
    assert FRICTION.reported(80.0) == ("F_c", 80.0)


def test_strengths_are_what_can_be_off() -> None:
    assert EFFECT.strengths == (FRICTION, STOP)


def test_a_special_case_has_the_slot_and_some_of_the_parameters() -> None:
    less = replace(EFFECT, name="friction.less", parameters=(replace(FRICTION, description="other words"), WIDTH))
    assert less.is_special_case_of(EFFECT)
    assert not EFFECT.is_special_case_of(less)
    assert not EFFECT.is_special_case_of(EFFECT)
    assert not replace(less, slot="swashTorque").is_special_case_of(EFFECT)
    wider = replace(less, parameters=(replace(FRICTION, max=900.0), WIDTH))
    assert not wider.is_special_case_of(EFFECT)  # it can be what the other cannot


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"F_c": 601.0}, "F_c may be 0 to 600 N"),
        ({"F_d": 1.0}, "no parameter 'F_d'; it has F_c, v_s"),
        ({"u_max": 0.01}, "is outside"),
        ({"u_max": 0.0}, "u_max = 0 has no inverse; give another value, or inf"),
    ],
)
def test_refuses_settings(values: dict[str, float], message: str) -> None:
    with pytest.raises(BadInput, match=message):
        EFFECT.on(RUN, **values)


def test_refuses_effects_that_cannot_be_off() -> None:
    with pytest.raises(BadInput, match="no parameter is 0 as declared"):
        Effect("a.b", "slot", "A", (WIDTH,))
    with pytest.raises(BadInput, match="two parameters have one name"):
        Effect("a.b", "slot", "A", (FRICTION, FRICTION))
