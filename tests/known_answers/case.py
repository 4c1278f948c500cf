"""A case: what is in the plant, how it was logged, and what is right; read from a file of `cases/`."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.known_answers.plants import PLANTS, Command, Effects, Plant, Values, noise, simulate, stairs, wave

Array = NDArray[np.float64]

CASES = Path(__file__).parent / "cases"
_RATE = 50.0  # Hz
_UNSEEN = (901, 902)  # seeds of commands that are in no data set


@dataclass(frozen=True)
class Logs:
    """How the plant was tested.

    Args:
        fit, validate: seeds of the commands, a log each.
        stated: noise that the data set states, over what there is; 0 where it states none.
        memory: samples over which the noise is correlated; 0 for white noise.
        begins: s after rest at which each log begins; the command before is not logged.
        louder: noise over that of the plant's sensors.
        peak, band: of the commands, where not as the plant's.
        steps: whether the commands are stairs, not waves.
        length: s, of each log.
        seed: of the noise.
    """

    fit: tuple[int, ...] = (1, 2)
    validate: tuple[int, ...] = (3,)
    stated: float = 1.0
    memory: float = 0.0
    begins: float = 0.0
    louder: float = 1.0
    peak: float | None = None
    band: tuple[float, float] | None = None
    steps: bool = False
    length: float = 8.0
    seed: int = 0


@dataclass(frozen=True)
class Case:
    """One plant with its logs and its right answer.

    Args:
        name: of the file, group/name.
        about: in words.
        plant: of `PLANTS`.
        parameters: in force, where not those of the design.
        effects: in force, by name, with their parameters.
        logs: how it was tested.
        right: keys as the folder's README has them.
        failing: what today's code gets wrong -> why.
        today: what it answered, and its commit.
        slow: whether a faster test asks for the same.
    """

    name: str
    about: str
    plant: Plant
    parameters: Values
    effects: Effects
    logs: Logs
    right: Mapping[str, Any]
    failing: Mapping[str, str] = field(default_factory=dict)
    today: Mapping[str, Any] = field(default_factory=dict)
    slow: bool = False

    def command(self, seed: int) -> Command:
        """A command of this case."""
        peak = self.logs.peak or self.plant.peak
        return stairs(seed, peak) if self.logs.steps else wave(seed, peak, self.logs.band or self.plant.band)

    def logged(self, seed: int) -> tuple[Array, Array]:
        """A log with its noise: times (n_t,) in s, and the columns command and outputs (n_t, 1 + n_y)."""
        begins, command = self.logs.begins, self.command(seed)
        times = np.arange(round(self.logs.length * _RATE)) / _RATE
        read = simulate(self.plant, self.parameters, self.effects, command, begins + times)
        rng = np.random.default_rng((self.logs.seed, seed))
        for k, sensor in enumerate(self.plant.sensors.values()):
            read[:, k] += noise(times.size, self.logs.louder * sensor.noise, self.logs.memory, rng)
        given = np.array([command(t) for t in (begins + times).tolist()])
        return times, np.column_stack([given, read])

    def write(self, folder: Path) -> Path:
        """Write the data set, as `docs/reference/data_set.md` describes it."""
        folder.mkdir(parents=True, exist_ok=True)
        plant, lines = self.plant, ["[dataset]", f'name = "{self.name.rpartition("/")[2]}"', 'system = "plant"']
        lines += [f"[signals.{plant.command}]", 'role = "input"', f'unit = "{plant.unit}"']
        for name, sensor in plant.sensors.items():
            lines += [f"[signals.{name}]", 'role = "output"', f'unit = "{sensor.unit}"']
            if self.logs.stated:
                lines.append(f"noise = {self.logs.stated * self.logs.louder * sensor.noise!r}")
        names = ["time", plant.command, *plant.sensors]
        for use in ("fit", "validate"):
            for seed in getattr(self.logs, use):
                file = f"{use}-{seed}.txt"
                np.savetxt(folder / file, np.column_stack(self.logged(seed)), fmt="%.12g")
                lines += ["[[records]]", f'file = "{file}"', f"columns = {names}".replace("'", '"')]
                lines += ['kind = "stochastic"', f'use = "{use}"']
        (folder / "dataset.toml").write_text("\n".join([*lines, ""]), encoding="utf-8")
        return folder

    def unseen(self, parameters: Values, effects: Effects) -> float:
        """Error over noise to expect of a model on logs that begin at rest and are in no data set, 1 at best.

        Args:
            parameters, effects: of the model, in the plant's own equations.
        """
        parts, noises = [], np.array([self.logs.louder * s.noise for s in self.plant.sensors.values()])
        times = np.arange(round(self.logs.length * _RATE)) / _RATE
        for seed in _UNSEEN:
            truth, answer = (
                simulate(self.plant, *of, self.command(seed), times)
                for of in ((self.parameters, self.effects), (parameters, effects))
            )
            parts.append((truth - answer) / noises)
        return float(np.sqrt(1 + np.mean(np.square(parts))))

    def truth(self) -> dict[str, float]:
        """Every number that a diagnosis may estimate: by its own name, or that of its effect and its own."""
        own = {f"{name}.{p}": value for name, values in self.effects.items() for p, value in values.items()}
        return {**self.parameters, **own}


def read_case(path: Path) -> Case:
    """The case of a file."""
    given = tomllib.loads(path.read_text(encoding="utf-8"))
    logs = {name: tuple(v) if isinstance(v, list) else v for name, v in given.get("logs", {}).items()}
    truth = given["truth"]
    return Case(
        name=f"{path.parent.name}/{path.stem}",
        about=given["about"],
        plant=PLANTS[given["plant"]],
        parameters=truth["parameters"],
        effects=truth.get("effects", {}),
        logs=Logs(**logs),
        right=given["right"],
        failing=given.get("failing", {}),
        today=given.get("today", {}),
        slow=given.get("slow", False),
    )


def cases(group: str = "*") -> Iterator[Case]:
    """Those of a folder of `cases/`, or all, by name."""
    return map(read_case, sorted(CASES.glob(f"{group}/*.toml")))
