"""Is anything missing that couples the load to the swash plate? Tables 4.1 and 4.3 at 75 percent."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.effects import STANDARD_LIBRARY, read_catalogue, variant
from pysim.identify.greybox import Parameter, problem
from pysim.io import read_model
from pysim.thesis import CLASSES, loaded_responses, published_deviations
from pysim.types import Dataset, FrequencyResponse, Model
from validation.real_measurements.reference import reference

Array = NDArray[np.float64]

_EFFECTS = ("swash.bias", "supply.droop")
_PARAMETERS = ("omega_v", "zeta_v", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau", "pS", "beta")


@dataclass(frozen=True)
class LoadDifference:
    """Loaded minus unloaded, one test.

    Args:
        amplitude: percent.
        db: (n_f,) relative to the lowest frequency; deg: (n_f,).
        mean_db, mean_deg: of the transfer function of the unloaded test to its own measurements (Table 4.4).
    """

    amplitude: float
    frequency: Array
    db: Array
    deg: Array
    mean_db: float
    mean_deg: float


@dataclass(frozen=True)
class Coupling:
    """One quantity of the free model that a load might change.

    Args:
        share: of the weighted squares of the difference that the best change takes, both tests together.
        change: in the quantity's own unit.
    """

    name: str
    share: float
    change: float
    value: float
    unit: str


def load_differences() -> tuple[LoadDifference, ...]:
    """Of the two amplitudes that were measured with and without load."""
    unloaded = {
        r.data.test.amplitude: r.data for r in unloaded_at_75().records if isinstance(r.data, FrequencyResponse)
    }
    misfit = {(row.offset, row.amplitude): row.values for row in published_deviations("4.4")}
    found = []
    for loaded in loaded_responses():
        own = unloaded[loaded.test.amplitude]
        db = 20 * np.log10(loaded.gain / own.gain)
        mean_db, _, mean_deg, _ = misfit[75.0, loaded.test.amplitude]
        deg = np.degrees(loaded.phase - own.phase)
        found.append(LoadDifference(own.test.amplitude, own.frequency, db - db[0], deg, mean_db, mean_deg))
    return tuple(found)


def couplings(differences: Sequence[LoadDifference]) -> tuple[Coupling, ...]:
    """What each quantity of the free model would explain alone, to first order, the best first."""
    model, names = _free_with_effects()
    task = problem(model, [unloaded_at_75()], [Parameter(name) for name in names])
    point = task.residuals().evaluate(model, task.space, task.space.to_search(task.space.start))
    d = np.concatenate([_weighted(one) for one in differences])
    values, slopes = task.space.values(point.x), task.space.slope(point.x)
    found = []
    for j, name in enumerate(task.space.keys):
        column = -point.jacobian[:, j]
        size = float(column @ column)
        amount = float(column @ d) / size if size else 0.0
        share = amount**2 * size / float(d @ d)
        found.append(Coupling(name, share, amount * slopes[j], values[name], task.space.units[j]))
    return tuple(sorted(found, key=lambda one: -one.share))


def _weighted(one: LoadDifference) -> Array:
    """As a table's residuals are: relative gains, then phases, over the misfit."""
    sizes = (one.mean_db / math.sqrt(2 / math.pi), one.mean_deg / math.sqrt(2 / math.pi))
    return np.concatenate([one.db / sizes[0], one.deg / sizes[1]])


def unloaded_at_75() -> Dataset:
    """Table 4.1's responses at 75 percent that were measured under load too."""
    dataset = reference((5.0, 10.0))
    records = [r for r in dataset.records if isinstance(r.data, FrequencyResponse) and r.data.test.offset == 75.0]
    return replace(dataset, records=tuple(records))


def _free_with_effects() -> tuple[Model, list[str]]:
    effects = [effect for effect in read_catalogue(STANDARD_LIBRARY) if effect.name in _EFFECTS]
    name = "FreeUnderLoad"
    made = variant(CLASSES["free"], effects, [STANDARD_LIBRARY], name=name)
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / f"{name}.mo"
        source.write_text(made.text, encoding="utf-8")
        model = read_model(fmu_build.build(name, libraries=[STANDARD_LIBRARY, source]))
    strengths = [f"{made.places[e.name]}.{p.name}" for e in effects for p in e.strengths]
    return model, [*_PARAMETERS, *strengths]
