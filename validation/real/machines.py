"""The five machines: where their logs are, their base models with slots, and the effects that might be missing."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

from pysim.io import read_dataset
from pysim.types import Dataset, Effect
from validation.asked import Subject

ENVIRONMENT = "REAL_MEASUREMENTS"
"""Names the folder that holds the logs; they are not part of this distribution."""
_HERE = Path(__file__).parent


@dataclass(frozen=True)
class Machine:
    """One machine.

    Args:
        name: folder of its logs, behind "real-".
        class_name: of the base model, in a library of that name.
        free: its parameters, which nobody knows exactly.
        shown: a state that the logged signal shows, and the state that is its derivative, where the model has two such.
    """

    name: str
    class_name: str
    free: tuple[str, ...]
    shown: tuple[str, str] | None = None

    @property
    def folder(self) -> Path:
        """Of its Modelica library and its description of the logs."""
        return _HERE / self.name.replace("-", "_")

    @property
    def library(self) -> Path:
        """Base model, slots and effects."""
        return self.folder / f"{self.class_name.partition('.')[0]}.mo"

    @cached_property
    def subject(self) -> Subject:
        """The base model, and what may be missing."""
        return Subject(self.class_name, (self.library,))

    def effects(self, names: Sequence[str]) -> tuple[Effect, ...]:
        """Of these names, in their order."""
        known = {effect.name: effect for effect in self.subject.catalogue}
        return tuple(known[name] for name in names)

    def measurements(self, root: Path, held_out: str = "test") -> Dataset:
        """Its logs by our own description, which says how inputs are held and how the plant stood at their first row.

        Args:
            root: holds the folders of logs.
            held_out: use of those that are not fitted: "test" withholds them from whoever chooses a model.
        Raises:
            BadInput: a log that is not there or cannot be read.
        """
        with tempfile.TemporaryDirectory(prefix="real-") as text:
            folder = Path(text) / self.name
            shutil.copytree(root / f"real-{self.name}", folder, copy_function=shutil.copyfile)
            shutil.copyfile(self.folder / "dataset.toml", folder / "own.toml")
            dataset = read_dataset(folder / "own.toml")
        records = (r if r.use == "fit" else replace(r, use=held_out) for r in dataset.records)
        return replace(dataset, records=tuple(records))


MACHINES: Mapping[str, Machine] = MappingProxyType(
    {
        machine.name: machine
        for machine in (
            Machine("pendulum", "Pendulum.Arm", ("omega2", "c"), ("theta", "w")),
            Machine("coupled-drives", "CoupledDrives.Drives", ("K", "w_0", "zeta", "a", "z_0")),
            Machine("motor-generator", "MotorGenerator.Motor", ("K", "T", "T_f", "n_0")),
            Machine("hair-dryer", "HairDryer.Dryer", ("K", "T", "y_0")),
            Machine("hydraulic-actuator", "HydraulicActuator.Actuator", ("k_q", "a", "c_b", "d", "w2", "u_n")),
        )
    }
)


def measured_folder(root: Path | None = None) -> Path | None:
    """Where the logs are: the folder given, or the one that the environment names; None where there is none."""
    named = root or Path(os.environ.get(ENVIRONMENT, ""))
    found = named != Path() and all((named / f"real-{name}").is_dir() for name in MACHINES)
    return named if found else None
