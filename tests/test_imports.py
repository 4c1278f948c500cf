"""Who may import whom: packages form layers, and `fmu_build` meets `pysim` at the .fmu file only. Read from source."""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

# What each package of ours may import besides itself.
_DATA = {"pysim.types"}
_FILES = _DATA | {"pysim.io"}
_RUNS = _FILES | {"pysim.simulate"}
_FITS = _RUNS | {"pysim.excitation", "pysim.identify"}
ALLOWED = {
    "pysim.types": set(),
    "pysim.control": _DATA,
    "pysim.effects": _DATA,
    "pysim.excitation": _DATA,
    "pysim.io": _DATA,
    "pysim.fmu_check": _FILES,
    "pysim.simulate": _FILES,
    "pysim.bench": _RUNS | {"pysim.excitation"},
    "pysim.cosim": _RUNS | {"pysim.control"},
    "pysim.identify": _RUNS | {"pysim.excitation"},
    "pysim.diagnose": _FITS | {"pysim.effects"},
    "pysim.rig": _RUNS | {"pysim.control", "pysim.cosim", "pysim.excitation"},
    "pysim.plot": _FITS | {"pysim.control", "pysim.rig"},
    "pysim.report": _FITS | {"pysim.control", "pysim.fmu_check", "pysim.rig"},
    "pysim.app": _FILES | {"pysim.identify"},
    "pysim.cli": _FITS
    | {
        "pysim.app",
        "pysim.bench",
        "pysim.control",
        "pysim.cosim",
        "pysim.effects",
        "pysim.diagnose",
        "pysim.fmu_check",
        "pysim.plot",
        "pysim.report",
        "pysim.rig",
        "fmu_build",
        "validation",
    },
    "validation": _FITS
    | {"pysim.bench", "pysim.control", "pysim.cosim", "pysim.effects", "pysim.diagnose", "pysim.plot", "pysim.report"}
    | {"pysim.fmu_check", "pysim.rig", "fmu_build"},
    "fmu_build": set(),
}
# Packages whose outside world is limited too.
OUTSIDE = {"pysim.types": {"numpy"}, "pysim.excitation": {"numpy"}, "pysim.io": {"numpy", "fmpy", "platformdirs"}}
MAIN = {Path("pysim/__main__.py"): {"pysim.cli"}, Path("validation/__main__.py"): {"pysim.cli"}}


def package(module: str) -> str:
    """`pysim.io` of `pysim.io.records`; the first word of all others."""
    words = module.split(".")
    return ".".join(words[: 2 if words[0] == "pysim" else 1])


def sources() -> list[Path]:
    folders = (ROOT / name for name in ("pysim", "fmu_build", "validation"))
    return sorted(path.relative_to(ROOT) for folder in folders for path in folder.rglob("*.py"))


def imports(source: str) -> Iterator[str]:
    """Every module a source names, at its top and inside functions; names taken from `pysim` count as its packages."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "imports are written by their full name"
            yield from ([f"pysim.{a.name}" for a in node.names] if node.module == "pysim" else [str(node.module)])


def violations(path: Path, source: str) -> list[str]:
    """Imports of one file that its package may not have."""
    own = package(".".join(path.with_suffix("").parts))
    found = {package(module) for module in imports(source)} - {own}
    ours = {name for name in found if re.match(r"(pysim|fmu_build|validation|tests)\b", name)}
    wrong = ours - MAIN[path] if path in MAIN else ours - ALLOWED.get(own, set())
    if own in OUTSIDE:
        wrong |= {name for name in found - ours if name not in OUTSIDE[own] and name not in sys.stdlib_module_names}
    return sorted(wrong)


@pytest.mark.parametrize("path", sources(), ids=str)
def test_imports_point_one_way(path: Path) -> None:
    assert violations(path, (ROOT / path).read_text(encoding="utf-8")) == []


@pytest.mark.parametrize(
    ("path", "source", "wrong"),
    [
        ("pysim/types/x.py", "import pysim.io.records", ["pysim.io"]),
        ("pysim/types/x.py", "import scipy.linalg", ["scipy"]),
        ("pysim/io/x.py", "from pysim import simulate", ["pysim.simulate"]),
        ("pysim/simulate/x.py", "def f():\n    from pysim.identify import g", ["pysim.identify"]),
        ("pysim/diagnose/x.py", "from pysim.plot import bode_figure", ["pysim.plot"]),
        ("pysim/report/x.py", "import fmu_build", ["fmu_build"]),
        ("fmu_build/emit/x.py", "if True:\n    import pysim.types", ["pysim.types"]),
        ("validation/x.py", "import pysim.cli", ["pysim.cli"]),
        ("pysim/cli/x.py", "import fmu_build, pysim.plot, validation.pump, json", []),
    ],
)
def test_the_guard_sees_what_it_is_to_see(path: str, source: str, wrong: list[str]) -> None:
    assert violations(Path(path), source) == wrong
