"""The pump with any effects, compiled once per process."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import fmu_build
from pysim.effects import STANDARD_LIBRARY, read_catalogue, variant
from pysim.io import read_model
from pysim.types import BadInput, Effect, Model

BASE = "HydraulicTestBench.Pump.FreeGreyBox"


@dataclass
class Workshop:
    """Base model, catalogue, and what was compiled so far.

    Args:
        model: the base model.
        catalogue: every effect of the library.
        seconds: spent on compiling.
    """

    model: Model
    catalogue: tuple[Effect, ...]
    seconds: float = 0.0
    _built: dict[tuple[str, ...], tuple[Model, Mapping[str, str]]] = field(default_factory=dict)

    def variant(self, effects: Sequence[Effect]) -> tuple[Model, Mapping[str, str]]:
        """The model with these effects, and effect name -> the name ahead of its parameters there.

        Raises:
            BadInput: effects that cannot be put together, or do not compile.
        """
        key = tuple(effect.name for effect in effects)
        if key not in self._built:
            begun = time.monotonic()
            try:
                self._built[key] = self._compiled(effects)
            finally:
                self.seconds += time.monotonic() - begun
        return self._built[key]

    def effect(self, name: str) -> Effect:
        """Of that standard name."""
        return next(effect for effect in self.catalogue if effect.name == name)

    def _compiled(self, effects: Sequence[Effect]) -> tuple[Model, Mapping[str, str]]:
        made = variant(BASE, effects, [STANDARD_LIBRARY])
        with tempfile.TemporaryDirectory(prefix="blind-benchmark-") as folder:
            source = Path(folder) / f"{made.class_name}.mo"
            source.write_text(made.text, encoding="utf-8")
            try:
                path = fmu_build.build(made.class_name, libraries=[STANDARD_LIBRARY, source])
            except fmu_build.BuildError as error:
                raise BadInput(str(error)) from error
        return read_model(path), made.places


@cache
def workshop() -> Workshop:
    """Of this process."""
    return Workshop(read_model(fmu_build.build(BASE)), tuple(read_catalogue(STANDARD_LIBRARY)))
