"""What an effect does at its place, against its own law; and a term that remembers, against closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.drawn import Acted, acted, remembered
from pysim.diagnose.locating.fit import knots
from pysim.diagnose.locating.known import known
from pysim.diagnose.locating.laws import Copy, Law, slot_laws
from pysim.diagnose.locating.runs import seen
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.effects import slots
from tests.pysim.diagnose.toy import base, library, measured, toy_subject


def does(name: str, **values: float) -> Acted:
    given = toy_subject(measured(1, name, **values), [name])
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    at = Fitted(what, ruler.evaluation(what, what.space.to_search(what.space.start)))
    laws = slot_laws(slots("Toy.Mass", [library()]), what.model)
    samples = seen(ruler, at, laws)
    one = known(given, ruler, at, lambda line: None)[0]
    found = acted(one, at, [(law, knots(samples[f"{law.slot}|{law.argument}"])) for law in laws])
    assert found is not None
    return found


def test_friction_is_a_function_of_velocity() -> None:
    found = does("toy.friction", F_c=0.4)
    assert found.law.argument == "force.v"
    assert not found.remembers
    apart = found.values + 0.4 * np.tanh(found.knots / 0.02)
    assert np.max(np.abs(apart)) < 0.06  # a table is straight where the law is round


def test_a_cubic_spring_is_a_function_of_position() -> None:
    found = does("toy.hardening", k_3=8.0)
    assert found.law.argument == "force.x"
    np.testing.assert_allclose(found.term, -8.0 * found.argument**3, rtol=0.1, atol=1e-6)
    assert not found.remembers  # straight between its knots, it misses 6 percent


LAW = Law("here", "s_t", (Copy("y", "s_t"),))


def lagging(ratio: float) -> Acted:
    """What a lag of `ratio` over the angular frequency does to a sine: -r/(1 + r^2) (cos + r sin) over the rate cos."""
    angle = np.linspace(0, 40 * np.pi, 40_001)
    z, y = np.cos(angle), -ratio / (1 + ratio**2) * (np.cos(angle) + ratio * np.sin(angle))
    k = knots(z)
    values = -ratio / (1 + ratio**2) * k
    scatter = float(np.linalg.norm(y - np.interp(z, k, values)) / np.linalg.norm(y))
    return Acted(LAW, z, y, k, values, scatter)


@pytest.mark.parametrize("ratio", [0.02, 0.5])
def test_a_lag_is_a_function_of_the_rate_while_it_is_short(ratio: float) -> None:
    found = lagging(ratio)
    assert found.scatter == pytest.approx(ratio / np.sqrt(1 + ratio**2), rel=0.02)
    assert found.remembers is (ratio > 0.1)


def test_what_remembers_is_drawn_with_the_reach_of_its_values() -> None:
    """Around a rate z the term is the mean plus or minus r sin, |sin| = sqrt(1 - z^2)."""
    ratio = 0.5
    shape = remembered(lagging(ratio), base(), 0.0)
    size, inner = ratio / (1 + ratio**2), np.abs(shape.argument) < 0.9
    np.testing.assert_allclose(shape.value[inner], -size * shape.argument[inner], atol=0.02 * size)
    reach = ratio * size * np.sqrt(1 - shape.argument**2)
    beside = 0.04 * size  # the mean moves by so much within the part of the range that counts as one place
    np.testing.assert_allclose((shape.high - shape.low)[inner] / 2, reach[inner], atol=beside)


def test_the_doubt_of_the_size_widens_it() -> None:
    found = lagging(0.5)
    sure, unsure = remembered(found, base(), 0.0), remembered(found, base(), 0.2)
    ends = np.maximum(np.abs(sure.low), np.abs(sure.high))
    np.testing.assert_allclose(unsure.high - sure.high, 0.2 * ends, rtol=1e-9)
    np.testing.assert_allclose(sure.low - unsure.low, 0.2 * ends, rtol=1e-9)
    assert replace(found, scatter=0.0).remembers is False
