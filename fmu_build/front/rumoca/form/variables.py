"""rumoca's variables, with what only the flat form tells of them -> `FlatVariable`."""

from collections.abc import Mapping
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front.expression import Expression
from fmu_build.front.flat_model import FlatVariable, Role, Scalar, StateSelect
from fmu_build.front.rumoca.form.expressions import Arena
from fmu_build.front.rumoca.form.flat_form import FlatForm
from fmu_build.front.rumoca.form.places import Places

ROLES = {
    "constant": Role.CONSTANT,
    "parameter": Role.PARAMETER,
    "input": Role.INPUT,
    "state": Role.STATE,
    "algebraic": Role.ALGEBRAIC,
    "output": Role.ALGEBRAIC,
    "discrete_real": Role.DISCRETE,
    "discrete_value": Role.DISCRETE,
}


def convert_variable(
    form: Mapping[str, Any], storage: Mapping[str, Any], arena: Arena, flat: FlatForm, places: Places
) -> FlatVariable:
    name, attributes = form["name"], form["attributes"]
    span = places.span(form["declaration"])
    value_type = storage["value_types"][form["value_type"]]
    if form["role"] not in ROLES or value_type["scalar"] not in [scalar.value for scalar in Scalar]:
        what = f"{form['role']} of type {value_type['scalar']}"
        raise BuildError(f"{name} is a {what}, which is not supported", span.file, span.line)
    scalar = Scalar(value_type["scalar"])

    def expression(key: str) -> Expression | None:
        return None if attributes[key] is None else arena.expression(attributes[key])

    role = _role(form, flat)
    is_start_written = flat.attribute(name, "start") is not None
    if role is Role.PARAMETER:
        is_start_written = flat.is_start_written(name)
    return FlatVariable(
        name=name,
        scalar=scalar,
        dimensions=tuple(value_type["dimensions"]),
        role=role,
        span=span,
        is_input=attributes["causality"] == "input",
        is_output=attributes["causality"] == "output",
        is_tunable=attributes["is_tunable"],
        is_discrete=form["variability"] == "discrete",
        is_protected=bool(flat.attribute(name, "is_protected")),
        binding=expression("binding"),
        # rumoca invents a start of zero where the model is silent.
        start=expression("start") if is_start_written else None,
        fixed=None if attributes["fixed"] is None else tuple(attributes["fixed"]),
        min=expression("min"),
        max=expression("max"),
        nominal=expression("nominal"),
        unit=attributes["unit"],
        display_unit=flat.attribute(name, "display_unit"),
        quantity=flat.attribute(name, "quantity"),
        description=attributes["description"],
        state_select=StateSelect[attributes["state_select"].upper()],
        enumeration=flat.enumeration(name) if scalar is Scalar.ENUMERATION else (),
    )


def _role(form: Mapping[str, Any], flat: FlatForm) -> Role:
    """A parameter that the compiler has evaluated can no longer be set, nor can a final one."""
    role = ROLES[form["role"]]
    if role is Role.PARAMETER and (form["attributes"]["evaluable"] or flat.is_final(form["name"])):
        return Role.STRUCTURAL
    return role
