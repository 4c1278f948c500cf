"""The spectrum's closed forms against its integrals."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from pysim.excitation import PiersonMoskowitz
from pysim.types import BadInput

SEA = PiersonMoskowitz(10.0, 2.0)  # thesis Appendix A, Figure 1


def test_density_is_the_thesis_equation() -> None:
    omega = 4.2
    by_hand = 5 * math.pi**4 * 10**2 / 2**4 / omega**5 * math.exp(-20 * math.pi**4 / 2**4 / omega**4)
    assert SEA.density([omega, 0.0, -1.0]) == pytest.approx([by_hand, 0.0, 0.0])


def test_its_top_is_at_the_peak_period() -> None:
    omega = np.linspace(1.0, 10.0, 90001)
    assert omega[np.argmax(SEA.density(omega))] == pytest.approx(math.pi, abs=1e-4)


@pytest.mark.parametrize("order", [-2, -1, 0, 1, 2, 3])
def test_moments_are_the_integrals(order: int) -> None:
    # over ln(omega): smooth on both sides
    integral, _ = quad(lambda x: math.exp(x * (order + 1)) * float(SEA.density(math.exp(x))), -5.0, 40.0, limit=500)
    assert SEA.moment(order) == pytest.approx(integral, rel=1e-8)


def test_significant_height_and_zero_crossing_period() -> None:
    assert 4 * math.sqrt(SEA.moment(0)) == pytest.approx(10.0)
    # textbook ratios of this spectrum: T_z = 0.710 T_p, T_1 = 0.772 T_p
    assert 2 * math.pi * math.sqrt(SEA.moment(0) / SEA.moment(2)) == pytest.approx(0.7105 * 2.0, rel=1e-3)
    assert 2 * math.pi * SEA.moment(0) / SEA.moment(1) == pytest.approx(0.7718 * 2.0, rel=1e-3)


@pytest.mark.parametrize("share", [1e-5, 0.3, 0.999])
def test_energy_below_is_the_integral(share: float) -> None:
    omega = SEA.frequency_of_energy(share)
    integral, _ = quad(lambda w: float(SEA.density(w)), 0.0, omega, limit=500)
    assert integral / SEA.moment(0) == pytest.approx(share, rel=1e-6)
    assert SEA.energy_below([omega, -1.0, 0.0]) == pytest.approx([share, 0.0, 0.0])


def test_refuses_what_has_no_value() -> None:
    with pytest.raises(BadInput, match="order 4 is infinite"):
        SEA.moment(4)
    with pytest.raises(BadInput, match="no share"):
        SEA.frequency_of_energy(1.0)
    with pytest.raises(BadInput, match="the peak period is 0 s"):
        PiersonMoskowitz(1.0, 0.0)
    with pytest.raises(BadInput, match="the significant height is 0; it must be positive"):  # of no unit of its own
        PiersonMoskowitz(0.0, 2.0)
