"""What is said about a fit, and that a clean one is left alone. Stability is tested with the fit."""

import numpy as np
import pytest

from pysim.identify.blackbox import ComplexResponse, Structure, fit_transfer_function
from pysim.types import NoteCode
from tests.pysim.identify.blackbox.systems import exact, from_roots, noisy, pairs

F = np.geomspace(0.2, 20, 30)
SYSTEM = from_roots([], pairs(-5 + 30j), 900.0, dead_time=0.03)


def notes(data: ComplexResponse, structure: Structure) -> dict[NoteCode, dict[str, float | str]]:
    return {note.code: dict(note.values) for note in fit_transfer_function(data, structure).notes}


def test_nothing_to_say_of_what_was_asked_for() -> None:
    assert notes(noisy(SYSTEM, F, 0.01, seed=1), Structure(2, dead_time_max=0.1)) == {}


def test_residuals_beyond_the_noise() -> None:
    data = noisy(from_roots([-10.0], pairs(-5 + 30j, -3 + 70j), 4e5), F, 0.01, seed=1)
    fit = fit_transfer_function(data, Structure(2))
    assert fit.scatter > 10
    assert fit.notes[0].code is NoteCode.BEYOND_NOISE
    assert fit.notes[0].values["factor"] == pytest.approx(np.sqrt(fit.scatter))
    assert fit.explains < 1e-9


def test_dead_time_at_either_end() -> None:
    late = notes(exact(SYSTEM, F), Structure(2, dead_time_max=0.02))
    assert late[NoteCode.DEAD_TIME_AT_BOUND] == {"end": "largest", "seconds": 0.02}
    early = Structure(2, dead_time=0.04, dead_time_max=0.1)
    assert notes(exact(SYSTEM, F), early)[NoteCode.DEAD_TIME_AT_BOUND] == {"end": "smallest", "seconds": 0.04}


def test_what_is_not_determined() -> None:
    plain = from_roots([], pairs(-5 + 30j), 900.0)
    assert notes(exact(plain, F), Structure(3, 1))[NoteCode.NOT_DETERMINED] == {"names": "b0, a2, a1, a0"}


def test_an_integrator_is_named_and_not_called_unstable() -> None:
    data = [noisy(from_roots([], [0.0, -25.0], 50.0), F, 0.001, seed) for seed in range(4)]
    fits = [fit_transfer_function(one, Structure(2)) for one in data]
    for fit in fits:
        assert fit.at_origin == (0,)
        assert NoteCode.INTEGRATOR in [note.code for note in fit.notes]
        assert NoteCode.UNSTABLE not in [note.code for note in fit.notes]
    assert {fit.function.stable for fit in fits} == {True, False}  # noise decides on which side it comes out


def test_a_dead_time_beyond_what_the_grid_resolves() -> None:
    plain, gap = from_roots([], pairs(-5 + 30j), 900.0), float(np.min(np.diff(F)))
    assert NoteCode.DEAD_TIME_AMBIGUOUS in notes(exact(plain, F), Structure(2, dead_time=0.51 / gap))
    assert NoteCode.DEAD_TIME_AMBIGUOUS not in notes(exact(plain, F), Structure(2, dead_time=0.49 / gap))
