"""What of an FMU can be a port, which interfaces it offers, and what may be set."""

from __future__ import annotations

from pysim.simulate import check_override, is_number, value_objection
from pysim.types import BadInput, Model, Port, Variable

_INTERFACES = ("", "co-simulation", "model-exchange")


def fits(model: Model, variable: Variable) -> bool:
    """Whether it can be a port: a single number, no clock or text."""
    return is_number(model.abilities.fmi, variable.type)


def output_port(variable: Variable) -> Port:
    """An output, or a variable that is recorded as one."""
    return Port(variable.name, variable.unit, variable.start)


def recorded(model: Model, names: tuple[str, ...]) -> list[Variable]:
    """Variables that are no outputs yet.

    Raises:
        BadInput: an unknown name, or no single number.
    """
    for name in names:
        if not fits(model, model[name]):
            raise BadInput(f"{model.path.name}: {name} is {model[name].type} and cannot be recorded; record a number")
    return [model[name] for name in names if model[name].causality != "output"]


def check_value(model: Model, name: str, value: float) -> None:
    """Check that a parameter, start value or input can have a value.

    Raises:
        BadInput: it cannot.
    """
    variable = model[name]
    if variable.causality != "input":
        check_override(model, name, value)
    elif not fits(model, variable):
        raise BadInput(f"{model.path.name}: {name} is {variable.type}, no single number; leave it at its start")
    elif why := value_objection(variable, value):
        raise BadInput(f"{model.path.name}: {name} {why}")


def chosen_interface(name: str, model: Model, wanted: str) -> str:
    """The one wanted, or the first that the FMU offers.

    Raises:
        BadInput: there is none of that name, or the FMU does not offer it.
    """
    offered = [kind for kind, there in zip(_INTERFACES[1:], _offers(model), strict=True) if there]
    if wanted not in _INTERFACES:
        raise BadInput(f"{name}: interface {wanted!r} is not known; write one of {', '.join(offered)}")
    if wanted and wanted not in offered:
        raise BadInput(f"{name}: {model.path.name} does not offer {wanted}; it offers {', '.join(offered)}")
    return wanted or offered[0]


def _offers(model: Model) -> tuple[bool, bool]:
    return model.abilities.stepping is not None, model.abilities.model_exchange
