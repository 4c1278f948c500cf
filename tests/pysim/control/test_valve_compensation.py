import math

import pytest

from pysim.control import ValveCompensation
from pysim.types import BadInput

K, RHO = 1e-5, 870.0


def flow(u: float, p_s: float, p_L: float) -> float:
    """Thesis Eq. 5.2."""
    return u * K * math.sqrt((p_s - math.copysign(1.0, u) * p_L) / RHO)


@pytest.mark.parametrize("u", [-0.9, -0.1, 0.02, 0.8])
@pytest.mark.parametrize("p_L", [-150e5, 0.0, 100e5])
def test_the_valve_gives_the_flow_that_was_asked_for(u: float, p_L: float) -> None:
    block = ValveCompensation(K, RHO)
    assert block.step(0.0, (flow(u, 310e5, p_L), 310e5, p_L))[0] == pytest.approx(u, rel=1e-12)


def test_no_flow_no_opening_and_never_more_than_open() -> None:
    block = ValveCompensation(K, RHO)
    assert block.step(0.0, (0.0, 310e5, 300e5)) == (0.0,)
    assert block.step(0.0, (1.0, 310e5, 310e5)) == (1.0,)
    assert block.step(0.0, (-1.0, 310e5, 310e5)) == (-1.0,)


@pytest.mark.parametrize("values", [(0.0, RHO, 1e5), (K, -1.0, 1e5), (K, RHO, 0.0)])
def test_numbers_are_positive(values: tuple[float, float, float]) -> None:
    with pytest.raises(BadInput, match="give a positive number"):
        ValveCompensation(*values)
