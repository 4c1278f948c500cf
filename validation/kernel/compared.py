"""Our runs beside the reference: errors over the tolerance, slopes beside differences."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.io import read_model
from pysim.simulate import Esdirk, Rodas, sensitivities, simulate
from pysim.types import Experiment
from validation.kernel.reference import ALIKE as TOLERANCES
from validation.kernel.reference import Reference, reference
from validation.kernel.subjects import Subject

Array = NDArray[np.float64]

# Slopes show kinks of a model that its values hide, so that they are asked for at a tolerance which resolves these.
SLOPES = Esdirk(1e-8, 1e-8, derivative_tol=1e-6)
# A jump is a change from one row to the next of this share of the span, and so many times those around it. Where two
# solvers see an event a little apart, the rows in between hold the value before it in one and after it in the other.
_JUMP, _STEEPER = 0.01, 10.0
_LEFT_OUT = 0.05  # share of the rows whose slopes may be anything where there are events: differences smear jumps
_OPEN = 3.0  # times what the reference leaves open: so far a slope may be off for nothing
_SMALL = 1e-2  # of a signal's size that a parameter, doubled, moves it by: what less does is noise in a difference


@dataclass(frozen=True)
class Compared:
    """One subject.

    Args:
        name: of the subject.
        rodas, esdirk: largest error of a value over what the solver may err by in a step: its tolerance times the
            signal's largest size and nominal value together.
        tight: the larger of both at the tighter tolerance, over that.
        cvode, cvode_tight: the same of FMPy's CVODE at either tolerance.
        worst: the signal with the largest error.
        slopes: largest error of a slope, beyond what the reference leaves open, over the largest slope of that signal
            by that parameter; not a number where no parameter moves anything.
        by: names of the parameters.
        exact: whether the slopes are those of the steps, and not differences of our own runs.
        events: of the run.
        derivatives: calls of the run.
    """

    name: str
    rodas: float
    esdirk: float
    tight: float
    cvode: float
    cvode_tight: float
    worst: str
    slopes: float
    by: tuple[str, ...]
    exact: bool
    events: int
    derivatives: int


def compared(subject: Subject) -> Compared:
    """By the solver of plain runs and by that of runs with slopes.

    Raises:
        LookupError: as `reference`.
        SimulationError: a run stopped early.
    """
    known = reference(subject)
    model, names = read_model(subject.fmu()), tuple(str(name) for name in known.names)
    experiment = Experiment(known.times, names)
    runs = [simulate(model, experiment, solver=solver(t, t)) for t in TOLERANCES for solver in (Rodas, Esdirk)]
    rodas, esdirk, *tight = (off(run.values, known) for run in runs)
    by = tuple(str(name) for name in known.parameters)
    usual, tighter = TOLERANCES
    cvode, cvode_tight = (off(run, known).max() / t for run, t in zip(known.alike, known.alike_tolerances, strict=True))
    statistics = runs[0].statistics
    events, slopes, exact = statistics["events"], float("nan"), True
    if by:
        run = Experiment(known.slope_times, names)
        found = sensitivities(model, run, by, solver=SLOPES)
        values = np.array([float(model[name].start or 0.0) for name in by])
        slopes, exact = off_slopes(found.by_parameter * values, known, events > 0), found.exact
    return Compared(
        subject.name,
        float(rodas.max() / usual),
        float(esdirk.max() / usual),
        float(np.max(tight) / tighter),
        float(cvode),
        float(cvode_tight),
        names[int(np.maximum(rodas, esdirk).argmax())],
        slopes,
        by,
        exact,
        events,
        statistics["derivatives"],
    )


def off(values: Array, known: Reference) -> Array:
    """Largest error of each signal, (n_y,) over its size; at a jump the value before or after it is right."""
    error = np.abs(values - known.values)
    for column, ours, theirs in zip(error.T, values.T, known.values.T, strict=True):
        for row in jumps(theirs, float(np.ptp(theirs))):
            rows = slice(max(row - 1, 0), row + 3)  # one row to either side of the two between which it jumps
            low, high = theirs[rows].min(), theirs[rows].max()
            column[rows] = np.maximum(np.maximum(low - ours[rows], ours[rows] - high), 0.0)
    return np.asarray(error.max(axis=0) / known.size)


def jumps(values: Array, span: float) -> list[int]:
    """Rows behind which a signal (n_t,) jumps."""
    change = np.abs(np.diff(values))
    around = np.zeros(change.size)
    around[1:] = change[:-1]
    around[:-1] = np.maximum(around[:-1], change[1:])
    return np.flatnonzero((change > _JUMP * span) & (change > _STEEPER * around)).tolist()


def off_slopes(slopes: Array, known: Reference, events: bool) -> float:
    """Largest error of slopes (n_s, n_y, n_p) over the largest slope of the signal by the parameter."""
    size = np.maximum(np.abs(known.slopes).max(axis=0), _SMALL * known.size[:, None])
    error = np.maximum(np.abs(slopes - known.slopes) - _OPEN * known.open, 0.0) / size
    rows = error.max(axis=(1, 2))
    return float(np.quantile(rows, 1 - _LEFT_OUT, method="higher") if events else rows.max())
