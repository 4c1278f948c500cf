"""One case from beginning to end: measured, diagnosed, held against the truth."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from pysim.diagnose import diagnose, subject
from pysim.types import Diagnosis, Stage
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.intervals import intervals
from validation.blind.benchmark.truth import Truth
from validation.blind.benchmark.workshop import workshop
from validation.blind.plant import Case, Measured, measure

SEED = 0  # of the diagnosis
_COLUMNS = ("alphaPercent", "u")


def examine(case: Case) -> Answer:
    """The answer to one case, in this process and with one thread."""
    shop, measured = workshop(), measure(case)
    catalogue = tuple(effect for effect in shop.catalogue if effect.name not in case.left_out)
    for effect in shop.catalogue:  # before the time counts
        shop.variant([effect])
    compiled, wall, cpu = shop.seconds, time.monotonic(), time.process_time()
    found = diagnose(subject(shop.model, measured.dataset, catalogue, shop.variant), seed=SEED, workers=1)
    return Answer(
        case.name,
        found.verdict,
        tuple(one.effect.name for one in found.added),
        tuple(candidate.effect for candidate in found.ranking if candidate.round == 1)[:2],
        found.confusable,
        wall=time.monotonic() - wall - (shop.seconds - compiled),
        cpu=time.process_time() - cpu,
        **_judged(Truth(case, measured, shop), found),
    )


def _judged(truth: Truth, found: Diagnosis) -> dict[str, Any]:
    """Fields of an answer."""
    case = truth.case
    first = next((stage for stage in found.stages if stage.step == "refit"), None)
    last = found.stages[-1] if found.stages else None
    fields: dict[str, Any] = {"residual": found.error[-1].validate if found.error else None}
    fields |= {"base": error(truth.measured, first), "final": error(truth.measured, last)}
    if case.effects:
        near = {e.name: e.value for e in first.estimates} if first is not None else None
        fields["detectability"] = truth.left((), near)
    if case.kind in ("named", "pair"):
        fields["bound"] = truth.bound()
    names = sorted(name for name, _ in case.effects)
    if case.kind in ("none", "named", "pair") and sorted(one.effect.name for one in found.added) == names:
        looked = dict(intervals(truth, found))
        fields |= {"determined": len(looked), "missed": tuple(name for name, holds in looked.items() if not holds)}
    return fields


def error(measured: Measured, stage: Stage | None) -> float | None:
    """Root mean square of simulated minus noise-free over the noise, of all held-out samples."""
    parts = []
    for record in stage.records if stage is not None else ():
        if record.use == "validate":
            clean = dict(zip(_COLUMNS, measured.clean[record.source].T, strict=True))
            for j, name in enumerate(record.simulated.names):
                parts.append((record.simulated.values[:, j] - clean[name]) / record.noise[j])
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2))) if parts else None
