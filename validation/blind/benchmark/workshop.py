"""The pump with any effects of the catalogue, compiled once."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import fmu_build
from pysim.effects import STANDARD_LIBRARY, fitting, read_catalogue, variant
from pysim.io import read_model
from pysim.types import BadInput, Effect, Model

BASE = "HydraulicTestBench.Pump.FreeGreyBox"


@dataclass
class Workshop:
    """Base model, catalogue, and what was compiled so far.

    Args:
        model: the base model.
        catalogue: every effect of the library that the pump's slots take.
        wall, cpu: s spent on compiling, of the clock and of this process.
    """

    model: Model
    catalogue: tuple[Effect, ...]
    wall: float = 0.0
    cpu: float = 0.0
    _built: dict[tuple[str, ...], tuple[Model, Mapping[str, str]]] = field(default_factory=dict)

    def variant(self, effects: Sequence[Effect]) -> tuple[Model, Mapping[str, str]]:
        """The model with these effects, and effect name -> the name ahead of its parameters there.

        Raises:
            BadInput: effects that cannot be put together, or do not compile.
        """
        key = tuple(effect.name for effect in effects)
        if key not in self._built:
            begun = time.monotonic(), time.process_time()
            try:
                self._built[key] = _compiled(effects)
            finally:
                self.wall += time.monotonic() - begun[0]
                self.cpu += time.process_time() - begun[1]
        return self._built[key]

    def effect(self, name: str) -> Effect:
        """Of that standard name."""
        return next(effect for effect in self.catalogue if effect.name == name)


def _compiled(effects: Sequence[Effect]) -> tuple[Model, Mapping[str, str]]:
    made = variant(BASE, effects, [STANDARD_LIBRARY])
    with tempfile.TemporaryDirectory(prefix="blind-benchmark-") as folder:
        source = Path(folder) / f"{made.class_name}.mo"
        source.write_text(made.text, encoding="utf-8")
        try:
            return read_model(fmu_build.build(made.class_name, libraries=[STANDARD_LIBRARY, source])), made.places
        except fmu_build.BuildError as error:
            raise BadInput(str(error)) from error


@cache
def workshop() -> Workshop:
    """Of this process."""
    catalogue = fitting(read_catalogue(STANDARD_LIBRARY), BASE, [STANDARD_LIBRARY])
    return Workshop(read_model(fmu_build.build(BASE, libraries=[STANDARD_LIBRARY])), catalogue)
