"""The Modelica library as the tests see it: its classes, and what rumoca makes of them.

rumoca stands here for itself, not for fmu_build: a mistake of our lowering must not hide one of the library. One
session reads the library once for all tests of a process, and each class is compiled once.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

LIBRARY = Path(__file__).parents[2] / "modelica" / "HydraulicTestBench"
_TEXT = "Text.mo"  # the session replaces what it has read under this name before


def class_name(file: Path) -> str:
    """Full name of the class that a file of this library, or of one beside it, holds."""
    parts = file.relative_to(LIBRARY.parent).with_suffix("").parts
    return ".".join(part for part in parts if part != "package")


def models_in(package: str) -> list[str]:
    """Full names of the classes of a package that are not partial, in its own order."""
    names = (LIBRARY / package / "package.order").read_text(encoding="utf-8").split()
    return [f"HydraulicTestBench.{package}.{name}" for name in names if not _is_partial(LIBRARY / package / name)]


def _is_partial(path: Path) -> bool:
    file = path.with_suffix(".mo")
    return file.is_file() and bool(re.search(r"^partial ", file.read_text(encoding="utf-8"), re.MULTILINE))


@cache
def _session() -> Any:
    import rumoca

    return rumoca.Session(roots=[str(LIBRARY)])


@cache
def compiled(name: str, text: str = "") -> Any:
    """rumoca's model of a class of the library, or of one in `text` that uses the library."""
    if text:
        return _session().loads(text, model=name, filename=_TEXT)
    named = f"model Named\n  import HydraulicTestBench;\n  extends {name};\nend Named;\n"
    return _session().loads(named, model="Named", filename=_TEXT)


def assert_balanced(model: Any, inputs: Sequence[str] = ()) -> None:
    """As many equations as unknowns, each matched to one, and no input open but these."""
    structure = model.structure()
    assert structure.n_equations == structure.n_unknowns
    assert structure.is_balanced
    assert structure.is_matched
    assert list(model.inputs.names) == list(inputs)


@dataclass(frozen=True)
class Run:
    """Result of a simulation: a column per variable over `time` (n_t,) in s."""

    time: np.ndarray
    result: Any

    def __getitem__(self, name: str) -> np.ndarray:
        return np.asarray(self.result[name])


def run(model: Any, stop: float, *, points: int = 401, tolerance: float = 1e-8) -> Run:
    """Simulate with rumoca's own stiff solver from 0 to `stop` s."""
    import rumoca

    config = rumoca.SimConfig(rtol=tolerance, atol=min(0.1 * tolerance, 1e-9), max_wall_seconds=120)
    result = model.simulate(t=stop, dt=stop / (points - 1), config=config)
    return Run(np.asarray(result.time), result)
