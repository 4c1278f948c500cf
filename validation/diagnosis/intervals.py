"""Estimates of a diagnosis beside the true numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from pysim.types import Estimate
from pysim.types.answer import Diagnosis, FoundEffect
from validation.diagnosis.sets import Told

# Powers of s by which numbers change along the one direction that no signal shows: the stroke grows by s and the area
# shrinks, so that their product stays. A force goes with the area, a length with the stroke.
_BASE_POWERS = {"L": 1, "A_p": -1, "m_eff": -2, "k": -2, "b": -2}
_UNIT_POWERS = {"N": -1, "m": 1, "m/s": 1, "N/m3": -4}


def named(found: Diagnosis) -> tuple[FoundEffect, ...]:
    """Effects of the catalogue that were found; errors of sensors have no class."""
    return tuple(one for one in found.effects if one.effect.class_name)


def estimated(truth: Told, found: Diagnosis) -> Iterator[tuple[Estimate, float]]:
    """Each determined number of the final model with its truth.

    Where the direction that scales all forces is open, the diagnosis holds one of its parameters at the estimate: the
    truth is moved along that direction until it agrees there.
    """
    last = found.history[-1]
    held = {next(iter(direction.exponents)) for direction in last.undetermined}
    true = {name: (value, _BASE_POWERS.get(name, 0)) for name, value in truth.base.items()}
    for added in named(found):
        own = truth.strengths(added.effect)
        for p in added.effect.parameters:
            true[f"{added.place}.{p.name}"] = own[p.name], _UNIT_POWERS.get(p.unit, 0)
    scale = _moved([e for e in last.estimates if e.name in held], truth.base)
    for estimate in last.estimates:
        if estimate.determined and estimate.name in true and estimate.name not in held:
            value, power = true[estimate.name]
            yield estimate, value * scale**power


def _moved(held: Sequence[Estimate], true: Mapping[str, float]) -> float:
    """The s of the direction: 1 where all is determined."""
    pivot = next((e for e in held if e.name in _BASE_POWERS), None)
    return 1.0 if pivot is None else float((pivot.value / true[pivot.name]) ** (1 / _BASE_POWERS[pivot.name]))
