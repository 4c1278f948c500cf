"""Small faults at seeded places: a sign, plus or minus one, a factor, a comparison, a dropped term."""

import ast
import random
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

# What only draws, words or serves is not asked for here: a changed margin of a picture is no wrong result.
PYTHON = {
    "pysim": (
        "bench",
        "control",
        "cosim",
        "diagnosis",
        "effects",
        "excitation",
        "identify",
        "io",
        "rig",
        "simulate",
        "types",
    ),
    "fmu_build": ("emit", "lower"),
}
SHARES = (("pysim", 10), ("fmu_build", 4), ("runtime", 3), ("modelica", 3))
_SWAPS = {ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*")}
# A comparison is turned round: whether an end belongs to a range shows only where a number hits it exactly.
_COMPARISONS = {
    ast.Lt: ("<", ">="),
    ast.LtE: ("<=", ">"),
    ast.Gt: (">", "<="),
    ast.GtE: (">=", "<"),
    ast.Eq: ("==", "!="),
}
_TEXT_SWAPS = {
    " + ": " - ",
    " - ": " + ",
    "*": "/",
    " < ": " >= ",
    " > ": " <= ",
    " <= ": " > ",
    " >= ": " < ",
    " == ": " != ",
}


@dataclass(frozen=True)
class Fault:
    """One change of one file.

    Args:
        path: below the root.
        start, end: the characters that are replaced.
        text: what replaces them.
        about: what was done, for the list of survivors.
        tests: that should notice it; those of its folder where none is named.
    """

    path: Path
    start: int
    end: int
    text: str
    about: str
    tests: tuple[str, ...] = ()


def faults(root: Path, seed: int) -> list[Fault]:
    """Twenty faults, each in a file and at a place drawn by the seed."""
    draw = random.Random(seed)
    found = []
    for group, number in SHARES:
        files = sorted(_files(root, group))
        while number:
            path = draw.choice(files)
            places = list(_places(root, path))
            if places:
                found.append(draw.choice(places))
                number -= 1
    return found


def _files(root: Path, group: str) -> Iterator[Path]:
    if group == "runtime":
        yield from (root / "fmu_build" / "runtime" / "src").glob("*.c")
    elif group == "modelica":
        library = root / "modelica" / "HydraulicTestBench"
        parts = ("Crane", "Effects", "Functions", "Hydraulics", "LoadCircuit", "Mechanics", "Pump")
        yield from (file for part in parts for file in (library / part).rglob("*.mo"))
    else:
        yield from (file for part in PYTHON[group] for file in (root / group / part).rglob("*.py"))


def _places(root: Path, path: Path) -> Iterator[Fault]:
    text = path.read_text(encoding="utf-8")
    name = path.relative_to(root)
    yield from _python(name, text) if path.suffix == ".py" else _plain(name, text)


def _python(name: Path, text: str) -> Iterator[Fault]:
    """Inside functions only: named numbers at the top are settings, whose every value is a legitimate program."""
    starts = [0]
    for line in text.encode().splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    data = text.encode()

    def span(node: ast.expr) -> tuple[int, int]:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        at = starts[node.lineno - 1] + node.col_offset, starts[node.end_lineno - 1] + node.end_col_offset
        return len(data[: at[0]].decode()), len(data[: at[1]].decode())

    def fault(start: int, end: int, new: str, what: str) -> Fault:
        line = text.count("\n", 0, start) + 1
        return Fault(name, start, end, new, f"{name}:{line}: {what}: {text.splitlines()[line - 1].strip()}")

    for node in _computed(ast.parse(text)):
        if isinstance(node, ast.BinOp) and type(node.op) in _SWAPS:
            old, new = _SWAPS[type(node.op)]
            left, right = span(node.left), span(node.right)
            at = text.find(old, left[1], right[0])
            if at >= 0:
                yield fault(at, at + len(old), new, f"{old} became {new}")
            if isinstance(node.op, ast.Add | ast.Sub):
                whole = span(node)
                yield fault(whole[0], whole[1], text[left[0] : left[1]], "a term was dropped")
        elif isinstance(node, ast.Compare) and type(node.ops[0]) in _COMPARISONS:
            old, new = _COMPARISONS[type(node.ops[0])]
            at = text.find(old, span(node.left)[1], span(node.comparators[0])[0])
            if at >= 0:
                yield fault(at, at + len(old), new, f"{old} became {new}")
        elif (
            isinstance(node, ast.UnaryOp)
            and isinstance(node.op, ast.USub)
            and not isinstance(node.operand, ast.Constant)
        ):
            whole = span(node)
            yield fault(whole[0], whole[0] + 1, "", "a sign was dropped")
        elif isinstance(node, ast.Constant) and isinstance(node.value, float) and node.value not in (0.0, 1.0):
            whole = span(node)
            yield fault(whole[0], whole[1], repr(node.value * 1.5), f"{node.value} became half as large again")


def _computed(tree: ast.AST, inside: bool = False) -> Iterator[ast.expr]:
    """Expressions of functions, without what is raised, annotated, or text."""
    for child in ast.iter_child_nodes(tree):
        if isinstance(child, ast.Raise | ast.JoinedStr | ast.Assert):
            continue
        if isinstance(child, ast.FunctionDef):
            for statement in child.body:
                yield from _computed(ast.Module([statement], []), True)
        elif isinstance(child, ast.AnnAssign):
            if child.value is not None:
                yield from _computed(ast.Expression(child.value), inside)
        else:
            if inside and isinstance(child, ast.expr):
                yield child
            yield from _computed(child, inside)


def _plain(name: Path, text: str) -> Iterator[Fault]:
    """C and Modelica, line by line: operators outside of comments, strings and annotations."""
    at = 0
    body = name.suffix == ".c"
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        word = line.split()[0] if line.split() else ""
        if name.suffix == ".mo":
            body = (body or word in ("equation", "algorithm")) and word != "annotation"
        code = re.sub(r'"(?:[^"\\]|\\.)*"|//.*|/\*.*?\*/', lambda m: " " * len(m[0]), line)
        comment = line.lstrip().startswith(("*", "/*", "#"))
        if body and not comment:
            for old, new in _TEXT_SWAPS.items():
                for match in re.finditer(re.escape(old), code):
                    if old == "*" and not re.match(
                        r"[\w)\]] ?\* ?[\w(]", code[max(match.start() - 1, 0) : match.end() + 1]
                    ):
                        continue  # a pointer
                    start = at + match.start()
                    about = f"{name}:{number}: {old.strip()} became {new.strip()}: {line.strip()}"
                    yield Fault(name, start, start + len(old), new, about)
        at += len(line)
