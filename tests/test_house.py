"""The structure of the source, read from its text: who imports whom, how large things are, and habits that erode.

`house.toml` beside this file holds the limits. A commit that raises one says why; most are what the code measured when
the limit was set, and are meant to fall. `python -m tests.test_house` prints the numbers of today.
"""

import ast
import re
import subprocess
import sys
import tomllib
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
HOUSE = tomllib.loads((Path(__file__).parent / "house.toml").read_text(encoding="utf-8"))
TOPS = ("fmu_build", "pysim", "validation")
SHORT = 4  # lines; a private function of that size with one use could stand where it is used
PROSE = {"about", "message", "notes", "reason", "text", "warnings"}  # fields of a result that hold sentences


@dataclass(frozen=True)
class Source:
    """One file.

    Args:
        path: below the root.
        text: its content.
        tree: what it parses to.
    """

    path: Path
    text: str
    tree: ast.Module

    @property
    def module(self) -> str:
        parts = self.path.with_suffix("").parts
        return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)

    @property
    def package(self) -> str:
        """`pysim.io` of pysim/io/records.py; the first word of all others, and of the files right below `pysim`."""
        parts = self.path.parts
        return package_of(".".join(parts)) if len(parts) > 2 else parts[0]

    @cached_property
    def nodes(self) -> list[ast.AST]:
        return list(ast.walk(self.tree))

    @property
    def classes(self) -> list[ast.ClassDef]:
        return [node for node in self.nodes if isinstance(node, ast.ClassDef)]

    @cached_property
    def imported(self) -> set[str]:
        return set(imported(self.nodes))


@pytest.fixture(scope="session", autouse=True)
def read() -> None:
    """Read the sources ahead of the tests."""
    sources()


@cache
def sources() -> tuple[Source, ...]:
    found = []
    for top in TOPS:
        for path in sorted((ROOT / top).rglob("*.py")):
            text = path.read_text(encoding="utf-8")
            found.append(Source(path.relative_to(ROOT), text, ast.parse(text)))
    return tuple(found)


def imported(nodes: Iterable[ast.AST]) -> Iterator[str]:
    """Full names that a source takes from elsewhere, wherever in it: `a.b.c` of `from a.b import c`."""
    for node in nodes:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are written by their full name"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def package_of(name: str) -> str:
    words = name.split(".")
    has_parts = words[0] == "pysim" or words[:2] in (
        ["fmu_build", leaf] for leaf in ("text", "version", "private_folder")
    )
    return ".".join(words[:2]) if has_parts and len(words) > 1 else words[0]


def foreign(source: Source) -> list[str]:
    """Packages that a file imports and its package may not."""
    allowed = HOUSE["imports"].get(source.package, [])
    found = {package_of(name) for name in source.imported} - {source.package}
    ours = {name for name in found if re.match(r"(pysim|fmu_build|validation|tests|run)\b", name)}
    wrong = ours - set(allowed) - set(HOUSE["files_that_may_import_more"].get(source.path.as_posix(), []))
    world = HOUSE["outside"].get(source.package)
    if world is not None:
        wrong |= {name for name in found - ours if name not in world and name not in sys.stdlib_module_names}
    return sorted(wrong)


def test_imports_point_one_way() -> None:
    wrong = {source.path.as_posix(): foreign(source) for source in sources()}
    assert {path: names for path, names in wrong.items() if names} == {}


@pytest.mark.parametrize(
    ("path", "text", "wrong"),
    [
        ("pysim/types/x.py", "import pysim.io.records", ["pysim.io"]),
        ("pysim/types/x.py", "import scipy.linalg", ["scipy"]),
        ("pysim/io/x.py", "from pysim import simulate", ["pysim.simulate"]),
        ("pysim/simulate/x.py", "def f():\n    from pysim.identify import g", ["pysim.identify"]),
        ("fmu_build/emit/x.py", "if True:\n    import pysim.types", ["pysim.types"]),
        ("fmu_build/emit/x.py", "from fmu_build.text import tokenise", []),
        ("fmu_build/text/x.py", "from fmu_build.errors import BuildError\nimport numpy", ["fmu_build", "numpy"]),
        ("pysim/io/x.py", "import fmu_build.text.tokens", ["fmu_build.text"]),
        ("pysim/effects/x.py", "import fmu_build.text.tokens, fmu_build.build", ["fmu_build"]),
        ("pysim/cli/x.py", "import pysim.workflow, pysim.identify, json", []),
    ],
)
def test_the_guard_of_imports_sees_what_it_is_to_see(path: str, text: str, wrong: list[str]) -> None:
    assert foreign(Source(Path(path), text, ast.parse(text))) == wrong


@cache
def edges() -> dict[str, set[str]]:
    """Module -> modules of ours that it imports, those that are imported for types alone or inside functions too."""
    modules = {source.module for source in sources()}
    found = {}
    for source in sources():
        found[source.module] = {n if n in modules else n.rpartition(".")[0] for n in source.imported} & modules
    return found


def circles(graph: dict[str, set[str]]) -> list[set[str]]:
    """Sets of modules that need each other (strongly connected, Tarjan 1972), of two or more."""
    index: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[set[str]] = []

    def visit(node: str) -> None:
        index[node] = low[node] = len(index)
        stack.append(node)
        for other in sorted(graph.get(node, ())):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            at = stack.index(node)
            if len(stack) - at > 1:
                found.append(set(stack[at:]))
            del stack[at:]

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return found


def test_no_files_import_each_other() -> None:
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"a", "d"}, "d": set()}) == [{"a", "b", "c"}]
    assert circles(edges()) == []


def c_includes() -> dict[str, set[str]]:
    """Part of the C runtime -> parts whose headers it includes; all of them share the type in instance.h."""
    folder = ROOT / "fmu_build" / "runtime" / "src"
    found: defaultdict[str, set[str]] = defaultdict(set)
    for path in [*folder.glob("*.c"), *folder.glob("*.h")]:
        found[path.stem] |= set(re.findall(r'#include "(\w+)\.h"', path.read_text(encoding="utf-8"))) - {
            path.stem,
            "instance",
        }
    return dict(found)


def test_no_parts_of_the_runtime_include_each_other() -> None:
    assert circles(c_includes()) == []


def files(package: list[Source]) -> int:
    return len(package)


def lines(package: list[Source]) -> int:
    return sum(source.text.count("\n") for source in package)


def named_numbers(package: list[Source]) -> int:
    """Names of a module or class that stand for a number; settings types and tables of units are the place for them."""
    home = {"settings.py", "units.py"}
    return sum(_numbers(source.tree) for source in package if source.path.name not in home)


def _numbers(tree: ast.AST) -> int:
    found = 0
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.ClassDef):
            found += _numbers(node)
        if isinstance(node, ast.Assign | ast.AnnAssign) and node.value is not None:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names = [n.id for target in targets for n in ast.walk(target) if isinstance(n, ast.Name)]
            if all(name.isupper() for name in names) and _is_number(node.value):
                found += len(names)
    return found


def _is_number(value: ast.expr) -> bool:
    constants = [node.value for node in ast.walk(value) if isinstance(node, ast.Constant)]
    plain = (ast.Constant, ast.UnaryOp, ast.BinOp, ast.Tuple, ast.operator, ast.unaryop, ast.Load)
    only = all(isinstance(node, plain) for node in ast.walk(value))
    return only and bool(constants) and all(isinstance(c, int | float) and not isinstance(c, bool) for c in constants)


def used_once(package: list[Source]) -> int:
    """Private functions of a few lines, used once."""
    found = 0
    for source in package:
        words = Counter(re.findall(r"\w+", source.text))
        for node in source.nodes:
            if isinstance(node, ast.FunctionDef) and node.name.startswith("_") and not node.name.startswith("__"):
                own = node.body[1:] if ast.get_docstring(node) else node.body
                size = (node.end_lineno or 0) - own[0].lineno + 1 if own else 0
                found += size <= SHORT and words[node.name] == 2
    return found


def single_importers(package: list[Source]) -> int:
    """Files that only one other file imports."""
    users = Counter(target for module, targets in edges().items() for target in targets if target != module)
    return sum(
        users[source.module] == 1 for source in package if source.path.name not in ("__init__.py", "__main__.py")
    )


def mutable(package: list[Source]) -> int:
    """Dataclasses whose fields may be set; progress, a job, a checkpoint may be such."""
    found = 0
    for source in package:
        for node in source.classes:
            marks = [ast.unparse(mark) for mark in node.decorator_list if "dataclass" in ast.unparse(mark)]
            found += any("frozen=True" not in mark for mark in marks)
    return found


def sentences(package: list[Source]) -> int:
    """Fields of dataclasses that hold free text for people, by their names."""
    found = 0
    for source in package:
        for node in source.classes:
            if any("dataclass" in ast.unparse(mark) for mark in node.decorator_list):
                fields = [
                    one for one in node.body if isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name)
                ]
                found += sum(
                    isinstance(one.target, ast.Name) and one.target.id in PROSE and "str" in ast.unparse(one.annotation)
                    for one in fields
                )
    return found


def undocumented(package: list[Source]) -> int:
    """Public functions and classes without a docstring, or whose docstring names an argument that is not there."""
    found = 0
    for source in package:
        for node in source.tree.body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
                text = ast.get_docstring(node)
                found += text is None or bool(_arguments_in(text) - _arguments_of(node))
    return found


def _arguments_in(docstring: str) -> set[str]:
    section = re.search(r"^Args:\n((?:    .*\n?|\n)+)", docstring, re.MULTILINE)
    rows = re.findall(r"^    (\w[\w, ]*):", section[1], re.MULTILINE) if section else []
    return {name.strip() for row in rows for name in row.split(",")}


def _arguments_of(node: ast.FunctionDef | ast.ClassDef) -> set[str]:
    if isinstance(node, ast.FunctionDef):
        a = node.args
        return {arg.arg for arg in [*a.posonlyargs, *a.args, *a.kwonlyargs, a.vararg, a.kwarg] if arg}
    fields = {one.target.id for one in node.body if isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name)}
    inits = [one for one in node.body if isinstance(one, ast.FunctionDef) and one.name == "__init__"]
    inherited = {"*"} if any(base for base in node.bases) else set()
    named = fields | {name for one in inits for name in _arguments_of(one)}
    return named if not inherited else _Anything(named)


class _Anything(set[str]):
    """What a class with a base may take besides its own fields is not known from its text."""

    def __rsub__(self, other: set[str]) -> set[str]:  # type: ignore[override]
        return set()


def kind_checks(package: list[Source]) -> int:
    """Questions which of the kinds of observation one is."""
    pattern = r"isinstance\([^)]*\b(TimeLog|TimeTarget|SineTarget|TableTarget|LogTarget|SteppedSines|ResponseTable)\b"
    return sum(len(re.findall(pattern, source.text)) for source in package)


def kind_spellings(package: list[Source]) -> int:
    """Files that spell a kind of record."""
    return sum('"frequency-response' in source.text for source in package)


RATCHETS: tuple[Callable[[list[Source]], int], ...] = (
    files,
    lines,
    named_numbers,
    used_once,
    single_importers,
    mutable,
    sentences,
    undocumented,
    kind_checks,
    kind_spellings,
)


def packages() -> dict[str, list[Source]]:
    found: defaultdict[str, list[Source]] = defaultdict(list)
    for source in sources():
        found[source.package].append(source)
    return dict(found)


@pytest.mark.parametrize("measure", RATCHETS, ids=lambda measure: measure.__name__)
def test_no_limit_of_the_house_is_passed(measure: Callable[[list[Source]], int]) -> None:
    limits = {name: HOUSE["limits"].get(name, {}).get(measure.__name__, 0) for name in packages()}
    now = {name: measure(package) for name, package in packages().items()}
    above = {name: f"{value}, limit {limits[name]}" for name, value in now.items() if value > limits[name]}
    assert above == {}


def test_the_measures_see_what_they_are_to_see() -> None:
    text = '''
from dataclasses import dataclass
LIMIT = 3.0
NAME, (A, B) = "x", (1, 2)
RATE: float = -1 / 2
@dataclass
class Answer:
    """What is said.

    Args:
        reason: why.
        other: not there.
    """
    reason: str
def _once(x):
    return x + 1
def public(x):
    return _once(x)
'''
    package = [Source(Path("pysim/x/y.py"), text, ast.parse(text))]
    measured = {measure.__name__: measure(package) for measure in RATCHETS if measure is not single_importers}
    assert measured == {
        "files": 1, "lines": 18, "named_numbers": 2, "used_once": 1, "mutable": 1, "sentences": 1, "undocumented": 2,
        "kind_checks": 0, "kind_spellings": 0,
    }  # fmt: skip


def test_every_setting_says_its_unit_its_meaning_and_its_source() -> None:
    """A call of `setting` gives all three, and a settings type has no field without it."""
    silent = []
    for source in sources():
        for node in source.classes:
            values = [one.value for one in node.body if isinstance(one, ast.AnnAssign)]
            calls = [v for v in values if isinstance(v, ast.Call) and ast.unparse(v.func) == "setting"]
            if calls:
                silent += [f"{source.path}: {node.name}"] * (len(calls) != len(values))
                silent += [f"{source.path}: {ast.unparse(call)}" for call in calls
                           if {key.arg for key in call.keywords} < {"unit", "meaning", "source"}]  # fmt: skip
    assert silent == []


def test_importing_pysim_loads_nothing_heavy() -> None:
    code = "import sys, pysim; print(*sorted({n.partition('.')[0] for n in sys.modules}))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT).stdout
    assert {"numba", "matplotlib", "scipy", "casadi", "nicegui"}.isdisjoint(loaded.split())


if __name__ == "__main__":
    for name, package in sorted(packages().items()):
        measured = {ratchet.__name__: ratchet(package) for ratchet in RATCHETS}
        print(f'"{name}" = {{ {", ".join(f"{key} = {value}" for key, value in measured.items() if value)} }}')
