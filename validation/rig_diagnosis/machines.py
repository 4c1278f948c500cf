"""What stands in the laboratory: the bench with other numbers than the model's, and what the model may lack."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from types import MappingProxyType

from pysim.bench import BenchData, run_plan
from pysim.diagnosis import Session, session
from pysim.types import Dataset, Effect
from validation.asked import Subject
from validation.rig_diagnosis.tests_of_bench import plan

BENCH = Subject("HydraulicTestBench.LoadCircuit.OpenTestBench")

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
    return {effect.name: effect for effect in BENCH.catalogue}


def truth(machine: str) -> dict[str, float]:
    """Every number that a diagnosis may estimate, by its name in the extended model."""
    slot = catalogue()[machine].slot if machine != "none" else ""
    return {**KNOWN_BADLY, **{f"{slot}.{name}": value for name, value in MACHINES[machine].items()}}


def measured(machine: str, seed: int) -> BenchData:
    """What the virtual bench logs of a machine, whose tests begin at rest and say so."""
    effects = [catalogue()[machine]] if machine != "none" else []
    model, _ = BENCH.variants.build(effects)
    found = run_plan(model, plan(), seed, parameters=truth(machine))
    records = tuple(replace(record, initial="rest") for record in found.dataset.records)
    return replace(found, dataset=replace(found.dataset, records=records))


def asked(dataset: Dataset) -> Session:
    """The model without any effect beside the logs of a machine, with the whole catalogue."""
    return session(BENCH.model, dataset, BENCH.catalogue, BENCH.variants.build)
