import math

import pytest

from pysim.simulate import Esdirk, Rk4, Rk45, Rodas
from pysim.simulate._base import Adaptive
from pysim.types import BadInput

ADAPTIVE = (Rk45, Rodas, Esdirk)


@pytest.mark.parametrize("kind", ADAPTIVE)
@pytest.mark.parametrize("setting", ["rtol", "atol", "max_step", "max_steps"])
@pytest.mark.parametrize("value", [0, -1, math.nan])
def test_settings_that_are_not_positive_are_refused_by_name(kind, setting, value):
    with pytest.raises(BadInput, match=rf"^{kind.__name__}: {setting} must be positive, got {value}$"):
        kind(**{setting: value})


@pytest.mark.parametrize("kind", ADAPTIVE)
def test_settings_arrive_in_the_step_rule_and_cannot_change(kind):
    solver = kind(1e-3, 1e-4, 0.5, 7)
    assert isinstance(solver, Adaptive)
    assert solver.control() == (0.0, 1e-3, 1e-4, 0.5, 7)
    assert solver == kind(rtol=1e-3, atol=1e-4, max_step=0.5, max_steps=7) != kind()
    with pytest.raises(AttributeError):
        solver.rtol = 1.0


@pytest.mark.parametrize("step", [0, -0.1, math.inf, math.nan])
def test_a_fixed_step_is_a_positive_number_of_seconds(step):
    with pytest.raises(BadInput, match="Rk4: step must be a positive number of seconds"):
        Rk4(step)
