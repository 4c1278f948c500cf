"""Periodic orbits by shooting: Newton on the states that come back to themselves after one period."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._library import Instance, Library
from pysim.simulate._pool import Stopped
from pysim.simulate._run import initialise
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.sensitivity.varied import Directions, Varied, vary
from pysim.types import Experiment

Array = NDArray[np.float64]

_ITERATIONS = 15
_HALVINGS = 4
_WITHIN = 3.0  # tolerated errors of a step: what the choice of the steps alone moves the end of a period
_FURTHEST = 10.0  # amplitudes: a longer correction is shortened to that
_JUMPY = 30.0  # tolerated errors of a step: so far the end of a period with kinks jumps as the steps fall otherwise


@dataclass(frozen=True)
class Shot:
    """One period from some states, and what brings them back to themselves.

    Args:
        varied: the period; directions are the start states, then parameters.
        start: (n_x,) where it began.
        step: (n_x,) Newton correction of the start.
        mismatch: largest entry of `step`, in amplitudes of the orbit.
        by: (n_x, n_p) derivative of the periodic states by the parameters.
        drift: largest mismatch, in amplitudes, that no correction can remove.
        jumps: (n_x,) by how much the choice of the integration's steps may move `step`, at least.
    """

    varied: Varied
    start: Array
    step: Array
    mismatch: float
    by: Array
    drift: float
    jumps: Array

    @property
    def resolved(self) -> bool:
        """Whether the correction is no longer than that."""
        return bool(np.all(np.abs(self.step) <= self.jumps))


@dataclass(frozen=True)
class Found:
    """How shooting ended: the last period, or why there is none. `event` says that an event was met."""

    shot: Shot | None
    iterations: int
    trouble: str = ""
    event: bool = False


def shoot(
    instance: Instance,
    experiment: Experiment,
    solver: Esdirk,
    directions: Directions,
    guess: Array,
    tolerance: float,
    stopped: Stopped,
) -> Found:
    """Correct the guess (n_x,) until what is left is below the tolerance, in amplitudes of each state.

    The correction that is left is not applied to another integration but to first order to the last one, which makes
    an error of its square. A correction after which the mismatch is larger is halved, unless both mismatches are what
    the choice of the integration's steps leaves open: then the smaller one is left, too.

    Args:
        instance: in event mode at the experiment's start.
        experiment: one period, from time 0 to its end.
    """
    start, length, before, rewind = guess, 1.0, None, False
    for count in range(1, _ITERATIONS + 1):
        varied = vary(instance, experiment, solver, directions, start=start, rewind=rewind, stopped=stopped)
        if stopped():
            return Found(None, count, "stopped")
        if varied.event:
            return Found(None, count, "an event happened", event=True)
        shot = _examine(varied, start, solver, tolerance) if varied.done else None
        if shot is not None and shot.mismatch <= tolerance:
            return Found(None if shot.drift > tolerance else shot, count, _trouble(shot, tolerance))
        if shot is None or (before is not None and not shot.mismatch < before.mismatch):
            if shot is not None and before is not None and shot.resolved and before.resolved:
                return Found(None if before.drift > tolerance else before, count, _trouble(before, tolerance))
            length *= 0.5
            if before is None or length < 0.5**_HALVINGS:
                return Found(None, count, varied.message or _trouble(before, tolerance))
            start = before.start + length * before.step
        else:
            before, length = shot, min(1.0, _FURTHEST / shot.mismatch)
            start = shot.start + length * shot.step
        rewind = varied.rewindable and varied.done
        if not rewind:
            instance.renew()
            initialise(instance, experiment, solver)
    return Found(None, _ITERATIONS, _trouble(before, tolerance))


def _trouble(shot: Shot | None, tolerance: float) -> str:
    """Why there is no orbit, if there is none."""
    if shot is not None and shot.drift > tolerance:
        return "a state drifts from period to period, and nothing holds it"
    return "the corrections do not converge"


def _inverse(matrix: Array, least: float) -> Array | None:
    """The inverse, where no direction is neutral; a tenth of the time of the singular values that tell for sure."""
    try:
        inverse = np.asarray(np.linalg.inv(matrix), dtype=np.float64)
    except np.linalg.LinAlgError:
        return None
    sure = np.linalg.norm(inverse) * least * max(1.0, float(np.linalg.norm(matrix))) < 1.0
    return inverse if sure else None


def _scale(varied: Varied, solver: Esdirk, tolerance: float) -> Array:
    """Units (n_x,) in which a mismatch counts: amplitudes, but no less than what the integration itself leaves open."""
    return np.maximum(0.5 * (varied.high - varied.low), _WITHIN * _step_error(varied, solver) / tolerance)


def _step_error(varied: Varied, solver: Esdirk) -> Array:
    """Tolerated error of a step in each state, (n_x,)."""
    size = np.maximum(np.abs(varied.high), np.abs(varied.low))
    return solver.rtol * size + solver.atol * varied.nominal


def _examine(varied: Varied, start: Array, solver: Esdirk, tolerance: float) -> Shot:
    n, scale = start.size, _scale(varied, solver, tolerance)
    mismatch = varied.states - start
    solved, drift = _fixed_point(varied.by[:, :n], np.column_stack([mismatch, varied.by[:, n:]]), scale, solver.rtol)
    step = solved[:, 0]
    jumps = np.maximum(tolerance * scale, _JUMPY * _step_error(varied, solver))
    return Shot(varied, start, step, float(np.max(np.abs(step / scale), initial=0.0)), solved[:, 1:], drift, jumps)


def _fixed_point(monodromy: Array, right: Array, scale: Array, least: float) -> tuple[Array, float]:
    """Solve (I - M) y = right (n, m) with states measured by `scale` (n,); and what of the first column is left over.

    A direction in which a period changes a distance from the orbit by less than the integration's own error is taken
    as neutral: nothing brings a state back along it, so the solution has no part in it (least norm in these units).
    """
    if not scale.size:
        return right.copy(), 0.0
    matrix = np.eye(scale.size) - monodromy / scale[:, None] * scale
    inverse = _inverse(matrix, least)
    if inverse is not None:
        return (inverse @ (right / scale[:, None])) * scale[:, None], 0.0
    u, sigma, vt = np.linalg.svd(matrix)
    held = sigma > least * max(1.0, sigma[0])
    inner = u.T @ (right / scale[:, None])
    drift = float(np.max(np.abs(inner[~held, 0]), initial=0.0))
    return (vt[held].T @ (inner[held] / sigma[held, None])) * scale[:, None], drift


def repeats(library: Library, experiment: Experiment, solver: Esdirk, start: Array, tolerance: float) -> bool:
    """Whether a second period ends where the first one did.

    On a periodic orbit it does, unless the model remembers more than its states, as a delay does.

    Args:
        start: (n_x,) states on the orbit.
        tolerance: what may lie between both ends, in amplitudes, or as much as three ends jump with the steps.
    """
    twice = replace(experiment, times=np.append(experiment.times, experiment.times[-1] * 2))
    ends, directions = [], Directions(outputs=False)
    for run in (experiment, twice):
        with library.instance() as instance:
            initialise(instance, run, solver)
            ends.append(vary(instance, run, solver, directions, start=start))
    if not all(end.done for end in ends):
        return False
    amplitude, jumps = 0.5 * (ends[0].high - ends[0].low), 3 * _JUMPY * _step_error(ends[0], solver)
    return bool(np.all(np.abs(ends[1].states - ends[0].states) <= np.maximum(tolerance * amplitude, jumps)))
