"""Chance against closed forms; what is left over against a linear model whose false alarms can be counted."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from pysim.diagnose import null
from pysim.diagnose.nuisance import GAIN, OFFSET, Suspect
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import Footprint
from pysim.identify.greybox.residuals import Point
from tests.pysim.diagnose.logs import sines, wave
from tests.pysim.diagnose.toy import CATALOGUE


def footprint(name: str, left: np.ndarray, gain: float) -> Footprint:
    return Footprint(CATALOGUE[name], {}, left, left, float(left @ left), gain, 1.0)


def test_one_direction_of_either_sign_is_chi_square() -> None:
    left = np.array([0.0, 3.0, 4.0])
    found = null.chance([footprint("toy.bias", left, 4.0)], scale=1.0, seed=1, draws=200_000)
    assert found.limit == pytest.approx(stats.chi2.isf(null.ALARM, 1), rel=0.03)
    assert found.p_value == pytest.approx(stats.chi2.sf(4.0, 1), rel=0.03)


def test_one_sign_alone_halves_the_chance_and_noise_scales_it() -> None:
    left = np.array([1.0, 2.0, 2.0])
    found = null.chance([footprint("toy.friction", left, 6.0)], scale=1.5, seed=1, draws=200_000)
    assert found.limit == pytest.approx(1.5 * stats.chi2.isf(2 * null.ALARM, 1), rel=0.03)
    assert found.p_value == pytest.approx(0.5 * stats.chi2.sf(4.0, 1), rel=0.03)


def test_orthogonal_candidates_add_their_chances_and_equal_ones_do_not() -> None:
    one, other = np.array([1.0, 0.0]), np.array([0.0, 1.0])
    gain = 9.0
    apart = null.chance([footprint("toy.bias", v, gain) for v in (one, other)], scale=1.0, seed=2, draws=200_000)
    same = null.chance([footprint("toy.bias", one, gain)] * 2, scale=1.0, seed=2, draws=200_000)
    single = stats.chi2.sf(gain, 1)
    assert apart.p_value == pytest.approx(1 - (1 - single) ** 2, rel=0.06)
    assert same.p_value == pytest.approx(single, rel=0.08)


def test_nothing_to_try_is_no_evidence() -> None:
    assert null.chance([], scale=1.0, seed=0).p_value == 1.0


def linear() -> tuple[Ruler, np.ndarray]:
    """Stepped sines and a wave, and slopes (n_r, 6) of a linear model that fits both."""
    targets = (sines(np.zeros, 1.0, (1.0, 4.0, 10.0)), wave(np.zeros(1500), 1.0))
    time = targets[1].measured.time
    near = [np.ones((log.points, 1)) for log in targets[0].logs] + [np.sin(3 * time)[:, None]]
    suspected = (Suspect(OFFSET, "data", "y"), Suspect(GAIN, "data", "y"))
    ruler = Ruler(targets, suspected=suspected, near=tuple(near))
    n_sines = ruler.whitenings[0].size
    rng = np.random.default_rng(0)
    slow = np.column_stack([np.cos(2 * np.pi * k * time / 6) for k in range(6)])
    return ruler, np.concatenate([rng.standard_normal((n_sines, 6)), slow])


def refitted(ruler: Ruler, slopes: np.ndarray, values: np.ndarray) -> Point:
    """What a refit leaves of the residuals."""
    first = ruler.counted(np.zeros(6), np.column_stack([values, slopes]))
    step = np.linalg.lstsq(first.jacobian, -first.residual, rcond=None)[0]
    residual = first.residual + first.jacobian @ step
    return replace(first, residual=residual, cost=float(residual @ residual))


def test_false_alarms_are_as_rare_as_asked() -> None:
    """Of 300 data sets of noise alone about a tenth may fall below 0.1, and a fiftieth below 0.02."""
    ruler, slopes = linear()
    rng = np.random.default_rng(7)
    first = refitted(ruler, slopes, rng.standard_normal(len(slopes)))
    expected = null.Expected.of(ruler, first.jacobian, draws=2000)
    drawn = (refitted(ruler, slopes, rng.standard_normal(len(slopes))) for _ in range(300))
    p = np.array([expected.beside(point.residual).p_value for point in drawn])
    # the doubt about the noise makes them rarer, never more frequent
    for level in (0.02, 0.1, 0.3):
        assert np.sum(p < level) <= stats.binom.isf(1e-3, 300, level)
    assert np.sum(p < 0.3) >= 30


@pytest.mark.parametrize("where", ["harmonic 2", "0.25 to 1 Hz", "command"])
def test_a_structure_that_a_sum_of_squares_cannot_see_is_told(where: str) -> None:
    ruler, slopes = linear()
    rng = np.random.default_rng(11)
    values = rng.standard_normal(len(slopes))
    n_sines, time = ruler.whitenings[0].size, ruler.targets[1].measured.time  # type: ignore[attr-defined]
    if where == "harmonic 2":
        place = 0
        for log in ruler.targets[0].logs:  # type: ignore[attr-defined]
            values[place + 3] += 6
            place += 2 * log.count + 1
    elif where == "command":
        values[n_sines:] += 0.4 * np.sin(2 * np.pi * 0.7 * time - 0.3) ** 2
    else:
        values[n_sines:] += 0.35 * np.cos(2 * np.pi * 0.75 * time + 1)
    point = refitted(ruler, slopes, values)
    freedom = ruler.freedom - 6
    assert stats.chi2.sf(point.cost, freedom) > 1e-4
    found = null.leftover(ruler, point)
    assert found.p_value < 0.002
    assert any(where in told for told in found.where)


def test_a_tail_goes_on_beyond_the_draws() -> None:
    drawn = np.random.default_rng(4).gumbel(2.0, 0.5, 2000)
    for chance in (0.3, 0.02, 1e-4, 1e-6):
        height = 2.0 - 0.5 * np.log(-np.log1p(-chance))
        assert null.beyond(float(height), drawn) == pytest.approx(chance, rel=0.6)
    assert null.beyond(1e3, drawn) < 1e-100
