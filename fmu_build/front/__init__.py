"""Front end: Modelica text -> FlatModel."""

import difflib
from collections.abc import Mapping, Sequence
from pathlib import Path

from fmu_build.errors import BuildError, WrongCall
from fmu_build.front.class_lookup import ClassLookup, FoundClass
from fmu_build.front.flat_model import FlatModel, Role, Scalar
from fmu_build.front.lost_actions import refuse_lost_actions
from fmu_build.front.package_constants import refuse_mixed_constants
from fmu_build.front.redeclaration import refuse_lost_redeclarations
from fmu_build.front.session import compile_class
from fmu_build.front.source import find_class

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
    from fmu_build.front.rumoca_form import to_flat_model

    paths = [Path(library) for library in libraries]
    source = find_class(class_name, paths)
    classes = ClassLookup(paths)
    written = classes.full(class_name)
    if written is not None:
        _check_is_model(written)
        refuse_lost_redeclarations(written, classes)
        refuse_mixed_constants(written, classes)
    dae, flat = compile_class(source, paths, overrides)
    model = to_flat_model(
        dae,
        flat,
        name=class_name,
        span=source.span,
        experiment=source.experiment,
        documentation=source.documentation,
        description=source.description,
    )
    _check_overrides(model, overrides)
    if written is not None:
        refuse_lost_actions(written, classes, model)
    _check_no_texts(model)
    return model


def _check_is_model(found: FoundClass) -> None:
    written = found.text
    what = "partial " if "partial" in written.prefixes else ""
    if what or written.kind not in ("model", "block", "class"):
        wrong = found.error(f"{found.full_name} is a {what}{written.kind}; name a model or a block", written.offset)
        raise WrongCall(wrong.message, wrong.file, wrong.line)


def _check_overrides(model: FlatModel, overrides: Mapping[str, float | str]) -> None:
    """rumoca takes a modification of what does not exist without a word."""
    parameters = {v.name for v in model.variables if v.role in (Role.PARAMETER, Role.STRUCTURAL)}
    for name in overrides:
        if name not in parameters:
            near = difflib.get_close_matches(name, sorted(parameters), n=3)
            hint = f"; near it: {', '.join(near)}" if near else ""
            raise WrongCall(
                f"{model.name} has no parameter {name} that could be set{hint}", model.span.file, model.span.line
            )


def _check_no_texts(model: FlatModel) -> None:
    for variable in model.variables:
        is_fixed = variable.role in (Role.CONSTANT, Role.STRUCTURAL, Role.PARAMETER)
        if variable.scalar is Scalar.STRING and not is_fixed:
            raise BuildError(
                f"{variable.name} is a String variable, which is not supported; make it a parameter or a constant",
                variable.span.file,
                variable.span.line,
            )
