"""A diagnosis beside the truth: errors on held-out records, intervals, footprints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from pysim.types import Diagnosis, Effect, Estimate, Stage
from validation.blind.benchmark.truth import Truth
from validation.blind.plant.case import Measured

# Powers of s by which numbers change along the one direction that no signal shows: the stroke grows by s and the area
# shrinks, so that their product stays. A force goes with the area, a length with the stroke.
_BASE_POWERS = {"L": 1, "A_p": -1, "m_eff": -2, "k": -2, "b": -2}
_UNIT_POWERS = {"N": -1, "m": 1, "m/s": 1, "N/m3": -4}
_COLUMNS = ("alphaPercent", "u")


def judged(truth: Truth, found: Diagnosis) -> dict[str, Any]:
    """Fields of an answer."""
    case = truth.case
    names = [name for name, _ in case.effects]
    first, last = _first_and_last(found.stages)
    base, final = error(truth.measured, first), error(truth.measured, last)
    told: dict[str, Any] = {"held": found.error[-1].validate, "base": base, "final": final}
    if case.effects:
        told["footprint"] = truth.left((), {e.name: e.value for e in first.estimates} if first is not None else None)
    if case.kind == "pair":
        told["parts"] = {name: truth.left([n for n in names if n != name]) for name in names}
    if case.kind in ("named", "pair"):
        limits = truth.held_out()
        told |= {} if limits is None else dict(zip(("bound", "floor"), limits, strict=True))
    if case.kind in ("none", "named", "pair") and sorted(e.effect.name for e in found.added) == sorted(names):
        looked = dict(intervals(truth, found))
        told |= {"determined": len(looked), "missed": tuple(name for name, holds in looked.items() if not holds)}
    return told


def _first_and_last(stages: Sequence[Stage]) -> tuple[Stage | None, Stage | None]:
    refitted = next((stage for stage in stages if stage.step == "refit"), None)
    return refitted, stages[-1] if stages else None


def error(measured: Measured, stage: Stage | None) -> float | None:
    """Root mean square of simulated minus noise-free over the noise, of all held-out samples."""
    parts = []
    for record in stage.records if stage is not None else ():
        if record.use == "validate":
            clean = dict(zip(_COLUMNS, measured.clean[record.source].T, strict=True))
            for j, name in enumerate(record.simulated.names):
                parts.append((record.simulated.values[:, j] - clean[name]) / record.noise[j])
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2))) if parts else None


class Known(Protocol):
    """What is true of a plant."""

    @property
    def base(self) -> Mapping[str, float]:
        """The identified parameters."""
        ...

    def strengths(self, effect: Effect) -> Mapping[str, float]:
        """An effect's parameters as its class declares them."""
        ...


def intervals(truth: Known, found: Diagnosis) -> Iterator[tuple[str, bool]]:
    """Of what is determined and, in truth and estimate, away from its bounds: whether its interval holds the truth."""
    for estimate, true in estimated(truth, found):
        inside = estimate.lower * (1 + 1e-9) < true < estimate.upper * (1 - 1e-9)
        if inside and not estimate.at:
            yield estimate.name, bool(estimate.interval[0] <= true <= estimate.interval[1])


def estimated(truth: Known, found: Diagnosis) -> Iterator[tuple[Estimate, float]]:
    """Each determined number of the final model with its truth.

    Where the direction that scales all forces is open, the diagnosis holds one of its parameters at the estimate: the
    truth is moved along that direction until it agrees there.
    """
    if not found.stages:
        return
    last = found.stages[-1]
    held = {next(iter(direction.exponents)) for direction in last.undetermined}
    true = {name: (value, _BASE_POWERS.get(name, 0)) for name, value in truth.base.items()}
    for added in found.added:
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
