"""What a virtual bench knows and a real one does not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from pysim.types import Dataset


@dataclass(frozen=True)
class Truth:
    """What stood behind a data set.

    Args:
        model, token: which FMU.
        parameters: every parameter in force, in the model's SI units.
        parameter_units: of the same names.
        effect, strength: what the model has beyond the one it will be compared with, as the caller states it.
        noise, resolution: of every signal, in its SI unit; None where there is none.
        plan, seed: what it takes to repeat it.
        clean: the same records without sensors, at the instants the logs' rows were taken.
    """

    model: str
    token: str
    parameters: Mapping[str, float]
    parameter_units: Mapping[str, str]
    noise: Mapping[str, float | None]
    resolution: Mapping[str, float | None]
    plan: str
    seed: int
    clean: Dataset
    effect: str = "none"
    strength: Mapping[str, float] = field(default_factory=dict)


def truth_data(truth: Truth) -> dict[str, Any]:
    """The truth for JSON, without the signals."""
    return {
        "effect": truth.effect,
        "strength": dict(truth.strength),
        "parameters": dict(truth.parameters),
        "parameter_units": dict(truth.parameter_units),
        "noise": dict(truth.noise),
        "resolution": dict(truth.resolution),
        "units": "SI",
        "model": truth.model,
        "token": truth.token,
        "plan": truth.plan,
        "seed": truth.seed,
    }
