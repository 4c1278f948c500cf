"""A run with its derivatives, taken by itself."""

import numpy as np

from pysim.simulate import Esdirk
from pysim.simulate._library import open_library
from pysim.simulate._run import initialise
from pysim.simulate.sensitivity.varied import Directions, vary
from pysim.types import Experiment, Outcome
from tests.pysim.simulate.fixture_fmus import OSCILLATOR


def test_a_run_that_was_stopped_is_not_done(fixture_model):
    experiment, solver = Experiment(np.array([0.0, 1.0]), ("x",)), Esdirk()
    with open_library(fixture_model(OSCILLATOR)) as library, library.instance() as instance:
        initialise(instance, experiment, solver)
        varied = vary(instance, experiment, solver, Directions(), stopped=lambda: True)
    assert varied.outcome is Outcome.STOPPED
    assert not varied.done
    assert varied.record(library.model, experiment).outcome is Outcome.STOPPED
