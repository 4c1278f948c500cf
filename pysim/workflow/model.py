"""The model of a name: an FMU, or a Modelica class that is built first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
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
    platforms: Sequence[str] = ("host",),
    overrides: Mapping[str, float] | None = None,
) -> Model:
    """The model of a class, built into a file, or into the cache where none is named.

    Args:
        probes: variables that get a further input, as `fmu_build.build` says.
        platforms: that the FMU runs on, as `fmu_build.build` says.
        overrides: parameters that get another value, in SI units.
    Raises:
        BadInput: a class that does not compile; says where.
    """
    import fmu_build  # not needed for an FMU

    try:
        fmu = fmu_build.build(
            class_name, output, libraries=list(libraries), fmi=fmi, probes=probes, platforms=platforms,
            overrides=overrides or {},
        )  # fmt: skip
    except fmu_build.BuildError as error:
        raise BadInput(str(error)) from error
    return read_model(fmu)


def class_in(file: Path) -> str:
    """Name of the one model that a .mo file declares.

    Raises:
        BadInput: it cannot be read, or declares none or several at its top; lists what it holds.
    """
    names = _models_in(file)
    outer = [name for name in names if "." not in name]
    if len(outer) == 1:
        return outer[0]
    raise BadInput(f"{file} holds {', '.join(names) or 'no model'}; name one of them, and the file as its library")


def models_in(libraries: Sequence[Path]) -> tuple[str, ...]:
    """Full names of the models of libraries and files that can be read, those with slots first; effects are none."""
    found: list[str] = []
    for one in libraries:
        with suppress(BadInput):
            found += _models_in(one)
    return tuple(found)


def _models_in(library: Path) -> list[str]:
    from fmu_build.text import Libraries, TextError

    try:
        declared = [one for one in Libraries([library]).classes() if one.kind in ("model", "block", "class")]
    except TextError as error:
        raise BadInput(str(error)) from error
    whole = [one for one in declared if "partial" not in one.prefixes]
    whole = [one for one in whole if not any(token.text == "effect" for token in one.annotation)]
    return [one.full_name for one in sorted(whole, key=lambda one: "replaceable" not in one.words)]


@dataclass(frozen=True)
class ModelInside:
    """What the libraries know of a model.

    Args:
        class_name: of the model; "" where no library holds its class.
        slots: replaceable parts of the class.
        taken: effects that its slots take.
        catalogue: every effect of the libraries.
        is_thesis_pump: whether the class is the thesis' pump or extends it: limits of its Tables 1.3 and 1.4 hold.
    """

    class_name: str
    slots: tuple[Slot, ...]
    taken: tuple[Effect, ...]
    catalogue: tuple[Effect, ...]
    is_thesis_pump: bool = False

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
    from fmu_build.text import Libraries
    from pysim.effects import declares, fitting, read_catalogue, slots

    places = with_standard(libraries)
    catalogue = read_catalogue(*places)
    if not declares(model.name, places):
        return ModelInside("", (), (), catalogue)
    taken, library = fitting(catalogue, model.name, places), Libraries(places)
    names = [one.full_name for one in library.ancestry(library.find(model.name))]
    pump = any(name.startswith("HydraulicTestBench.Pump.") for name in names)
    return ModelInside(model.name, slots(model.name, places), taken, catalogue, pump)


def with_standard(libraries: Sequence[Path | str]) -> list[Path]:
    """The libraries, behind the one that comes along."""
    from pysim.effects import STANDARD_LIBRARY

    return [STANDARD_LIBRARY, *(Path(one) for one in libraries)]


def recorded_of(model: Model, names: Sequence[str] = ()) -> tuple[str, ...]:
    """What a run records: the variables asked for, else every output that is a number, else every state."""
    from pysim.simulate import is_number

    numbers = (variable for variable in model.variables if is_number(model.abilities.fmi, variable.type))
    outputs = tuple(variable.name for variable in numbers if variable.causality == "output")
    return tuple(names) or outputs or model.abilities.states
