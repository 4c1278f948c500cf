"""Signals that a bench could log beside those it has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pysim.diagnose.candidate_tests import CandidateTest
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.subject import Subject
from pysim.simulate import Rodas, simulate_many
from pysim.types import Dataset, MeasuredSignal, Model, Outcome

# Noise taken for a signal that was never logged, in shares of what it goes through; in errors of the integration at
# least, which would be taken for evidence otherwise; and where that is more than this share, nothing is to be read.
_UNLOGGED, _ERRORS, _MOST = 1e-3, 10.0, 0.1
# Relative tolerances that tell the error of the first.
_COARSE, _FINE = 1e-5, 1e-7
# Units of numbers within a controller or a block, where nothing stands that a sensor could be put to.
_WITHIN = ("", "1", "%", "%/s")


@dataclass(frozen=True)
class Loggable:
    """What may be logged beside the data set's signals, with noise assumed.

    Args:
        outputs: of the model, which its author holds for measurable.
        states: in physical units, for which a sensor would have to be found.
    """

    outputs: tuple[MeasuredSignal, ...] = ()
    states: tuple[MeasuredSignal, ...] = ()


def loggable(
    subject: Subject, dataset: Dataset, rivals: Sequence[Fitted], tests: Sequence[CandidateTest], workers: int | None
) -> Loggable:
    """Outputs and states that the base model and all rivals have, and that move in the tests.

    Args:
        rivals: fitted models; the first one says how far a signal moves.
    """
    known = {signal.variable for signal in dataset.signals}
    shared = set.intersection(*({v.name for v in rival.what.model.variables} for rival in rivals))
    names = [name for name in _measurable(subject.model) if name not in known and name in shared]
    found = {
        name: MeasuredSignal(name, "output", subject.model[name].unit, name, name, noise=noise)
        for name, noise in _noise(subject, rivals[0], names, tests, workers).items()
    }
    outputs = tuple(signal for name, signal in found.items() if subject.model[name].causality == "output")
    return Loggable(outputs, tuple(signal for signal in found.values() if signal not in outputs))


def _measurable(model: Model) -> list[str]:
    outputs = [v.name for v in model.variables if v.causality == "output"]
    return list(dict.fromkeys([*outputs, *(s for s in model.abilities.states if model[s].unit not in _WITHIN)]))


def _noise(
    subject: Subject, fitted: Fitted, names: Sequence[str], tests: Sequence[CandidateTest], workers: int | None
) -> dict[str, float]:
    """Of the signals that move by more than what the integration leaves open, by name."""
    if not names:
        return {}
    overrides = {**subject.targets[0].runs[0].experiment.overrides, **fitted.what.space.values(fitted.point.x)}
    runs = [test.experiment(fitted.what.model, tuple(names), overrides) for test in tests]
    each = [
        simulate_many(fitted.what.model, runs, solver=Rodas(rtol=rtol, atol=rtol), workers=workers)
        for rtol in (_COARSE, _FINE)
    ]
    if any(r.outcome is not Outcome.DONE or not np.isfinite(r.values).all() for records in each for r in records):
        return {}
    coarse, fine = (np.concatenate([record.values for record in records]) for records in each)
    span, error = np.ptp(fine, axis=0), np.sqrt(np.mean((coarse - fine) ** 2, axis=0))
    noise = np.maximum(_UNLOGGED * span, _ERRORS * error)
    return {n: float(own) for n, own, wide in zip(names, noise, span, strict=True) if 0 < own < _MOST * wide}
