"""The model of a name: an FMU, or a Modelica class that is built first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.io import read_model
from pysim.types import BadInput, Effect, Model

if TYPE_CHECKING:
    from pysim.effects import Slot


def is_fmu(name: Path | str) -> bool:
    """Whether it names a file and no class."""
    return str(name).lower().endswith(".fmu") or Path(name).is_file()


def model_of(name: Path | str, libraries: Sequence[Path | str] = (), *, fmi: int = 2) -> Model:
    """The model of an FMU, or of a Modelica class once it is built.

    Args:
        name: path of an .fmu, or the full name of a class.
        libraries: of the user; the one that comes along is always there.
        fmi: version, 2 or 3, of what is built.
    Raises:
        BadInput: an FMU that cannot be read, or a class that does not compile.
    """
    return read_model(Path(name)) if is_fmu(name) else compiled(str(name), libraries, fmi=fmi)


def compiled(
    class_name: str,
    libraries: Sequence[Path | str],
    output: Path | None = None,
    *,
    fmi: int = 2,
    probes: Sequence[str] = (),
) -> Model:
    """The model of a class, built into a file, or into the cache where none is named.

    Args:
        probes: variables that get a further input, as `fmu_build.build` says.
    Raises:
        BadInput: a class that does not compile; says where.
    """
    import fmu_build  # not needed for an FMU

    try:
        return read_model(fmu_build.build(class_name, output, libraries=list(libraries), fmi=fmi, probes=probes))
    except fmu_build.BuildError as error:
        raise BadInput(str(error)) from error


@dataclass(frozen=True)
class ModelInside:
    """What the libraries know of a model.

    Args:
        class_name: of the model; "" where no library holds its class.
        slots: replaceable parts of the class.
        taken: effects that its slots take.
        catalogue: every effect of the libraries.
    """

    class_name: str
    slots: tuple[Slot, ...]
    taken: tuple[Effect, ...]
    catalogue: tuple[Effect, ...]

    @property
    def candidates(self) -> tuple[Effect, ...]:
        """Effects that its slots take; all of the catalogue where the class is not known."""
        return self.taken if self.class_name else self.catalogue


def inside(model: Model, libraries: Sequence[Path | str] = ()) -> ModelInside:
    """Look into a model whose class is in one of the libraries.

    Args:
        libraries: of the user; the one that comes along is always there.
    Raises:
        BadInput: a library that cannot be read.
    """
    from pysim.effects import declares, fitting, read_catalogue, slots

    places = with_standard(libraries)
    catalogue = read_catalogue(*places)
    if not declares(model.name, places):
        return ModelInside("", (), (), catalogue)
    taken = fitting(catalogue, model.name, places)
    return ModelInside(model.name, slots(model.name, places), taken, catalogue)


def with_standard(libraries: Sequence[Path | str]) -> list[Path]:
    """The libraries, behind the one that comes along."""
    from pysim.effects import STANDARD_LIBRARY

    return [STANDARD_LIBRARY, *(Path(one) for one in libraries)]
