"""Front end: Modelica text -> FlatModel."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from fmu_build.errors import BuildError, WrongCall
from fmu_build.front.flat_model import Experiment, FlatModel, Role, Scalar
from fmu_build.front.rumoca import compiled
from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Modifier, modifiers
from fmu_build.text.expressions import literal
from fmu_build.text.lookup import Libraries
from fmu_build.text.tokens import TextError, Tokens, string_value

__all__ = ["FlatModel", "load"]

NO_OVERRIDES: Mapping[str, float | str] = {}


def load(class_name: str, libraries: Sequence[Path], overrides: Mapping[str, float | str] = NO_OVERRIDES) -> FlatModel:
    """Compile a Modelica class to one flat system of equations.

    Args:
        class_name: full name, such as `HydraulicTestBench.Examples.TimeResponse`.
        libraries: directories with a package.mo, or single .mo files.
        overrides: parameter values by name inside the class, in SI units; a text is taken as Modelica.
    Raises:
        BuildError: the class is unknown, wrong, unbalanced, or outside the supported subset (SUBSET.md).
    """
    with _as_build_errors():
        return _loaded(class_name, Libraries(libraries), overrides)


@contextmanager
def _as_build_errors() -> Iterator[None]:
    try:
        yield
    except TextError as failure:
        raise BuildError(failure.message, failure.file, failure.line) from failure


def _loaded(class_name: str, classes: Libraries, overrides: Mapping[str, float | str]) -> FlatModel:
    source = classes.find(class_name)
    _check_is_model(source)
    model = compiled(source, classes, overrides, experiment=_experiment(source), documentation=_documentation(source))
    _check_no_texts(model)
    return model


def _experiment(source: ClassText) -> Experiment:
    said, numbers = _annotated(source, "experiment"), dict[str, float]()
    for name, modifier in said.items():
        with suppress(ValueError):
            numbers[name] = literal(source.text(modifier.value))
    return Experiment(
        start=numbers.get("StartTime"),
        stop=numbers.get("StopTime"),
        tolerance=numbers.get("Tolerance"),
        interval=numbers.get("Interval"),
    )


def _documentation(source: ClassText) -> str:
    """HTML of the Documentation annotation, empty where there is none."""
    said = _annotated(source, "Documentation")
    return string_value(said["info"].value) if "info" in said else ""


def _annotated(source: ClassText, name: str) -> dict[str, Modifier]:
    said = modifiers(source.annotation)
    inside: Tokens = said[name].inside if name in said else ()
    return modifiers(inside)


_MODELS = ("model", "block", "class")


def _check_is_model(found: ClassText) -> None:
    what = "partial " if "partial" in found.prefixes else ""
    if what or found.kind not in _MODELS:
        inside = [
            one.full_name for one in found.classes.values() if one.kind in _MODELS and not one.prefixes & {"partial"}
        ]
        near = (
            f", such as {' or '.join(inside[-3:])}" if inside else ""
        )  # what others are made of comes first in a file
        message = f"{found.full_name} is a {what}{found.kind}; name a model or a block{near}"
        raise WrongCall(message, *found.place(found.start))


def _check_no_texts(model: FlatModel) -> None:
    for variable in model.variables:
        is_fixed = variable.role in (Role.CONSTANT, Role.STRUCTURAL, Role.PARAMETER)
        if variable.scalar is Scalar.STRING and not is_fixed:
            raise BuildError(
                f"{variable.name} is a String variable, which is not supported; make it a parameter or a constant",
                variable.span.file,
                variable.span.line,
            )
