"""A fit warns of itself where it should, and of nothing else."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.greybox import Treatment, fit, fit_warnings, problem
from pysim.types import Estimate, Fit, FitOutcome, MeasuredRecord, Model, Note, NoteCode
from tests.pysim.fits import small_fit
from tests.pysim.identify.greybox.measurements import NOISE, dataset, log, ramp_answer, ramp_log

KNOWN = (
    Estimate("K", "1", 2.0, 1.5, 0.1, 10.0, 0.01, (1.98, 2.02)),
    Estimate("T", "s", 0.3, 0.4, 0.01, 5.0, 0.002, (0.296, 0.304)),
)


def good() -> Fit:
    """Two parameters that are well known, beside residuals that are 0.1 of the noise in the fitted logs."""
    covariance = np.diag([1e-4, 4e-6])
    sines = [replace(one, noise=(2.0,), use="fit") for one in small_fit().records[1:]]
    return replace(small_fit(), estimates=KNOWN, covariance=covariance, undetermined=(), records=tuple(sines))


def codes(found: Fit) -> list[NoteCode]:
    return [note.code for note in fit_warnings(found)]


def test_nothing_is_said_of_a_fit_that_can_be_trusted() -> None:
    assert codes(good()) == []


def test_residuals_above_the_noise_are_said_with_the_worst_signal() -> None:
    """The simulated sines of `small_fit` are 0.2 % away."""
    poor = replace(good(), records=tuple(replace(one, noise=(0.05,)) for one in good().records))
    (note,) = fit_warnings(poor)
    assert (note.code, note.values["signal"]) == (NoteCode.POOR_FIT, "y")
    assert note.values["factor"] == pytest.approx(0.2 / 0.05)


def test_what_was_held_out_does_not_make_a_fit_poor() -> None:
    poor = tuple(replace(one, noise=(0.05,), use="validate") for one in good().records)
    assert codes(replace(good(), records=poor)) == []


def test_bounds_open_directions_lost_records_and_a_search_that_gave_up_are_said() -> None:
    lost = Note(NoteCode.NOT_SIMULATED, {"record": "a.csv", "reason": "stiff"})
    bad = replace(
        small_fit(), notes=(*small_fit().notes, lost), outcome=FitOutcome.ITERATION_LIMIT, records=good().records
    )
    assert codes(bad) == [
        NoteCode.NOT_SIMULATED, NoteCode.AT_BOUND, NoteCode.INTERCHANGEABLE, NoteCode.SEARCH_GAVE_UP,
    ]  # fmt: skip
    bound = fit_warnings(bad)[1]
    assert (bound.values["parameter"], bound.values["bound"]) == ("T", 0.01)


def test_a_parameter_without_any_bound_is_said() -> None:
    endless = replace(KNOWN[0], lower=-math.inf, upper=math.inf)
    (note,) = fit_warnings(replace(good(), estimates=(endless, replace(KNOWN[1], upper=math.inf))))
    assert (note.code, note.values["parameters"]) == (NoteCode.UNBOUNDED, "K")


@pytest.mark.parametrize(("share", "is_said"), [(0.2, True), (0.01, False)])
def test_a_correlation_is_said_where_neither_parameter_is_well_known(share: float, is_said: bool) -> None:
    estimates = tuple(replace(one, std=share * one.value) for one in KNOWN)
    sd = np.array([one.std for one in estimates])
    covariance = np.outer(sd, sd) * np.array([[1.0, 0.995], [0.995, 1.0]])
    found = codes(replace(good(), estimates=estimates, covariance=covariance))
    assert found == [NoteCode.CORRELATED] * is_said


def displaced(y_0: float) -> MeasuredRecord:
    """The lag from y = y_0 on, driven by w = t."""
    t = np.arange(0, 3, 0.02)
    y = ramp_answer(t, 2.0, 0.3) + y_0 * np.exp(-t / 0.3)
    return log(t, t, y + NOISE * np.random.default_rng(1).standard_normal(t.size))


@pytest.mark.parametrize("initial", ["rest", "near rest", "estimate"])
def test_a_log_that_does_not_begin_at_rest_is_said_unless_its_start_is_estimated(lag: Model, initial: str) -> None:
    treatment = Treatment(initial=initial)
    for record, is_said in ((displaced(2.0), initial != "estimate"), (ramp_log(2.0, 0.3, 1), False)):
        found = fit(problem(lag, [dataset([record])], ["K", "T"], treatment=treatment))
        assert (NoteCode.NOT_AT_REST in codes(found)) == is_said
        if initial == "estimate":
            assert abs(found["K"].value - 2.0) < 4 * found["K"].std
            assert math.isclose(found["T"].value, 0.3, rel_tol=0.1)
