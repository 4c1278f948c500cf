"""rumoca's function bodies -> `Function`."""

from collections.abc import Mapping
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front.flat_model import Assignment, ForStatement, Function
from fmu_build.front.rumoca.form.expressions import Arena
from fmu_build.front.rumoca.form.places import Places


def convert_function(form: Mapping[str, Any], storage: Mapping[str, Any], arena: Arena, places: Places) -> Function:
    span = places.span(form["declaration"])
    if form["external"] is not None:
        raise BuildError(f"function {form['name']} is external; write it in Modelica", span.file, span.line)
    types = storage["value_types"]
    local = (*form["outputs"], *form["locals"])
    return Function(
        form["name"],
        len(form["parameters"]),
        len(form["outputs"]),
        tuple(tuple(types[variable["value_type"]]["dimensions"]) for variable in local),
        tuple(_statement(statement, arena, places) for statement in form["statements"]),
        span,
    )


def _statement(form: Mapping[str, Any], arena: Arena, places: Places) -> Assignment | ForStatement:
    ((kind, what),) = form.items()
    if kind == "assignment":
        value = arena.expression(what["rhs"])
        return Assignment((what["target"],), (value,), value.span)
    if kind == "assignment_group":
        values = tuple(arena.expression(item["rhs"]) for item in what["assignments"])
        return Assignment(tuple(item["target"] for item in what["assignments"]), values, values[0].span)
    if kind == "for":
        span = places.span(what["begin_provenance"])
        if what["iteration_locals"]:
            raise BuildError("a variable local to one loop iteration is not supported", span.file, span.line)
        statements = tuple(_statement(item, arena, places) for item in what["statements"])
        return ForStatement(what["domain"], tuple(what["targets"]), statements, span)
    provenance = what.get("provenance") if isinstance(what, Mapping) else None
    span = places.span(provenance)
    message = f"statement of kind '{kind}' in a function is not supported"
    if kind == "assertion" and provenance and provenance["origin"] == "source":
        message = "assert in a function is not supported; take it out, or assert in the model that calls the function"
    elif kind == "assertion":  # made up by rumoca
        message = "this function may end without a value of a result; give it one on every path, as before the if"
    raise BuildError(message, span.file, span.line)
