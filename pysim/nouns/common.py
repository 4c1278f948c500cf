"""What the verbs share: the data set behind what is given as data, libraries, and inputs as signals."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, Dataset, Signal
from pysim.types.kinds import path_of

_POINTS = 2001  # at which a function of time is looked at first
_MOST = 2**17  # points at which it is looked at, at most; chosen: half a second of calls before it is refused
_NEAR = 1e-6  # share of its range that a curve may miss, and of the run that a jump may take; chosen: the solvers' rtol


class HoldsDataset(Protocol):
    """Measurements as a user of Python holds them."""

    @property
    def dataset(self) -> Dataset:
        """The measurements, in SI units."""
        ...


Array = NDArray[np.float64]
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


def signal_of(value: Input, stop: float, name: str, points: Array | None = None) -> Signal:
    """An input over time, in its unit.

    Args:
        value: a number; pairs (time in s, value), each held until the next; a column of pandas over time in s, or a
            row of values spread evenly from 0 to `stop`, with straight lines between; a function of time; or a Signal.
        stop: end of the run, s.
        name: of the input, for messages.
        points: (n_t,) s, from 0 to `stop`: a function is a line between two of them, and may jump at each. Without
            them, it is looked at as often as it needs.
    Raises:
        BadInput: it is none of these, or a function that changes faster than can be looked at.
    """
    if isinstance(value, Signal):
        return value
    try:
        if isinstance(value, int | float | np.number):
            return Signal.constant(float(value))
        if callable(value):
            return _curve(value, stop) if points is None else _lines(value, points)
        if hasattr(value, "index") and hasattr(value, "to_numpy"):
            return Signal.lines(_seconds(np.asarray(value.index)), np.asarray(value.to_numpy(), dtype=float))
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


def _seconds(index: NDArray[Any]) -> Array:
    """Times (n,) of a column in s; dates count from the first one."""
    if index.dtype.kind not in "mM":
        return np.asarray(index, dtype=float)
    return np.asarray((index - index[0] if index.dtype.kind == "M" else index) / np.timedelta64(1, "s"))


def _curve(function: Callable[[float], float], stop: float) -> Signal:
    """A curve through points of the function and its rate; where it misses the function between two, there is one more.

    Raises:
        ValueError: there would be too many.
    """
    time = np.linspace(0.0, stop, _POINTS)
    value, rate = _at(function, time), _rate(function, time, stop)
    uneven = np.random.default_rng(0)  # even times could all be zeros of the function
    while True:
        curve, size = Signal.through(time, value, rate), np.diff(time)
        between = time[:-1] + uneven.uniform(0.3, 0.7, size.size) * size
        seen = _at(function, between)
        near = _NEAR * np.ptp(value) + 1e-12 * np.max(np.abs(value))  # and rounding
        wrong = np.flatnonzero((np.abs(seen - curve.value(between)) > near) & (size > _NEAR * stop))
        if not wrong.size:
            return curve
        if time.size > _MOST:
            raise ValueError(f"the function changes too fast to be followed to {stop:g} s; give a row of its values")
        rate = np.insert(rate, wrong + 1, _rate(function, between[wrong], stop))
        time, value = np.insert(time, wrong + 1, between[wrong]), np.insert(value, wrong + 1, seen[wrong])


def _lines(function: Callable[[float], float], points: Array) -> Signal:
    """A line between two points, from where the function is behind the one to where it is ahead of the other."""
    from pysim.cosim._signals import after, before

    value, cubics = _at(function, np.append(after(points[:-1]), points[-1])), np.zeros((points.size, 4))
    cubics[:, 0] = value
    cubics[:-1, 1] = (_at(function, before(points[1:])) - value[:-1]) / np.diff(points)
    return Signal(points, cubics, np.zeros((points.size, 0, 4)))


def _at(function: Callable[[float], float], times: Array) -> Array:
    found = np.array([function(time) for time in times.tolist()])
    if found.dtype.kind not in "biuf" or found.size != times.size or not np.isfinite(found).all():
        raise ValueError("the function returns what is no finite number; let it return one for each time in s")
    return found.reshape(-1).astype(np.float64)


def _rate(function: Callable[[float], float], times: Array, stop: float) -> Array:
    beside = 0.1 * _NEAR * stop  # on either side
    first, last = np.maximum(times - beside, 0.0), np.minimum(times + beside, stop)
    return (_at(function, last) - _at(function, first)) / (last - first)
