"""The models that run by themselves: every class of our libraries with an `experiment` annotation."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from fmu_build.build import bundled_library

Array = NDArray[np.float64]

RESULTS = Path(__file__).with_name("reference")
ROWS = 201  # of a stored result
WIDEST = 12  # columns of a stored result
OWN, JOINED = "HydraulicTestBench", "HydraulicTestBenchMSL"
TOLERANCE = 1e-5
REASON = "both solvers at 1e-8 or better over some thousand steps"


@dataclass(frozen=True)
class Limit:
    """How far a run may be off, over the span of the variable, until when, and why."""

    tolerance: float = TOLERANCE
    reason: str = REASON
    until: float | None = None  # s; None for the experiment's own end


@dataclass(frozen=True)
class Example:
    """A class that runs by itself.

    `stop` is that of its `experiment` annotation in s, `libraries` are to be given beside our own.
    """

    name: str
    stop: float
    limit: Limit = Limit()

    @property
    def short(self) -> str:
        """The name without its library, and `MSL.` before those of the joined one."""
        return _short(self.name)

    @property
    def file(self) -> Path:
        """Its stored result."""
        return RESULTS / f"{self.short}.csv"

    @property
    def times(self) -> Array:
        """(ROWS,) s of the stored rows."""
        return np.linspace(0.0, self.limit.until or self.stop, ROWS)

    @property
    def needs_standard_library(self) -> bool:
        """Whether Modelica 4.0.0 has to be on MODELICAPATH."""
        return self.name.startswith(f"{JOINED}.")


_RIG = Limit(
    1e-4,
    "where the shaft turns round it sticks and slips, and the pulses that the controller feeds on come early or late: "
    "each turn magnifies the smallest difference, until after half a minute two solvers go different ways",
    until=20.0,
)
LIMITS: Mapping[str, Limit] = MappingProxyType(
    {
        "Examples.HeaveReference": _RIG,
        "Validation.BenchEnergy": _RIG,
        "Validation.CraneEnergy": _RIG,
        "Examples.TrueDelay": Limit(
            5e-5, "a delayed value is interpolated between the steps that the importer reports"
        ),
    }
)
REFUSED = MappingProxyType(
    {"MSL.Examples.FluidLine": "Modelica.Media redeclares records in place, which our own compiler refuses"}
)


def examples() -> tuple[Example, ...]:
    """All of them, by name."""
    found = []
    for library in (bundled_library(), bundled_library().with_name(JOINED)):
        for file in sorted(library.rglob("*.mo")):
            text = file.read_text(encoding="utf-8")
            stop = re.search(r"\bexperiment\([^)]*\bStopTime=([-+.0-9e]+)", text)
            if stop and not re.search(r"^partial ", text, re.MULTILINE):
                name = ".".join([library.name, *file.relative_to(library).with_suffix("").parts])
                found.append(Example(name, float(stop[1]), LIMITS.get(_short(name), Limit())))
    return tuple(found)


def libraries_of(example: Example) -> list[Path]:
    """Folders for `fmu_build.build` beside our own library.

    Raises:
        LookupError: the standard library is not there; says so plainly.
    """
    if not example.needs_standard_library:
        return []
    places = [Path(place) for place in os.environ.get("MODELICAPATH", "").split(os.pathsep) if place]
    for place in places:
        if (place / "Modelica" / "package.mo").is_file():
            return [place / "Modelica", place / "ModelicaServices", bundled_library().with_name(JOINED)]
    raise LookupError("no Modelica 4.0.0 on MODELICAPATH")


def _short(name: str) -> str:
    library, _, rest = name.partition(".")
    return rest if library == OWN else f"MSL.{rest}"
