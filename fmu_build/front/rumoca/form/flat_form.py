"""What only rumoca's flat form tells: attributes, when-chains, and the arguments of sample()."""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front.rumoca.form.places import Places, span_key

Place = tuple[int, int, int]
Arguments = tuple[ex.Expression, ex.Expression]  # start and interval

BINARY = {"Add": "add", "Sub": "subtract", "Mul": "multiply", "Div": "divide", "Exp": "power"}


@dataclass
class WhenBranch:
    """One `when` or `elsewhen`: what it sets, and the branch before it in its chain."""

    previous: int | None
    targets: set[str] = field(default_factory=set)
    states: set[str] = field(default_factory=set)


class FlatForm:
    """Questions to the flat form of one model."""

    def __init__(self, flat: Mapping[str, Any], places: Places) -> None:
        self._flat = flat
        self._places = places
        self.branches: list[WhenBranch] = []
        self._read_when_chains()
        self._samples = self._find_samples()

    def attribute(self, variable: str, name: str) -> Any:
        """An attribute of a variable as written, None where it is not."""
        return self._flat["variables"].get(variable, {}).get(name)

    def is_start_written(self, variable: str) -> bool:
        """rumoca gives a variable without a start one of zero, at the place of the declared name itself."""
        start = self.attribute(variable, "start")
        literal = start.get("Literal") if isinstance(start, dict) else None
        return start is not None and (literal is None or literal["span"] != self.attribute(variable, "source_span"))

    def is_final(self, variable: str) -> bool:
        return bool(self._flat["variable_final_flags"].get(variable, False))

    def enumeration(self, variable: str) -> tuple[str, ...]:
        """Literals of the variable's enumeration type, in order."""
        prefix = self._flat["variable_type_names"].get(variable, "") + "."
        ordinals = {
            name.removeprefix(prefix): number
            for name, number in self._flat["enum_literal_ordinals"].items()
            if name.startswith(prefix) and "'" not in name
        }
        return tuple(sorted(ordinals, key=lambda name: ordinals[name]))

    def next_sample(self, provenance: Mapping[str, Any]) -> ex.Sample:
        """The arguments of a sample() at this place; several instances of one class come in instance order."""
        found = self._samples.get(span_key(provenance))
        span = self._places.span(provenance)
        if not found:
            raise BuildError("this clock is not supported; use sample(start, interval)", span.file, span.line)
        start, interval = found.pop(0)
        return ex.Sample(span, start, interval)

    def _find_samples(self) -> dict[Place, list[Arguments]]:
        """Arguments by place, also where a condition names a variable that its equation makes a sample()."""
        samples = defaultdict(list)
        for form in ("equations", "structured_equations", "when_chains", "algorithms"):
            for node in walk(self._flat[form]):
                if node.get("function") == "Sample":
                    samples[span_key(node)].append(self._arguments(node))
        named = self._named_samples()
        for node in walk(self._flat["when_chains"]):
            reference = node.get("VarRef")
            if reference and reference["name"]["name"] in named:
                samples[span_key(reference)].append(named[reference["name"]["name"]])
        return dict(samples)

    def _named_samples(self) -> dict[str, Arguments]:
        """Variables given by `name = sample(...)`."""
        named = {}
        for equation in self._flat["equations"]:
            binary = equation["residual"].get("Binary", {})
            call = binary.get("rhs", {}).get("BuiltinCall", {})
            if binary.get("op") == "Sub" and "VarRef" in binary["lhs"] and call.get("function") == "Sample":
                named[binary["lhs"]["VarRef"]["name"]["name"]] = self._arguments(call)
        return named

    def _arguments(self, call: Mapping[str, Any]) -> Arguments:
        start, interval = (self._expression(argument) for argument in call["args"])
        return start, interval

    def _expression(self, node: Mapping[str, Any]) -> ex.Expression:
        ((kind, what),) = node.items()
        span = self._places.span(what)
        if kind == "Literal":
            return ex.Literal(span, next(iter(what["value"].values())))
        if kind == "VarRef" and not what["subscripts"]:
            return ex.Reference(span, what["name"]["name"])
        if kind == "Unary" and what["op"] == "Minus":
            return ex.Unary(span, "negate", self._expression(what["rhs"]))
        if kind == "Binary" and what["op"] in BINARY:
            return ex.Binary(span, BINARY[what["op"]], self._expression(what["lhs"]), self._expression(what["rhs"]))
        raise BuildError(f"'{kind}' is not supported in an argument of sample()", span.file, span.line)

    def _read_when_chains(self) -> None:
        for chain in self._flat["when_chains"]:
            self._read_chain([chain["first"], *chain.get("else_when", [])], "equations")
        for node in walk(self._flat["algorithms"]):
            if "When" in node:
                self._read_chain(node["When"]["blocks"], "stmts")

    def _read_chain(self, blocks: list[Mapping[str, Any]], body: str) -> None:
        previous = None
        for block in blocks:
            branch = WhenBranch(previous)
            for node in walk(block[body]):
                if "Assign" in node:
                    branch.targets.add(node["Assign"]["target"])
                if "Assignment" in node:
                    branch.targets.add(_component_name(node["Assignment"]["comp"]))
                if "Reinit" in node:
                    branch.states.add(node["Reinit"]["state"])
                for output in node.get("FunctionCallOutputs", {}).get("outputs", []):
                    branch.targets.add(output if isinstance(output, str) else output["name"])
            previous = len(self.branches)
            self.branches.append(branch)


def _component_name(component: Mapping[str, Any]) -> str:
    return ".".join(part["ident"] for part in component["parts"])


def walk(tree: Any) -> Iterator[Mapping[str, Any]]:
    """Every mapping inside, in written order."""
    waiting = [tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, dict):
            yield node
            waiting += reversed(node.values())
        elif isinstance(node, list):
            waiting += reversed(node)
