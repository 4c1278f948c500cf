"""Inputs of many experiments, packed for the kernel, and the times at which they are not smooth."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from threading import Lock
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.simulate.kernel.layout import structures
from pysim.simulate.kernel.library import address
from pysim.types import Experiment, Model, Signal


class Packed(NamedTuple):
    """Structures of the kernel, one per experiment, and the arrays that they point to."""

    structures: NDArray[Any]
    kept: tuple[Any, ...]


class Packs:
    """Signals that were packed before, since every pass of a fit has the same ones; the last few that took long.

    Passes in several threads may share it.
    """

    _MOST, _WORTH = 8, 64  # packs; experiments and pieces of signals

    def __init__(self) -> None:
        self._packs: dict[Any, tuple[Any, Packed]] = {}
        self._changing = Lock()

    def inputs(self, model: Model, experiments: Sequence[Experiment]) -> Packed:
        """As `pack_inputs`, with work space of its own."""
        key = tuple([(id(e.inputs), id(e.rates)) for e in experiments])
        packed = self._packed(key, experiments, lambda: pack_inputs(model, experiments))
        if not packed.kept:
            return packed
        own = {name: packed.kept[0][name].copy() for name in ("cursor", "values")}
        found = packed.structures.copy()
        for name, array in own.items():
            found[name] += address(array) - address(packed.kept[0][name])
        return Packed(found, (packed.kept, own))

    def breaks(self, experiments: Sequence[Experiment], ends: Sequence[float]) -> Packed:
        """As `pack_breaks`."""
        times = [(e.start, offset_time(e), end) for e, end in zip(experiments, ends, strict=True)]
        key = tuple([(id(e.inputs), id(e.rates), t) for e, t in zip(experiments, times, strict=True)])
        return self._packed(key, experiments, lambda: pack_breaks(experiments, ends))

    def _packed(self, key: Any, experiments: Sequence[Experiment], pack: Callable[[], Packed]) -> Packed:
        known = self._packs.get(key)
        if known is not None:
            return known[1]
        packed = pack()
        pieces = sum(signal.starts.size for e in experiments for signal in e.inputs.values())
        if len(experiments) + pieces > self._WORTH:
            kept = [(e.inputs, e.rates) for e in experiments]  # so that the numbers in the key stay theirs
            with self._changing:
                while len(self._packs) >= self._MOST:
                    self._packs.pop(next(iter(self._packs)))
                self._packs[key] = kept, packed
        return packed


def pack_inputs(model: Model, experiments: Sequence[Experiment]) -> Packed:
    """`Inputs` of each experiment: driven inputs, then those that carry a rate; all signals one behind the other."""
    signals: list[Signal] = []
    names: list[str] = []
    rates: list[int] = []
    ends = [0]
    for experiment in experiments:
        inputs = experiment.inputs
        names += inputs
        names += experiment.rates
        signals += inputs.values()
        signals += [inputs[of] for of in experiment.rates.values()]
        rates += [0] * len(inputs) + [1] * len(experiment.rates)
        ends.append(len(signals))
    found = np.zeros(len(experiments), dtype=structures()["Inputs"])
    if not signals:
        return Packed(found, ())
    known = {name: model[name].reference for name in set(names)}
    references = np.array([known[name] for name in names], dtype=np.uint32)
    sines = [signal.sines for signal in signals]
    rows = np.concatenate([s.reshape(-1, 4) for s in sines])
    used = rows[:, 0] != 0
    owner = np.repeat(
        np.arange(sum(s.shape[0] for s in sines)), np.concatenate([np.full(s.shape[0], s.shape[1]) for s in sines])
    )
    pieces = _offsets([signal.starts.size for signal in signals])
    arrays: dict[str, NDArray[Any]] = {
        "references": references,
        "rate": np.array(rates, dtype=np.int64),
        "pieces": pieces,
        "cursor": pieces[:-1].copy(),
        "values": np.zeros(len(signals)),
    }
    shared: dict[str, NDArray[Any]] = {
        "starts": _joined([signal.starts for signal in signals]),
        "cubics": _joined([signal.cubics for signal in signals]),
        "waves": _offsets(np.bincount(owner[used], minlength=pieces[-1])),
        "sines": rows[used],
    }
    first = np.array(ends[:-1])
    found["count"] = np.diff(ends)
    for name, array in arrays.items():
        found[name] = address(array) + first * array.itemsize
    for name, array in shared.items():
        found[name] = address(array)
    return Packed(found, (arrays, shared))


def _joined(parts: list[NDArray[Any]]) -> NDArray[Any]:
    """One behind the other; a single one as it is, which may be large."""
    return np.concatenate(parts) if len(parts) > 1 else parts[0]


def _offsets(sizes: Any) -> NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)


def pack_breaks(experiments: Sequence[Experiment], ends: Sequence[float]) -> Packed:
    """`Breaks` of each experiment, were it to end at that time (s)."""
    found = [breaks(experiment, end) for experiment, end in zip(experiments, ends, strict=True)]
    sizes = [times.size for times, _ in found]
    times, jumps = (np.concatenate(parts) if len(parts) > 1 else parts[0] for parts in zip(*found, strict=True))
    packed = np.zeros(len(found), dtype=structures()["Breaks"])
    packed["count"] = sizes
    first = np.cumsum([0, *sizes[:-1]]) * times.itemsize
    packed["times"], packed["jumps"] = address(times) + first, address(jumps) + first
    return Packed(packed, (times, jumps))


def offset_time(experiment: Experiment) -> float:
    """When the states are offset (s); NaN, always the same object, where they are not."""
    if not experiment.offset.size:
        return math.nan
    return float(experiment.start if experiment.offset_at is None else experiment.offset_at)


def breaks(experiment: Experiment, end: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Times (s) after the start at which an input jumps or kinks, or the states are offset; 1 where an input jumps.

    Where one jumps at the very end, a segment of no length lies behind it: the last row is one of after the jump.
    """
    start, offset = experiment.start, offset_time(experiment)
    times, jumps = [np.array([end, offset] if start < offset <= end else [end])], []
    for name, signal in experiment.inputs.items():
        inside = (signal.starts > start) & (signal.starts <= end)
        if not inside.any():
            continue
        jump, kink = signal.breaks()
        if name in experiment.rates.values():
            jump = jump | kink  # the input that carries the rate jumps where the signal kinks
        times.append(signal.starts[inside & (jump | (kink & (signal.starts < end)))])
        jumps.append(signal.starts[inside & jump])
    found = np.unique(np.concatenate(times))
    jumping = np.isin(found, np.concatenate(jumps)) if jumps else np.zeros(found.size, dtype=bool)
    if jumping[-1] or offset == end:
        found, jumping = np.append(found, np.inf), np.append(jumping, False)
    return found, jumping.astype(np.int64)
