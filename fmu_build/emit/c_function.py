"""One C function of the form `ModelFunction` (runtime/include/model.h) from CasADi expressions."""

import math
from collections.abc import Callable, Sequence

import casadi as ca

from fmu_build.emit.graph import SELECT, Graph, Node, expression_graph

# Members of `enum Argument`, in its order; the lower-case name is the local pointer in the C text.
ARGUMENTS = (
    *("T", "X", "U", "P", "C", "D", "R", "V", "Q", "I", "PRE_D", "PRE_B", "E"),
    *("SEED_X", "SEED_U", "SEED_P", "SEED_V", "SEED_Q"),
    *("WEIGHT_DX", "WEIGHT_W", "WEIGHT_G"),
)

_TEMPLATES = {
    ca.OP_ADD: "{0} + {1}",
    ca.OP_SUB: "{0} - {1}",
    ca.OP_MUL: "{0} * {1}",
    ca.OP_DIV: "{0} / {1}",
    ca.OP_NEG: "-{0}",
    ca.OP_SQ: "{0} * {0}",
    ca.OP_TWICE: "{0} + {0}",
    ca.OP_INV: "1.0 / {0}",
    ca.OP_LT: "{0} < {1}",
    ca.OP_LE: "{0} <= {1}",
    ca.OP_EQ: "{0} == {1}",
    ca.OP_NE: "{0} != {1}",
    ca.OP_NOT: "{0} == 0.0",
    ca.OP_AND: "{0} != 0.0 && {1} != 0.0",
    ca.OP_OR: "{0} != 0.0 || {1} != 0.0",
    ca.OP_IF_ELSE_ZERO: "{0} != 0.0 ? {1} : 0.0",
    SELECT: "{0} != 0.0 ? {1} : {2}",
    ca.OP_FMIN: "{0} < {1} ? {0} : {1}",
    ca.OP_FMAX: "{0} > {1} ? {0} : {1}",
    ca.OP_SIGN: "{0} > 0.0 ? 1.0 : {0} < 0.0 ? -1.0 : {0}",
    ca.OP_POW: "pow({0}, {1})",
    ca.OP_CONSTPOW: "pow({0}, {1})",
}
_TEMPLATES |= {
    getattr(ca, f"OP_{name.upper()}"): f"{name}({{0}})"
    for name in (
        *("exp", "expm1", "log", "log1p", "sqrt", "fabs", "floor", "ceil", "erf"),
        *("sin", "cos", "tan", "asin", "acos", "atan"),
        *("sinh", "cosh", "tanh", "asinh", "acosh", "atanh"),
    )
}
_TEMPLATES |= {
    getattr(ca, f"OP_{name.upper()}"): f"{name}({{0}}, {{1}})"
    for name in ("fmod", "remainder", "copysign", "atan2", "hypot")
}


def c_number(value: float) -> str:
    """A C literal that reads back as the very same double."""
    if math.isnan(value):
        return "NAN"
    if math.isinf(value):
        return "INFINITY" if value > 0 else "-INFINITY"
    return repr(float(value))


def c_function(name: str, arguments: Sequence[ca.SX], results: Sequence[ca.SX]) -> str:
    """A static C function `name`. Work that only one result needs is done only when that result is asked for.

    Args:
        arguments: one column vector of symbols per entry of `ARGUMENTS`, possibly empty.
        results: one expression per `res` pointer; written dense and column-major.
    """
    graph = expression_graph(arguments, results)
    users = graph.users()
    text = _reader(graph)
    lines = [f"static int {name}(const double **arg, double **res)", "{"]
    lines += _pointers(graph)
    lines += [f"    {line}" for line in _values(graph, text, [len(u) > 1 for u in users])]
    for k, elements in enumerate(graph.results):
        if not graph.sizes[k]:
            continue
        lines.append(f"    if (res[{k}]) {{")
        lines += [f"        {line}" for line in _values(graph, text, [u == {k} for u in users])]
        lines += [f"        {line}" for line in _stores(k, graph.sizes[k], elements, text)]
        lines.append("    }")
    return "\n".join([*lines, "    return 0;", "}", ""])


def _pointers(graph: Graph) -> list[str]:
    used = sorted({node.operands[0] for node in graph.nodes if node.operation == ca.OP_INPUT})
    lines = [f"    const double *const {ARGUMENTS[k].lower()} = arg[ARG_{ARGUMENTS[k]}];" for k in used]
    return lines or ["    (void)arg;"]


def _reader(graph: Graph) -> Callable[[int], str]:
    """How the C text refers to the value of a node: a literal, an array element or a local variable."""

    def text(k: int) -> str:
        node = graph.nodes[k]
        if node.operation == ca.OP_CONST:
            number = c_number(node.constant)
            return f"({number})" if number.startswith("-") else number
        return f"a{k}"

    return text


def _values(graph: Graph, text: Callable[[int], str], wanted: Sequence[bool]) -> list[str]:
    return [
        f"const double a{k} = {_formula(node, text)};"
        for k, node in enumerate(graph.nodes)
        if node.operation != ca.OP_CONST and wanted[k]
    ]


def _formula(node: Node, text: Callable[[int], str]) -> str:
    if node.operation == ca.OP_INPUT:
        argument, element = node.operands
        return f"{ARGUMENTS[argument].lower()}[{element}]"
    return _TEMPLATES[node.operation].format(*(text(k) for k in node.operands))


def _stores(result: int, size: int, elements: tuple[tuple[int, int], ...], text: Callable[[int], str]) -> list[str]:
    lines = [f"double *const out = res[{result}];"]
    if len(elements) < size:
        lines.append(f"memset(out, 0, {size} * sizeof *out);")
    return lines + [f"out[{position}] = {text(node)};" for position, node in elements]
