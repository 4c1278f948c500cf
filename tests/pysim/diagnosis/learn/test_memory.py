"""Laws that remember, and tones: learned from logs of plants whose law is known in closed form."""

import math

import numpy as np
import pytest

from pysim.diagnosis import learn
from pysim.diagnosis.candidate import Models
from pysim.diagnosis.checkpoint import Checkpoint
from pysim.diagnosis.learn.learn import Learner
from pysim.diagnosis.learn.names import without_the_unseated
from pysim.diagnosis.progress import Progress
from pysim.diagnosis.refit import begin, converged
from pysim.diagnosis.search import Search
from pysim.identify.greybox import Nuisance, NuisanceKind
from tests.pysim.diagnosis.learn.clocked import on_a_clock, within_the_band
from tests.pysim.diagnosis.plants import FINE


def test_friction_that_remembers_is_learned_as_a_bristle_whose_size_may_vary() -> None:
    found = learn(on_a_clock(lambda t, x, v, bristle: -(0.4 + 15 * x**2) * bristle))
    (law,) = found.learned
    assert (law.slot, law.argument, law.unit) == ("force", "force.x", "N")
    assert law.factor.number == pytest.approx(0.02, rel=0.1)
    assert within_the_band(law, -0.4 - 15 * law.knots**2) > 0.8
    before, after = found.history[-2].validate, found.history[-1].validate
    assert before is not None
    assert after is not None
    assert after < 1.1 < 0.5 * before


def test_a_tone_is_learned_with_its_phase_on_the_clock_of_the_logs() -> None:
    found = learn(on_a_clock(lambda t, x, v, bristle: 0.5 * math.cos(2 * math.pi * 3.3 * t + 0.7)))
    (law,) = found.learned
    rate = law.factor.rate
    at = (rate - 2 * math.pi * 3.3) * 29 + law.factor.number  # rad, in the middle of the fitted logs
    assert (law.slot, law.unit) == ("force", "N")
    assert rate == pytest.approx(2 * math.pi * 3.3, rel=1e-3)
    assert math.remainder(at - 0.7, 2 * math.pi) == pytest.approx(0.0, abs=0.1)
    assert law.coefficients == pytest.approx(0.5 * np.ones(law.knots.size), rel=0.15)
    assert found.left.tone is None
    assert found.history[-1].validate is not None
    assert found.history[-1].validate < 1.1


def test_a_sensor_error_that_the_law_makes_needless_is_dropped() -> None:
    """A delay of the sensor is fitted to what the bristle does; beside the bristle there is none."""
    opened = on_a_clock(lambda t, x, v, bristle: -0.8 * bristle)
    search = Search(Models(opened), FINE, opened.settings, Progress(lambda told: None), Checkpoint(None, ""))
    base, delay = search.fit_base(), Nuisance(NuisanceKind.DELAY, "mass", "x", 0.02)
    present = converged(begin(search.models.of((), (delay,)), base.values, base.simulation))
    search.floors = floors = search.floors.with_(base).with_(present)
    law = Learner(opened, present, floors, 1, search.vetoed, lambda said: None).learn().law
    assert law is not None
    assert law.fit.names == ("sensor.delay",)
    losses = {label: search.test(base, present) for label in present.candidate.labels}
    left = without_the_unseated(opened, law, present, base, losses, search.models.alone, floors, 1)
    assert left.fit.names == ()
    assert left.found.number == pytest.approx(0.02, rel=0.1)
