"""Pumps with effects, built, and their right-hand side at any state."""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import fmu_build
from pysim.effects import Variant, fitting, read_catalogue, variant
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Effect, Experiment, Model, Record, Signal
from tests.contracts.fmu import Fmu
from tests.modelica.library import LIBRARY

BASE = "HydraulicTestBench.Pump.FreeGreyBox"
CATALOGUE = {effect.name: effect for effect in fitting(read_catalogue(LIBRARY), BASE, [LIBRARY])}
EXACT = tuple(name for name, effect in CATALOGUE.items() if not effect.bypass)
BYPASSED = tuple(name for name, effect in CATALOGUE.items() if effect.bypass)
TIGHT = Rodas(rtol=1e-8, atol=1e-8)


def effects(names: Sequence[str]) -> list[Effect]:
    return [CATALOGUE[name] for name in names]


def built_variant(made: Variant, probes: Sequence[str] = ()) -> Path:
    """The FMU of a class `Variant`, in the store."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "Variant.mo"
        file.write_text(made.text)
        return fmu_build.build("Variant", libraries=[file], probes=probes)


@cache
def pump(names: tuple[str, ...]) -> tuple[Variant, Path]:
    """The free pump with these effects, and its FMU."""
    made = variant(BASE, effects(names), [LIBRARY], name="Variant")
    return made, built_variant(made)


def model(names: tuple[str, ...]) -> Model:
    return read_model(pump(names)[1]) if names else read_model(fmu_build.build(BASE))


def settings(names: tuple[str, ...], values: Mapping[str, Mapping[str, float]]) -> dict[str, float]:
    """effect -> parameter -> value, by the variables' names in the FMU."""
    made = pump(names)[0]
    return {made.parameter(e, p): value for e, given in values.items() for p, value in given.items()}


def ran(
    names: tuple[str, ...],
    values: Mapping[str, Mapping[str, float]],
    recorded: Sequence[str],
    stop: float = 1.5,
    step: float = 1e-3,
) -> Record:
    """Three seconds of a sine around an offset, 40 + 20 sin(2 pi 2 t) percent, begun smoothly."""
    times = np.arange(0.0, stop, step)
    knots = np.arange(0.0, stop + 0.01, 0.005)
    swing = (1 - np.exp(-knots / 0.1)) * (15 + 35 * np.sin(2 * np.pi * 2 * knots))
    command = Signal.through(knots, swing)
    overrides = settings(names, values) if names else {}
    experiment = Experiment(times, tuple(recorded), {"alphaCMD": command}, overrides, rates={"alphaCMD_t": "alphaCMD"})
    return simulate(model(names), experiment, solver=TIGHT)


class RightHandSide:
    """Derivatives and variables of a pump at states and inputs of choice. Use as a context manager."""

    def __init__(self, names: tuple[str, ...], folder: Path) -> None:
        self.names = names
        path = pump(names)[1] if names else fmu_build.build(BASE)
        self.fmu = Fmu.unpack(path, folder / f"fmu{len(names)}", 2)

    def __enter__(self) -> "RightHandSide":
        self.instance = self.fmu.open("me").start()
        return self

    def __exit__(self, *failure: object) -> None:
        self.instance.__exit__(*failure)

    def at(self, states: Mapping[str, float], parameters: Mapping[str, float] | None = None) -> dict[str, float]:
        """State -> derivative; states that are not given follow `linkage.y = piston.x`, else are zero."""
        full = {"linkage.y": states["piston.x"], **states}
        values = [full.get(name, 0.0) for name in self.fmu.states]
        self.instance.x = values
        self.instance.set_in_event_mode(parameters or {})
        self.instance.x = values  # an event may have changed them
        return dict(zip(self.fmu.states, self.instance.dx.tolist(), strict=True))

    def __getitem__(self, name: str) -> float:
        return float(self.instance.get([name])[0])


def states(rng: np.random.Generator) -> dict[str, float]:
    """A state of the base model somewhere in its working range."""
    size = {"commandRate.followed": 60, "commandRate.untold": 50, "commandRate.untold_t": 1e3, "spool.u": 0.4}
    size |= {"spool.u_t": 30, "piston.x": 15e-3, "piston.v": 0.3}
    size |= {f"deadTime.z{k}": 0.1 for k in (1, 2, 3)}
    drawn = {name: float(rng.uniform(-s, s)) for name, s in size.items()}
    return drawn | {f"chamber{k}.p": float(rng.uniform(10e5, 160e5)) for k in (1, 2)}
