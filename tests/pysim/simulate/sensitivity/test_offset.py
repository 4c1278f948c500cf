"""States that are offset during a run, against closed forms: a plant that does not start where the model rests."""

import dataclasses
import math

import numpy as np
import pytest

from pysim.simulate import Esdirk, Rk45, Rodas, sensitivities_many, simulate
from pysim.types import BadInput, Experiment
from tests.pysim.simulate.fixture_fmus import OSCILLATOR

_TIGHT = Esdirk(1e-8, 1e-8)
_W, _D, _AT = 2.0, 0.1, 1.5


def free(t: np.ndarray) -> np.ndarray:
    """(n_t, 2, 2) of x'' + 2 D w x' + w^2 x = 0: x and v at t by x and v at 0; zero before 0."""
    decay, ringing = _D * _W, _W * math.sqrt(1 - _D**2)
    e, c, s = np.exp(-decay * t), np.cos(ringing * t), np.sin(ringing * t)
    rows = [[c + decay / ringing * s, s / ringing], [-(_W**2) / ringing * s, c - decay / ringing * s]]
    return np.moveaxis(np.array(rows) * e, -1, 0) * (t >= 0)[:, None, None]


def offset(times: np.ndarray, by: tuple[float, ...], at: float | None = _AT) -> Experiment:
    return Experiment(times, ("x", "v"), {}, {"x": 0.0, "w": _W, "D": _D}, offset=np.array(by), offset_at=at)


@pytest.mark.parametrize("solver", [_TIGHT, Rk45(1e-9, 1e-9), Rodas(1e-8, 1e-8)])
@pytest.mark.parametrize("at", [None, _AT, 4.0])
def test_states_are_offset_when_their_time_comes(fixture_model, solver, at):
    times = np.append(np.linspace(0, 4, 41), _AT + 0.01) if at is None else np.linspace(0, 4, 41)
    experiment = offset(np.sort(times), (0.5, -0.2), at)
    record = simulate(fixture_model(OSCILLATOR, 2), experiment, solver=solver)
    expected = free(experiment.times - (at or 0.0)) @ [0.5, -0.2]
    np.testing.assert_allclose(record.values, expected, atol=1e-6)


@pytest.mark.parametrize("tangents", [True, False])
def test_slopes_by_the_offset(fixture_model, tangents):
    model = fixture_model(dataclasses.replace(OSCILLATOR, tangents=tangents), 3)
    experiment = offset(np.linspace(0, 4, 41), (0.5, 0.0))
    found = sensitivities_many(model, [experiment], ("D",), offset=True, solver=_TIGHT)[0]
    np.testing.assert_allclose(found.by_offset, free(experiment.times - _AT), atol=1e-6)
    assert found.by_parameter.shape == (41, 2, 1)


def test_slopes_that_have_faded_are_zero(fixture_model):
    """Processors are slow on numbers below the least normal one, and a run may keep them up for its whole length."""
    experiment = offset(np.linspace(0, 6000, 1501), (0.0, 0.0), None)
    solver = dataclasses.replace(_TIGHT, max_step=4.0)
    found = sensitivities_many(fixture_model(OSCILLATOR, 2), [experiment], (), offset=True, solver=solver)[0].by_offset
    assert np.all(found[-1] == 0.0)
    assert np.min(np.abs(found[found != 0.0])) > np.finfo(float).tiny


def test_an_offset_needs_a_number_for_each_state(fixture_model):
    with pytest.raises(BadInput):
        simulate(fixture_model(OSCILLATOR, 2), offset(np.linspace(0, 4, 5), (0.5,)))
    with pytest.raises(BadInput):
        offset(np.linspace(0, 4, 5), (0.5, 0.0), 4.5)
    with pytest.raises(BadInput):
        sensitivities_many(fixture_model(OSCILLATOR, 2), [Experiment(np.ones(1), ("x",))], (), offset=True)
