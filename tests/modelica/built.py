"""Classes of the library built and run, for the tests that compare them with closed forms."""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

import numpy as np

import fmu_build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Model, Record

FINE = Rodas(rtol=1e-8, atol=1e-8)


@cache
def built(name: str, overrides: tuple[tuple[str, float | str], ...] = (), libraries: tuple[Path, ...] = ()) -> Model:
    """A class of the library (its name without `HydraulicTestBench.`), or of `libraries` by its full name."""
    full = name if libraries else f"HydraulicTestBench.{name}"
    return read_model(fmu_build.build(full, overrides=dict(overrides), libraries=libraries))


def ran(
    name: str | Model,
    stop: float,
    recorded: Sequence[str],
    points: int = 401,
    settings: Mapping[str, float] | None = None,
) -> Record:
    """The class, or a model that has been built, from 0 to `stop` s."""
    model = name if isinstance(name, Model) else built(name)
    run = Experiment(np.linspace(0, stop, points), tuple(recorded), overrides=dict(settings or {}))
    return simulate(model, run, solver=FINE)
