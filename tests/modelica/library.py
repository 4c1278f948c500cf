"""The Modelica library as the tests see it: its classes, and what rumoca makes of them.

rumoca stands here for itself, not for fmu_build: a mistake of our lowering must not hide one of the library.
"""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import rumoca

LIBRARY = Path(__file__).parents[2] / "modelica" / "HydraulicTestBench"
FILES = sorted(LIBRARY.rglob("*.mo"))
FOLDERS = sorted(path.parent for path in LIBRARY.rglob("package.mo"))


def class_name(file: Path) -> str:
    """Full name of the class a file of the library holds."""
    parts = file.relative_to(LIBRARY).with_suffix("").parts
    return ".".join(("HydraulicTestBench", *(part for part in parts if part != "package")))


def models_in(package: str) -> list[str]:
    """Full names of the classes of a package that are not partial, in its own order."""
    names = (LIBRARY / package / "package.order").read_text(encoding="utf-8").split()
    return [f"HydraulicTestBench.{package}.{name}" for name in names if not _is_partial(LIBRARY / package / name)]


def _is_partial(path: Path) -> bool:
    file = path.with_suffix(".mo")
    return file.is_file() and bool(re.search(r"^partial ", file.read_text(encoding="utf-8"), re.MULTILINE))


def compiled(name: str, text: str = "") -> Any:
    """rumoca's model of a class of the library, or of one in `text` that uses the library."""
    session = rumoca.Session(roots=[str(LIBRARY)])
    if text:
        return session.loads(text, model=name, filename="test.mo")
    return session.load(LIBRARY / "package.mo", model=name)


@dataclass(frozen=True)
class Run:
    """Result of a simulation: a column per variable over `time` (n_t,) in s."""

    time: np.ndarray
    result: Any

    def __getitem__(self, name: str) -> np.ndarray:
        return np.asarray(self.result[name])


def run(model: Any, stop: float, *, points: int = 401, tolerance: float = 1e-8) -> Run:
    """Simulate with rumoca's own stiff solver from 0 to `stop` s."""
    config = rumoca.SimConfig(rtol=tolerance, atol=1e-9, max_wall_seconds=120)
    result = model.simulate(t=stop, dt=stop / (points - 1), config=config)
    return Run(np.asarray(result.time), result)
