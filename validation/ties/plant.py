"""Masses and drives with one effect, measured for a few seconds only, and the bench that they stand on."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np

from pysim.bench import read_plan, run_plan
from pysim.diagnosis import Session, session
from pysim.effects import read_catalogue
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Effect, Experiment, MeasuredRecord, MeasuredSignal, Model, Record, Signal
from pysim.workflow.variants import Variants

MODELS = Path(__file__).parents[2] / "tests" / "known_answers" / "models"
_RATE, _STANDS = 50.0, 1.0  # Hz of a log; s of standstill ahead of it
_SPREAD = 0.1  # of free parameters around the design, uniform
_FINE = Rodas(rtol=1e-8, atol=1e-8)


@dataclass(frozen=True)
class Kind:
    """A plant.

    Args:
        free: parameters that differ from the design.
        command: name, unit, largest value, and band in Hz.
        outputs: name, unit and noise of each.
        sizes: effect -> weakest and strongest size of each of its parameters, log-uniform between.
    """

    free: tuple[str, ...]
    command: tuple[str, str, float, tuple[float, float]]
    outputs: tuple[tuple[str, str, float], ...]
    sizes: Mapping[str, Mapping[str, tuple[float, float]]]


KINDS = {
    "mass": Kind(
        ("m", "d", "k"), ("F", "N", 8.0, (0.2, 2.5)), (("x", "m", 1e-3),),
        {
            "mass.friction": {"F_c": (0.02, 0.2)},
            "mass.drag": {"c_2": (0.02, 0.5)},
            "mass.hardening": {"k_3": (3.0, 100.0)},
        },
    ),
    "axis": Kind(
        ("d", "K", "T"), ("x_ref", "m", 0.1, (0.1, 1.5)), (("x", "m", 1e-4), ("i", "V", 0.01)),
        {"axis.friction": {"F_c": (0.3, 3.0)}, "axis.dead_band": {"u_0": (0.005, 0.1)}},
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Plant:
    """One plant: its effect, and every number that is in force, by its name in the model with the effect."""

    kind: str
    effect: str
    model: Model
    values: Mapping[str, float]

    def session(self, data: Dataset) -> Session:
        """The model without the effect beside data, with all effects of its library."""
        own, (base, _) = _variants(self.kind), _variants(self.kind).build(())
        return session(base, data, list(_catalogue(self.kind).values()), own.build, slots=own.slots, workers=1)

    def first_log(self, rng: np.random.Generator, seconds: float) -> Dataset:
        """One sine of that length, grown from rest within a second."""
        kind = KINDS[self.kind]
        name, unit, peak, band = kind.command
        time = np.arange(round(seconds * _RATE)) / _RATE
        wave = np.sin(2 * np.pi * rng.uniform(*band) * time) * np.clip(time, 0, 1) ** 2
        command = Signal.through(time, peak * wave)
        names, units, noise = zip(*kind.outputs, strict=True)
        run = Experiment(time, names, {name: command}, dict(self.values), start=-_STANDS)
        read = simulate(self.model, run, solver=_FINE).values
        read = read + np.array(noise) * rng.standard_normal(read.shape)
        log = Record(time, np.column_stack([command.value(time), read]), (name, *names), (unit, *units))
        signals = [MeasuredSignal(name, "input", unit, name, name)]
        signals += [MeasuredSignal(n, "output", u, n, n, noise=size) for n, u, size in kind.outputs]
        return Dataset(
            "tie", "one short sine", "plant", tuple(signals), (MeasuredRecord("a", "stochastic", "fit", log),)
        )

    def tested(self, data: Dataset, plan: str, seed: int) -> Dataset:
        """The data, and what the virtual bench measures when it runs a plan on this plant."""
        with tempfile.TemporaryDirectory(prefix="tie-") as folder:
            path = Path(folder) / "plan.toml"
            path.write_text(plan, encoding="utf-8")
            new = run_plan(self.model, read_plan(path), seed, parameters=self.values).dataset
        inputs = [signal for signal in data.signals if signal.role == "input"]
        signals = (*inputs, *(signal for signal in new.signals if signal.role == "output"))
        return replace(data, signals=signals, records=(*data.records, *new.records))


def drawn(kind: str, effect: str, rng: np.random.Generator) -> Plant:
    """A plant with that effect."""
    model, places = _variants(kind).build([_catalogue(kind)[effect]])
    base = _variants(kind).build(())[0]
    values = {name: float(base[name].start or 0.0) * (1 + _SPREAD * rng.uniform(-1, 1)) for name in KINDS[kind].free}
    for name, (weak, strong) in KINDS[kind].sizes[effect].items():
        values[f"{places[effect]}.{name}"] = float(weak * (strong / weak) ** rng.uniform())
    return Plant(kind, effect, model, values)


@cache
def _variants(kind: str) -> Variants:
    return Variants(f"{kind.capitalize()}.Design", (MODELS / f"{kind.capitalize()}.mo",))


@cache
def _catalogue(kind: str) -> dict[str, Effect]:
    return {effect.name: effect for effect in read_catalogue(MODELS / f"{kind.capitalize()}.mo")}
