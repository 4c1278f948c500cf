"""What stands in the laboratory: the bench with other numbers than the model's, and what the model may lack."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from types import MappingProxyType

import fmu_build
from pysim.bench import BenchData, run_plan
from pysim.diagnosis import Session, session
from pysim.effects import STANDARD_LIBRARY, fitting, read_catalogue, variant
from pysim.io import read_model
from pysim.types import Dataset, Effect, Model
from validation.rig_diagnosis.tests_of_bench import plan

BASE = "HydraulicTestBench.LoadCircuit.OpenTestBench"

# Some percent beside what the model has: these may be refitted.
KNOWN_BADLY: Mapping[str, float] = MappingProxyType(
    {"Jeff": 0.078, "c": 0.22, "K_sv": 1.8e-5, "V_s0": 1.6e-3, "V_L0": 1.05e-3}
)
# Machine -> parameters of the effect that it has and the model lacks, by their names in the class.
MACHINES: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "none": {},
        "shaft.friction": {"tau_c": 14.8939, "tau_s": 54.8258, "omega_0": 8.3593, "r": 13.8806},  # Table 6.2
        "servovalve.deadband": {"u_0": 0.01},
    }
)


@cache
def catalogue() -> dict[str, Effect]:
    """The effects that the bench has slots for."""
    effects = fitting(read_catalogue(STANDARD_LIBRARY), BASE, [STANDARD_LIBRARY])
    return {effect.name: effect for effect in effects}


def build_variant(effects: Sequence[Effect]) -> tuple[Model, Mapping[str, str]]:
    """The model with effects, and effect name -> the name ahead of its parameters."""
    made = variant(BASE, effects, [STANDARD_LIBRARY], name="Bench")
    with tempfile.TemporaryDirectory(prefix="rig-diagnosis-") as folder:
        source = Path(folder) / "Bench.mo"
        source.write_text(made.text, encoding="utf-8")
        return read_model(fmu_build.build("Bench", libraries=[source])), made.places


def truth(machine: str) -> dict[str, float]:
    """Every number that a diagnosis may estimate, by its name in the extended model."""
    slot = catalogue()[machine].slot if machine != "none" else ""
    return {**KNOWN_BADLY, **{f"{slot}.{name}": value for name, value in MACHINES[machine].items()}}


def measured(machine: str, seed: int) -> BenchData:
    """What the virtual bench logs of a machine."""
    effects = [catalogue()[machine]] if machine != "none" else []
    model, _ = build_variant(effects)
    return run_plan(model, plan(), seed, parameters=truth(machine))


def asked(dataset: Dataset) -> Session:
    """The model without any effect beside the logs of a machine, with the whole catalogue."""
    return session(build_variant([])[0], dataset, tuple(catalogue().values()), build_variant)
