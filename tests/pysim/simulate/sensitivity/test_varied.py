"""A run with its derivatives, taken by itself."""

from collections.abc import Callable

import numpy as np

from pysim.simulate import Esdirk
from pysim.simulate._library import open_library
from pysim.simulate._pass import run_tasks
from pysim.simulate._request import Kind, Request
from pysim.simulate._run import record_of
from pysim.simulate._variation import Directions
from pysim.simulate.kernel.layout import VARIED
from pysim.types import Experiment, Model, Outcome
from tests.pysim.simulate.fixture_fmus import OSCILLATOR


def test_a_run_that_was_stopped_is_not_done(fixture_model: Callable[..., Model]) -> None:
    experiment = Experiment(np.array([0.0, 1e7]), ("x",), overrides={"D": 0.0, "x": 1.0})
    with open_library(fixture_model(OSCILLATOR)) as library:
        kind = Kind(VARIED, Esdirk(), Directions(("w",), outputs=False))
        (varied,) = run_tasks(library, kind, [Request(experiment)], stopped=lambda: True)
    assert varied.outcome is Outcome.STOPPED
    assert not varied.done
    assert record_of(library.model, experiment, varied).outcome is Outcome.STOPPED
