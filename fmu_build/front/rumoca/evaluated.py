"""Parameters whose values rumoca 0.10.2 has put into the equations without saying so: they can no longer be set.

These are the ones in ranges and sizes, also inside of functions, as indices of parts, in `connect`, and in the
conditions around it.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from fmu_build.front.expression import references
from fmu_build.front.flat_model import FlatModel, Role
from fmu_build.front.rumoca.form.flat_form import walk
from fmu_build.front.rumoca.refused.actions import variables_meant
from fmu_build.front.rumoca.refused.redeclarations import MODIFIABLE
from fmu_build.text.classes import ClassText
from fmu_build.text.lookup import Libraries
from fmu_build.text.statements import Statement, statements
from fmu_build.text.tokens import Tokens, behind_brackets, bracket, depth_change, dotted_name, is_name, tokenise

_EXPRESSIONS = (
    "equations", "structured_equations", "assert_equations", "initial_equations", "initial_structured_equations",
    "initial_assert_equations", "algorithms", "initial_algorithms", "when_chains",
)  # fmt: skip
_SIZES_BEHIND = {"Zeros": 0, "Ones": 0, "Identity": 0, "Fill": 1, "Linspace": 2}  # arguments ahead of the sizes

_Inputs = Mapping[str, set[int]]  # of functions, those that are in ranges and sizes


def with_evaluated(
    model: FlatModel, dae: Mapping[str, Any], flat: Mapping[str, Any], source: ClassText, classes: Libraries
) -> FlatModel:
    """The model in which these parameters, and those that they follow from, are structural.

    Args:
        dae, flat: rumoca's forms, which have ranges and sizes, or the place where they are written.
        source: what indices of parts and conditions are read from, with all classes that make it up.
    """
    named = {one.name: one for one in model.variables}
    waiting = [*_in_flat_form(flat), *_written_out(dae, flat), *_in_text(source, classes, model)]
    found = set[str]()
    while waiting:
        name = waiting.pop()
        if name not in found and name in named:
            found.add(name)
            binding = named[name].binding
            waiting += [] if binding is None else references(binding)
    return replace(
        model,
        variables=tuple(
            replace(one, role=Role.STRUCTURAL) if one.name in found and one.role is Role.PARAMETER else one
            for one in model.variables
        ),
    )


def _in_flat_form(flat: Mapping[str, Any]) -> Iterator[str]:
    functions: Mapping[str, Any] = flat["functions"]
    inputs: _Inputs = {}
    before: _Inputs | None = None
    while inputs != before:  # a function may hand its input to another one
        before, inputs = inputs, {name: _inputs(function, inputs) for name, function in functions.items()}
    return _in_ranges([list(flat["variables"].values()), *(flat[form] for form in _EXPRESSIONS)], inputs)


def _inputs(function: Mapping[str, Any], inputs: _Inputs) -> set[int]:
    names = set(_in_ranges(function, inputs))
    return {k for k, one in enumerate(function["inputs"]) if one["name"] in names}


def _in_ranges(tree: Any, inputs: _Inputs) -> Iterator[str]:
    for node in walk(tree):
        yield from _names([node.get("Range"), node.get("shape_expr")])
        call = node.get("BuiltinCall", {})
        if call.get("function") in _SIZES_BEHIND:
            yield from _names(call["args"][_SIZES_BEHIND[call["function"]] :])
        if "FunctionCall" in node:
            call = node["FunctionCall"]
            used = inputs.get((call.get("name") or call["comp"])["name"], set())
            yield from _names([argument for k, argument in enumerate(call["args"]) if k in used])


def _names(tree: Any) -> list[str]:
    """The names of variables inside, but for those of which only the size counts."""
    if isinstance(tree, list):
        return [name for part in tree for name in _names(part)]
    if not isinstance(tree, dict) or tree.get("function") == "Size":
        return []
    own = [tree["VarRef"]["name"]["name"]] if "VarRef" in tree else []
    return own + _names(list(tree.values()))


def _written_out(dae: Mapping[str, Any], flat: Mapping[str, Any]) -> Iterator[str]:
    """Of `{... for i in 1:n}` in equations, of which the flat form has the elements and the place alone."""
    texts = {number: text.encode() for number, _, text in dae["source_map"]["files"]}
    for equation in [*flat["equations"], *flat["initial_equations"]]:
        component = equation["origin"].get("ComponentEquation", {}).get("component")
        for node in walk(equation["residual"]):
            place = node["Array"]["span"] if "Array" in node else {"source": None}
            tokens = tokenise(texts.get(place["source"], b"")[place.get("start") : place.get("end")].decode())
            for at, token in enumerate(tokens):
                names = _written_names(_range(tokens[at + 1 :])) if token.text == "in" else ()
                yield from (f"{component}.{name}" if component else name for name in names)


def _in_text(source: ClassText, classes: Libraries, model: FlatModel) -> Iterator[str]:
    for here in classes.used(source):
        for name in {name for tokens in _evaluated(here, classes) for name in _written_names(tokens)}:
            yield from (variable.name for variable in variables_meant(name, here, classes, model))


def _evaluated(here: ClassText, classes: Libraries) -> Iterator[Tokens]:
    tokens = here.own_tokens
    for at, token in enumerate(tokens):
        if token.text == "[" and is_name(tokens[at - 1].text):
            behind = behind_brackets(tokens, at)
            is_inside = [one.text for one in tokens[behind : behind + 1]] == ["."]
            yield tokens[at:behind] if is_inside or _is_part(tokens[at - 1].text, here, classes) else ()
    for statement in statements(tokens):
        yield from _around_connections(statement, is_looped=False)


def _is_part(name: str, here: ClassText, classes: Libraries) -> bool:
    declared = (classes.resolve(element.class_name, owner) for owner, element in classes.elements(name, here))
    return any(one is not None and one.kind in MODIFIABLE for one in declared)


def _around_connections(statement: Statement, *, is_looped: bool) -> Iterator[Tokens]:
    """Indices in `connect`, and conditions around it; in a loop also conditions around the derivative of a scalar."""
    words = {token.text for token in statement.tokens}
    if statement.word == "connect":
        yield from (bracket(statement.tokens, at, "[") for at in range(len(statement.tokens)))
    elif "connect" in words or (statement.word == "if" and is_looped and "der" in words):
        yield from statement.conditions
    for branch in statement.branches:
        for inner in branch:
            yield from _around_connections(inner, is_looped=is_looped or statement.word == "for")


def _range(tokens: Tokens) -> Tokens:
    """The range that tokens begin with."""
    depth = 0
    for at, token in enumerate(tokens):
        depth += depth_change(token)
        if depth < 0 or (depth == 0 and token.text == ","):
            return tokens[:at]
    return tokens


def _written_names(tokens: Tokens) -> Iterator[str]:
    """As `_names`."""
    at = 0
    while at < len(tokens):
        name, behind = dotted_name(tokens, at)
        yield name
        at = behind_brackets(tokens, behind) if name == "size" else max(behind, at + 1)
