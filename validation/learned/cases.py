"""The cases: which law, how large, what is measured of it, and what a right answer is."""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record
from validation.blind.plant import BOUNDS, Parameters, Strengths, run
from validation.blind.plant.command import Command, Lead, stepped_sine, wave
from validation.blind.plant.quantities import STEP
from validation.learned.laws import Laws, plant

Array = NDArray[np.float64]

NOISE = MappingProxyType({"alphaPercent": 0.02, "u": 0.0004})  # standard deviations, percent and 1
RATE = 250.0  # Hz
_SAMPLE = round(1 / RATE / STEP)  # steps
_PERCENT = math.radians(15.0) / 100
_SPREAD = 0.1  # of the parameters around the thesis' values
_SWING = 34.0  # percent, standard deviation of a wave
_TESTS: tuple[tuple[str, str, float, float], ...] = (
    *((f"sine-{f:g}Hz", "fit", f, max(3.0, math.ceil(1.2 * f)) / f) for f in (0.5, 1.0, 2.0, 4.0, 8.0, 13.0, 20.0)),
    ("wave-1", "fit", 1.0, 25.0),
    ("wave-2", "validate", 0.7, 15.0),
    ("wave-3", "test", 0.8, 20.0),
    ("wave-4", "fit", 1.0, 25.0),
)
"""Name, use, frequency of a sine or peak period of a wave, length in s; in the order in which they are carried out."""


@dataclass(frozen=True)
class Kind:
    """One law, or two at once.

    Args:
        name: of the law.
        small, large: numbers of `Laws` or of the blind plant's `Strengths`, by size.
        places: slots of the model, for each law those that are right.
        variables: for each law groups of variables, of each of which it has to depend on one, and on no others; none
            where that is not asked.
        form: factor and argument of the first law, where it is `factor*h(argument)`.
        curve: the true h over the argument then; the numbers drawn and the plant's parameters are given.
    """

    name: str
    small: Mapping[str, float]
    large: Mapping[str, float]
    places: tuple[tuple[str, ...], ...]
    variables: tuple[tuple[tuple[str, ...], ...], ...] = ()
    form: tuple[str, str] = ("", "")
    curve: Callable[[Array, Laws, Parameters], Array] | None = None

    @property
    def visible(self) -> bool:
        return bool(self.places)


_FORCE = (("pistonForce",),)
_EDGES = (("spoolOpening",),)
_RUB = ((("x",), ("v",)),)
KINDS = (
    Kind("damping.position", {"damping__b": 4e3}, {"damping__b": 12e3}, _FORCE, _RUB, ("v", "x"),
         lambda x, law, p: -law.damping__b * (x / 20e-3) ** 2),
    Kind("damping.drift", {"drift__share": 0.1}, {"drift__share": 0.4}, _FORCE, ((("v",), ("time",)),), ("v", "time"),
         lambda t, law, p: law.drift__share * p.b * (1 - np.exp(-t / law.drift__T))),
    Kind("supply.falling", {"supply__r": 8.5e3}, {"supply__r": 25e3}, (("supply",),), ((("time",),),), ("", "time"),
         lambda t, law, p: law.supply__r * t),
    Kind("spool.flow_force", {"flow_force__share": 0.05}, {"flow_force__share": 0.2}, (("spool",),)),
    Kind("friction.pressure", {"pressure_friction__c": 12e-5}, {"pressure_friction__c": 20e-5}, _FORCE,
         ((("v",), ("p1", "p2", "dp")),)),
    Kind("valve.notch", {"notch__share": 0.3}, {"notch__share": 0.7}, _EDGES, ((("s",),),), ("", "s"),
         lambda u, law, p: -law.notch__share * u * np.exp(-((u / law.notch__u) ** 2))),
    Kind("friction.position", {"bump__F": 80}, {"bump__F": 240}, _FORCE, _RUB, ("sign(v)", "x"),
         lambda x, law, p: -law.bump__F * np.exp(-(((x - law.bump__x) / law.bump__w) ** 2))),
    Kind("friction.dahl", {"dahl__F": 60}, {"dahl__F": 200}, _FORCE),
    Kind("friction.lugre", {"lugre__F": 60}, {"lugre__F": 200}, _FORCE),
    Kind("shaft.tone", {"shaft__F": 60}, {"shaft__F": 200}, _FORCE),
    Kind("leakage.turbulent", {"turbulent__K": 2e-8}, {"turbulent__K": 8e-8}, (("externalLeakage",),), ((("p1",),),),
         ("", "p1"), lambda q, law, p: law.turbulent__K * np.sqrt(2 * np.maximum(q, 0) / p.rho)),
    Kind("linkage.compliant", {"compliant__d": 3e-5}, {"compliant__d": 15e-5}, (("linkage", "angleSensor"),)),
    Kind("valve.edge_play", {"edge_play__h": 0.003}, {"edge_play__h": 0.012}, _EDGES),
    Kind("two", {"damping__b": 6e3, "notch__share": 0.4}, {"damping__b": 12e3, "notch__share": 0.7},
         (*_FORCE, *_EDGES), (*_RUB, (("s",),))),
    Kind("cushion.unreached", {"cushion__k": 1e6}, {"cushion__k": 1e7}, ()),
)  # fmt: skip
"""The last one acts where no test goes: nothing is to be found."""


@dataclass(frozen=True)
class LearnedCase:
    """One case; the same case always leaves the same logs."""

    kind: Kind
    size: str  # "small" | "large"
    seed: int
    condition: str = ""  # one of CONDITIONS

    @property
    def name(self) -> str:
        return "-".join(filter(None, (self.kind.name, self.size, str(self.seed), self.condition)))

    def parameters(self) -> Parameters:
        """Each identified one within 10 percent of the thesis' value and within its bounds."""
        rng = self.stream("parameters")
        drawn = {}
        for name, (low, high) in BOUNDS.items():
            value = getattr(Parameters(), name) * (1 + _SPREAD * rng.uniform(-1, 1))
            drawn[name] = float(min(max(value, low), high))
        return Parameters(**drawn)

    def laws(self) -> tuple[Laws, Strengths]:
        """Numbers of the law; of another seed than 1 within a fifth of the size."""
        numbers = self.kind.small if self.size == "small" else self.kind.large
        share = 1.0 if self.seed == 1 else float(self.stream("size").uniform(0.8, 1.25))
        drawn = {name: share * value for name, value in numbers.items()}
        ours = {name: value for name, value in drawn.items() if name in Laws._fields}
        blind = {name: value for name, value in drawn.items() if name in Strengths._fields}
        return Laws(**ours), Strengths(**blind)

    def stream(self, purpose: str) -> np.random.Generator:
        """Random numbers of one purpose, independent of those of any other."""
        return np.random.default_rng((self.seed, zlib.crc32(f"{self.kind.name} {purpose}".encode())))


CONDITIONS = ("angle", "unstated", "motion")
"""The spool is not logged; noise is not specified; logs of waves begin four seconds late, in motion."""
_LATE = 4.0  # s
_TWELVE = (
    "damping.position", "damping.drift", "supply.falling", "spool.flow_force", "friction.pressure", "valve.notch",
    "friction.position", "friction.dahl", "shaft.tone", "leakage.turbulent", "linkage.compliant", "valve.edge_play",
)  # fmt: skip
CASES = (
    *(
        LearnedCase(kind, size, seed)
        for kind in KINDS
        for size, seed in (("small", 1), ("large", 1), ("large", 2), ("large", 3))
    ),
    *(LearnedCase(kind, "large", 1, condition) for kind in KINDS if kind.name in _TWELVE for condition in CONDITIONS),
)
"""Sixty, and twelve again under each condition."""


@dataclass(frozen=True)
class Measured:
    """What a case leaves.

    Args:
        given: logs for the diagnosis, with noise.
        unseen: a wave that it is not given, without noise, of use "test".
    """

    given: Dataset
    unseen: Dataset = field(repr=False)


def measure(case: LearnedCase) -> Measured:
    """Carry out the tests one after the other on one clock, which the logs' times are on."""
    parameters, (laws, strengths) = case.parameters(), case.laws()
    records: dict[bool, list[MeasuredRecord]] = {True: [], False: []}
    clock = 0.0
    for name, use, of, length in _TESTS:
        command = _command(case, name, of, length)
        logged = run(
            command.level * _PERCENT, command.slope * _PERCENT, command.every, round(command.start / STEP), _SAMPLE,
            parameters=parameters, strengths=strengths, clock=clock, plant=plant, law=laws,
        )[: round(length * RATE) + 1]  # fmt: skip
        first = round(command.start / STEP) // command.every
        orders = command.level[first + np.arange(len(logged)) * _SAMPLE // command.every]
        readings = np.column_stack([logged[:, 0] / _PERCENT, logged[:, 1]])
        if use != "test":
            readings += case.stream(name).standard_normal(readings.shape) * list(NOISE.values())
        late = round(_LATE * RATE) if case.condition == "motion" and name.startswith("wave") else 0
        time = clock + command.start + np.arange(len(logged)) / RATE
        record = _record(name, use, of, time[late:], orders[late:], readings[late:])
        records[use == "test"].append(_without_spool(record) if case.condition == "angle" and use != "test" else record)
        clock += command.start + length
    about = "swash plate tests without load: stepped sines and waves"
    signals: tuple[MeasuredSignal, ...] = (
        MeasuredSignal("alphaCMD", "input", "%", "swash plate angle command", "alphaCMD"),
        MeasuredSignal("alphaPercent", "output", "%", "swash plate angle", "alphaPercent", NOISE["alphaPercent"]),
        MeasuredSignal("u", "output", "1", "spool position", "u", NOISE["u"]),
    )
    unseen = Dataset(case.name, about, "pump", signals, tuple(records[True]))
    if case.condition == "unstated":
        signals = tuple(replace(signal, noise=None) for signal in signals)
    given = Dataset(case.name, about, "pump", signals[: 2 if case.condition == "angle" else 3], tuple(records[False]))
    return Measured(given, unseen)


def _command(case: LearnedCase, name: str, of: float, length: float) -> Command:
    if name.startswith("sine"):
        return stepped_sine(Lead(50.0), 50.0, 10.0, of, length)
    return wave(Lead(0.0), (case.seed, zlib.crc32(name.encode())), of, _SWING, length)


def _without_spool(record: MeasuredRecord) -> MeasuredRecord:
    log = record.data
    assert isinstance(log, Record)
    return replace(record, data=replace(log, values=log.values[:, :2], names=log.names[:2], units=log.units[:2]))


def _record(name: str, use: str, of: float, time: Array, orders: Array, readings: Array) -> MeasuredRecord:
    if name.startswith("sine"):
        data = Record(time, np.column_stack([orders, readings[:, 0]]), ("alphaCMD", "alphaPercent"), ("%", "%"),
                      origin="measured")  # fmt: skip
        return MeasuredRecord(f"{name}.csv", "frequency-response", use, data, 50.0, 10.0, of, begin=float(time[0]))
    names, units = ("alphaCMD", "alphaPercent", "u"), ("%", "%", "1")
    data = Record(time, np.column_stack([orders, readings]), names, units, origin="measured")
    return MeasuredRecord(f"{name}.csv", "stochastic", use, data, begin=float(time[0]))
