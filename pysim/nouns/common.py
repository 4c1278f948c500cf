"""What the verbs share: the data set behind what is given as data, libraries, and inputs as signals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from pysim.types import BadInput, Dataset, Signal
from pysim.types.kinds import path_of

_POINTS = 2001  # at which a function of time is looked at


class HoldsDataset(Protocol):
    """Measurements as a user of Python holds them."""

    @property
    def dataset(self) -> Dataset:
        """The measurements, in SI units."""
        ...


Measured = HoldsDataset | Dataset | Path | str
Input = float | Sequence[Any] | Callable[[float], float] | Signal | Any


def dataset_of(data: Measured) -> Dataset:
    """The data set of what a verb is given as data.

    Args:
        data: what `pysim.load` gives, a data set, or a folder with a dataset.toml.
    Raises:
        BadInput: it is none of these, or cannot be read.
    """
    from pysim.workflow import data_of

    held = getattr(data, "dataset", data)
    if isinstance(held, Dataset):
        return held
    if isinstance(held, str | Path):
        return data_of(held)
    raise BadInput(
        f"data: {type(data).__name__} holds no measurements; give what pysim.load(...) returns, or a folder",
        argument="data",
    )


def libraries_of(library: Path | str | Sequence[Path | str]) -> tuple[Path, ...]:
    """One library or several, as paths; each has to be there."""
    places = [library] if isinstance(library, Path | str) else library
    found = tuple(path_of(one, "library").absolute() for one in places)
    for place in found:
        if not place.exists():
            raise BadInput(
                f"library {place} is not there; name the folder with its package.mo, or a .mo file", argument="library"
            )
    return found


def signal_of(value: Input, stop: float, name: str) -> Signal:
    """An input over time, in its unit.

    Args:
        value: a number; pairs (time in s, value), each held until the next; a column of pandas over time in s, or a
            row of values spread evenly from 0 to `stop`, with straight lines between; a function of time; or a Signal.
        stop: end of the run, s.
        name: of the input, for messages.
    Raises:
        BadInput: it is none of these.
    """
    if isinstance(value, Signal):
        return value
    try:
        if isinstance(value, int | float | np.number):
            return Signal.constant(float(value))
        if callable(value):
            times = np.linspace(0.0, stop, _POINTS)
            return Signal.through(times, [float(value(t)) for t in times.tolist()])
        if hasattr(value, "index") and hasattr(value, "to_numpy"):
            return Signal.lines(np.asarray(value.index, dtype=float), np.asarray(value.to_numpy(), dtype=float))
        rows = np.asarray(value, dtype=float)
        if rows.ndim == 2 and rows.shape[1] == 2:
            return Signal.steps(rows[:, 0], rows[:, 1])
        if rows.ndim == 1:
            return Signal.lines(np.linspace(0.0, stop, rows.size), rows)
    except (TypeError, ValueError) as error:
        raise BadInput(f"input {name}: {error}", argument=name) from error
    raise BadInput(
        f"input {name}: got {type(value).__name__}; give a number, pairs, a row of values, or a function", argument=name
    )
