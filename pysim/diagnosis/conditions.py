"""What it takes to repeat a comparison, in words and numbers that a page can show."""

from __future__ import annotations

import platform
from collections.abc import Mapping

import numpy as np

from fmu_build.version import DISTRIBUTION, version
from pysim.identify import SteppedSine
from pysim.identify.settling import TOLERANCE
from pysim.simulate import Solver
from pysim.types import Model


def conditions(model: Model, plan: SteppedSine, solver: Solver, about: str) -> dict[str, str]:
    """Parameter set, FMU, solver, plan and versions; nothing that changes from one run to the next."""
    return {
        "parameter set": about or "as the FMU holds it",
        "FMU": f"{model.path.name}, FMI {model.abilities.fmi}, token {model.token}",
        "solver": repr(solver),
        "test": f"rest {plan.rest:g} s, ramp {plan.ramp:g} s, hold {plan.hold:g} s, then the sine",
        "settling": f"{plan.settle_time:g} s of the sine, at least {plan.settle_periods} periods; doubled up to "
        f"{plan.settle_limit:g} s while the output changes by more than {TOLERANCE:g} of its amplitude over the fit",
        "fit": f"{plan.fit_periods} whole periods of {plan.points} points",
        "versions": versions(),
    }


def versions() -> str:
    """Of this project, Python and NumPy."""
    return f"{DISTRIBUTION} {version()}, Python {platform.python_version()}, NumPy {np.__version__}"


def parameters(model: Model, overrides: Mapping[str, float]) -> dict[str, tuple[float, str]]:
    """Value and unit of every parameter that was in force; name -> (value, unit)."""
    return {
        v.name: (overrides.get(v.name, v.start), v.unit)
        for v in model.variables
        if v.causality == "parameter" and v.start is not None
    }
