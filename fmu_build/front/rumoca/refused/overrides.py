"""Refuses values for parameters that do not exist: rumoca takes such a modification without a word."""

import difflib
from collections.abc import Mapping

from fmu_build.errors import WrongCall
from fmu_build.front.flat_model import FlatModel, Role
from fmu_build.text.classes import ClassText
from fmu_build.text.lookup import Libraries


def refuse_unknown_overrides(
    source: ClassText, classes: Libraries, model: FlatModel, overrides: Mapping[str, float | str]
) -> None:
    """Look for each name among the model's parameters.

    Raises:
        WrongCall: one is not there; names what is near.
    """
    parameters = {v.name for v in model.variables if v.role in (Role.PARAMETER, Role.STRUCTURAL)}
    for name in overrides:
        if name not in parameters:
            near = difflib.get_close_matches(name, sorted(parameters), n=3)
            hint = f"; near it: {', '.join(near)}" if near else ""
            message = f"{model.name} has no parameter {name} that could be set{hint}"
            raise WrongCall(message, model.span.file, model.span.line)
