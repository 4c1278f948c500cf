"""The pump with any effects, compiled once and kept in a folder of the benchmark's own.

The compiler's cache lets go of what was not asked for lately, and a run meets more models than it keeps.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
import time
import uuid
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import fmu_build
from pysim.diagnose.locating.laws import Term, wrapped
from pysim.effects import STANDARD_LIBRARY, fitting, read_catalogue, variant
from pysim.io import cache_folder, read_model
from pysim.types import BadInput, Effect, Model
from validation.blind.benchmark.fingerprint import model_fingerprint

BASE = "HydraulicTestBench.Pump.FreeGreyBox"


@dataclass
class Workshop:
    """Base model, catalogue, and what was compiled so far.

    Args:
        model: the base model.
        catalogue: every effect of the library that the pump's slots take.
        folder: of compiled models.
        seconds: spent on compiling.
    """

    model: Model
    catalogue: tuple[Effect, ...]
    folder: Path
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

    def probed(self, effects: Sequence[Effect], law: Term) -> Model:
        """The base model with a term at one of its places.

        Raises:
            BadInput: effects beside it, or a term that does not compile.
        """
        if effects:
            raise BadInput("terms are looked for in the base model alone; leave the effects out")
        text = wrapped(BASE, law, "Located")
        path = self.folder / f"term-{hashlib.sha256(f'{text} {law.probes}'.encode()).hexdigest()[:12]}.fmu"
        if not path.is_file():
            begun = time.monotonic()
            with tempfile.TemporaryDirectory(prefix="blind-benchmark-") as folder:
                source = Path(folder) / "Located.mo"
                source.write_text(text, encoding="utf-8")
                _build("Located", path, [STANDARD_LIBRARY, source], law.probes)
            self.seconds += time.monotonic() - begun
        return read_model(path)

    def effect(self, name: str) -> Effect:
        """Of that standard name."""
        return next(effect for effect in self.catalogue if effect.name == name)

    def _compiled(self, effects: Sequence[Effect]) -> tuple[Model, Mapping[str, str]]:
        made = variant(BASE, effects, [STANDARD_LIBRARY])
        path = self.folder / f"{'+'.join(effect.name for effect in effects)}.fmu"
        if not path.is_file():
            with tempfile.TemporaryDirectory(prefix="blind-benchmark-") as folder:
                source = Path(folder) / f"{made.class_name}.mo"
                source.write_text(made.text, encoding="utf-8")
                _build(made.class_name, path, [STANDARD_LIBRARY, source])
        return read_model(path), made.places


def _build(class_name: str, path: Path, libraries: Sequence[Path], probes: Sequence[str] = ()) -> None:
    """Compile to that path, whole or not at all."""
    partial = path.with_name(f"{uuid.uuid4().hex}.fmu")
    try:
        fmu_build.build(class_name, partial, libraries=libraries, probes=probes)
        os.replace(partial, path)
    except fmu_build.BuildError as error:
        raise BadInput(str(error)) from error
    finally:
        partial.unlink(missing_ok=True)


@cache
def workshop() -> Workshop:
    """Of this process."""
    folder = cache_folder("blind-benchmark") / model_fingerprint()
    folder.mkdir(parents=True, exist_ok=True)
    base = folder / "base.fmu"
    if not base.is_file():
        _build(BASE, base, [STANDARD_LIBRARY])
    catalogue = fitting(read_catalogue(STANDARD_LIBRARY), BASE, [STANDARD_LIBRARY])
    return Workshop(read_model(base), catalogue, folder)
