"""Measurements that come along, to try everything on: each of a machine that has something its model lacks."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.types import BadInput, Dataset, Experiment, MeasuredRecord, MeasuredSignal, Record, Signal

if TYPE_CHECKING:
    from numpy.typing import NDArray

_HOME = Path(__file__).parent / "examples"
_ROWS = 1600  # of a log
_KNOTS = 32  # of the command along a log
_LOGS = (("first.csv", "fit"), ("second.csv", "fit"), ("third.csv", "test"))
_FORM = 2  # changes when the logs would be other ones


@dataclass(frozen=True)
class Example:
    """A machine that is simulated.

    Args:
        model: class that lacks it.
        lacks: effect that the machine has -> parameter of it, and its value.
        command: of the machine.
        wave: of the command: middle, standard deviation, lowest and highest value, in its unit.
        seconds: of a log.
        noise: output -> standard deviation of its sensor, in its unit.
        other: parameters in which the machine differs from the model -> factor.
        file: with the model's library; "" for the library that comes along.
    """

    model: str
    lacks: tuple[str, str, float]
    command: str
    wave: tuple[float, float, float, float]
    seconds: float
    noise: Mapping[str, float]
    other: Mapping[str, float] = field(default_factory=dict)
    file: str = ""

    @property
    def libraries(self) -> tuple[Path, ...]:
        """That the model needs beside the one that comes along."""
        return (_HOME / self.file,) if self.file else ()


EXAMPLES = {
    "pump": Example(
        "HydraulicTestBench.Pump.FreeGreyBox", ("valve.deadband", "u_0", 0.02), "alphaCMD", (40, 12, 0, 80), 8.0,
        {"alphaPercent": 0.05, "u": 0.005}, {"K_p": 1.05, "A_p": 0.97},
    ),
    "drive": Example(
        "Drive.Axis", ("axis.friction", "F_c", 60.0), "x_ref", (0, 0.004, -0.02, 0.02), 6.0,
        {"x": 2e-6, "i": 0.01}, {"m": 1.08, "d": 0.8, "J": 1.03}, "Drive.mo",
    ),
    "heater": Example(
        "Heater.Block", ("heater.deadtime", "tau", 3.0), "P", (200, 120, 0, 600), 800.0,
        {"T_p": 0.05, "T_b": 0.05}, {"C_b": 1.1, "h": 0.9}, "Heater.mo",
    ),
}  # fmt: skip


def example(name: str) -> Any:
    """Three logs of a machine that has something its model lacks: "pump", "drive" or "heater".

    The logs are simulated, with noise, and the machine's parameters differ from the model's too; the first call makes
    them, in the cache. `EXAMPLES[name]` of this file says which model and which library belong to them.

    Raises:
        BadInput: there is no example of that name.
    """
    from pysim.nouns.data import load

    return load(example_folder(name))


def example_folder(name: str) -> Path:
    """The data set of an example; made where it is missing.

    Raises:
        BadInput: there is no example of that name.
    """
    from pysim.io import cache_folder, write_dataset

    if name not in EXAMPLES:
        raise BadInput(f"example: there is no {name!r}; write {' or '.join(EXAMPLES)}", argument="name")
    folder = cache_folder("examples") / f"{name}-{_FORM}"
    if not (folder / "dataset.toml").exists():
        shutil.rmtree(folder, ignore_errors=True)  # of a call that was stopped
        with TemporaryDirectory(dir=folder.parent) as beside:
            write_dataset(Path(beside) / name, logs(name))
            with suppress(OSError):  # another process was faster
                os.replace(Path(beside) / name, folder)
    return folder


def logs(name: str) -> Dataset:
    """The logs of an example: a random command from rest, and what follows."""
    from pysim.simulate import Rodas, simulate
    from pysim.workflow import Variants, inside, model_of, named, with_standard

    own = EXAMPLES[name]
    base, (effect, size, value) = model_of(own.model, own.libraries), own.lacks
    variants = Variants(own.model, tuple(with_standard(own.libraries)))
    machine, places = variants.build(named([effect], inside(base, own.libraries)))
    other = {name: factor * (base[name].start or 0.0) for name, factor in own.other.items()}
    other[f"{places[effect]}.{size}"] = value
    rng, records = np.random.default_rng(1), []
    times = np.linspace(0.0, own.seconds, _ROWS, endpoint=False)
    units = {name: base[name].unit for name in (own.command, *own.noise)}
    for source, use in _LOGS:
        command = _command(own, rng)
        drives = {own.command: command}
        run = Experiment(times, tuple(own.noise), drives, other, start=-1.0, rates=machine.rate_inputs(drives))
        clean = simulate(machine, run, solver=Rodas(rtol=1e-7, atol=1e-7))
        read = [clean[name] + sd * rng.standard_normal(times.size) for name, sd in own.noise.items()]
        values = np.column_stack([command.value(times), *read])
        log = Record(times, values, tuple(units), tuple(units.values()), origin="simulated, with noise")
        records.append(MeasuredRecord(source, "stochastic", use, log))
    signals = [MeasuredSignal(own.command, "input", units[own.command], base[own.command].description, own.command)]
    signals += [MeasuredSignal(n, "output", units[n], base[n].description, n, sd) for n, sd in own.noise.items()]
    return Dataset(f"{name}-example", "Simulated, with noise", name, tuple(signals), tuple(records))


def _command(own: Example, rng: np.random.Generator) -> Signal:
    """A smooth random wave from 0 at rest."""
    middle, sd, lowest, highest = own.wave
    knots = np.linspace(0.0, own.seconds * (1 + 1 / _KNOTS), _KNOTS + 2)
    values: NDArray[np.float64] = middle + sd * rng.standard_normal(knots.size)
    values[:2] = 0.0
    return Signal.through(knots, np.clip(values, lowest, highest))
