"""Ten data sets of one programme: times and commands stand in the first, readings of the others as counts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.io import read_dataset
from pysim.types import Dataset, Effect, Record
from validation.blind.plant import BOUNDS
from validation.blind.proof import parameters_of, read_truth

Array = NDArray[np.float64]

NAMES = tuple(f"bench-{k:02d}" for k in (*range(1, 9), 15, 16))
_FIRST = Path(__file__).parents[1] / "measurements" / "bench-01"
_FOLDER = Path(__file__).parent / "measurements"
# Column -> step of its 12 bits, and the digits with which the first set's logs are written.
_STEPS: Mapping[str, tuple[float, int]] = {"alphaPercent": (240 / 4096, 4), "u": (2.4 / 4096, 5)}


def read_set(name: str) -> Dataset:
    """The data set of that name, as it was logged."""
    first = _first()
    if name == NAMES[0]:
        return first
    with np.load(_FOLDER / f"{name}.npz", allow_pickle=False) as content:
        return unpacked(first, name, {key: content[key] for key in content.files})


def packed(dataset: Dataset) -> dict[str, NDArray[np.generic]]:
    """Readings of all logs in a row as differences of counts, and the noise of each column."""
    found: dict[str, NDArray[np.generic]] = {}
    for column, (step, _) in _STEPS.items():
        logs = [r.data[column] for r in dataset.records if isinstance(r.data, Record) and column in r.data.names]
        counts = np.round(np.concatenate(logs) / step).astype(np.int64)
        found[column] = np.diff(counts, prepend=0).astype(np.int16)
        found[f"{column} noise"] = np.array(dataset.signal(column).noise)
    return found


def unpacked(first: Dataset, name: str, content: Mapping[str, NDArray[np.generic]]) -> Dataset:
    """The data set again: times, commands and all else are the first one's."""
    readings, signals = {}, []
    for column, (step, digits) in _STEPS.items():
        counts, places = np.unique(np.cumsum(content[column].astype(np.int64)), return_inverse=True)
        readings[column] = np.array([float(f"{count * step:.{digits}f}") for count in counts.tolist()])[places]
    for signal in first.signals:
        noise = content.get(f"{signal.name} noise")
        signals.append(signal if noise is None else replace(signal, noise=float(noise)))
    records, at = [], dict.fromkeys(_STEPS, 0)
    for record in first.records:
        assert isinstance(record.data, Record)
        columns = []
        for column in record.data.names:
            if column in _STEPS:
                begin, at[column] = at[column], at[column] + record.data.time.size
                columns.append(readings[column][begin : at[column]])
            else:
                columns.append(record.data[column])
        records.append(replace(record, data=replace(record.data, values=np.column_stack(columns))))
    return replace(first, name=name, signals=tuple(signals), records=tuple(records))


@cache
def _first() -> Dataset:
    return read_dataset(_FIRST)


@dataclass(frozen=True)
class Told:
    """The truth beside a data set.

    Args:
        names: effects in force, ("none",) or ("unknown",).
        base: the identified parameters.
        spoken: the effects' numbers by the symbols of the standard list.
    """

    names: tuple[str, ...]
    base: Mapping[str, float]
    spoken: Mapping[str, float]

    def strengths(self, effect: Effect) -> dict[str, float]:
        """An effect's parameters as its class declares them; of one that is not there, not a number."""
        here = self.spoken if effect.name in self.names else {}
        nothing = float("nan")
        return {
            p.name: 1 / here[p.inverse] if p.inverse in here else here.get(p.name, nothing) for p in effect.parameters
        }


def read_told(name: str) -> Told:
    """The truth of that set."""
    told = read_truth()[name]
    names = (told["effect"],) if isinstance(told["effect"], str) else tuple(told["effect"])
    parameters = parameters_of(told["parameters"])
    return Told(names, {key: float(getattr(parameters, key)) for key in BOUNDS}, dict(told["strength"]))
