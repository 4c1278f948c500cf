"""The machines: pump and test bench, what each lacks, and how its logs came about."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from pysim.types import Dataset
from validation.blind.plant import BOUNDS, FEW_SINES, STANDARD, Case, Parameters, Strengths, measure
from validation.rig_diagnosis import machines as rig

# Of the blind plant's programme: a wave that is fitted, one that is held out, and eight of 65 stepped sines.
_GIVEN = ("stochastic/Tp1.0_fit.txt", "stochastic/Tp0.5_heldout.txt", *FEW_SINES)
_UNSEEN = "chirp/O+50_A10.txt"
_NOISE = 0.1  # percent, of the angle
# Powers of s by which numbers change along the one direction that no signal shows: the stroke L grows by s.
_POWERS = {"coulomb__F_c": -1, "hardening__k_3": -4}

Found = Mapping[str, Any]  # the JSON of a diagnosis


@dataclass(frozen=True)
class Machine:
    """One machine and its right answer.

    Args:
        about: in words.
        model: the class that is compared with its logs.
        right: effects, the one that costs most when left out first; none where nothing of the catalogue is missing.
        dataset: measures it.
        truth: "effect.parameter" -> value, as the class declares it, beside a diagnosis.
        unseen: error over noise, of a model that was found, on a log that no diagnosis is given; None where that is
            not looked at.
        unknown: whether something is missing that is in no catalogue.
        stated: noise that the data set states, over what there is; 0 where it states none.
    """

    about: str
    model: str
    right: tuple[str, ...]
    dataset: Callable[[], Dataset]
    truth: Callable[[Found], Mapping[str, float]]
    unseen: Callable[[Found], float] | None = None
    unknown: bool = False
    stated: float = 1.0

    @property
    def verdict(self) -> str:
        """The right one."""
        return self.right[0] if self.right else "unknown" if self.unknown else "none"


@dataclass(frozen=True)
class _Pump(Case):
    """A case of the blind plant whose strengths are set, not drawn."""

    given: Mapping[str, float] = field(default_factory=dict)

    def strengths(self) -> Strengths:
        return Strengths(**self.given)


def _pump(about: str, strengths: Mapping[str, float], *nuisances: str, stated: float = 1.0, seed: int = 1) -> Machine:
    """A pump measured by the blind plant, which shares no equation with the models."""
    known = {part.field: (name, part.symbol) for name, parts in STANDARD.items() for part in parts}
    right = tuple(dict.fromkeys(known[field][0] for field in strengths if field in known))
    effects = tuple((name, "middle") for name in right)
    case = _Pump("pump", "named", effects, nuisances, _NOISE, seed=seed, given=strengths)

    def dataset() -> Dataset:
        whole = measure(case).dataset
        records = tuple(record for record in whole.records if record.source in _GIVEN)
        signals = tuple(
            one if one.noise is None else replace(one, noise=stated * one.noise if stated else None)
            for one in whole.signals
        )
        return replace(whole, signals=signals, records=records)

    def truth(found: Found) -> dict[str, float]:
        s = found["parameters"]["L"]["value"] / case.parameters().L
        named = {f: value for f, value in strengths.items() if f in known}
        return {".".join(known[f]): value * s ** _POWERS.get(f, 0) for f, value in named.items()}

    def unseen(found: Found) -> float:
        return _error(case, found)

    return Machine(
        about, "HydraulicTestBench.Pump.FreeGreyBox", right, dataset, truth, unseen, len(right) < len(strengths), stated
    )


def _error(case: _Pump, found: Found) -> float:
    """Of a model, its numbers put into the plant: on the chirp, beside the plant's own readings; 1 at best."""
    own = {name: found["parameters"][name]["value"] for name in BOUNDS}
    fields: dict[str, float] = {}
    for added in found["added"]:
        parts = {part.symbol: part.field for part in STANDARD[added["effect"]]}
        fields |= {parts[name]: value for name, value in added["parameters"].items() if name in parts}
    clean = [measure(one).clean[_UNSEEN][:, 0] for one in (case, _Found(**{**vars(case), "given": fields}, own=own))]
    return float(np.sqrt(1 + np.mean(((clean[0] - clean[1]) / _NOISE) ** 2)))


@dataclass(frozen=True)
class _Found(_Pump):
    """The plant with numbers that were found."""

    own: Mapping[str, float] = field(default_factory=dict)

    def parameters(self) -> Parameters:
        return Parameters(**self.own)


def _bench(about: str, machine: str, seed: int = 1) -> Machine:
    """The test bench, driven by our own model with what it lacks."""
    right = () if machine == "none" else (machine,)

    def truth(_: Found) -> dict[str, float]:
        return {f"{machine}.{name}": value for name, value in rig.MACHINES[machine].items()}

    return Machine(about, rig.BENCH.class_name, right, lambda: rig.measured(machine, seed).dataset, truth)


MACHINES: Mapping[str, Machine] = MappingProxyType(
    {
        "pump-none": _pump("complete pump", {}),
        "pump-deadband": _pump("overlap of the valve", {"deadband__u_0": 0.016}),
        "pump-coulomb": _pump("dry friction of the piston", {"coulomb__F_c": 80.0}),
        "pump-two": _pump("overlap and dry friction", {"deadband__u_0": 0.02, "coulomb__F_c": 60.0}),
        "pump-start": _pump("overlap; the logs begin in motion", {"deadband__u_0": 0.016}, "start"),
        "pump-noise-not-stated": _pump("hardening spring; no noise stated", {"hardening__k_3": 2.4e7}, stated=0.0),
        "pump-noise-too-small": _pump("complete pump; 0.3 of its noise stated", {}, stated=0.3),
        "pump-coloured": _pump("complete pump, coloured noise", {}, "coloured"),
        "pump-unknown": _pump("quadratic damping, in no catalogue", {"quadratic__b_2": 4e4}),
        "pump-stopped": _pump("spool stopped at 0.52: several steady states", {"saturation__u_max": 0.52}),
        "bench-none": _bench("complete test bench", "none"),
        "bench-stick-slip": _bench("stick-slip friction of the shaft", "shaft.friction"),
    }
)
