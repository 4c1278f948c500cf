"""Inputs: Signals packed into arrays that the kernel evaluates, and the times at which they are not smooth."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.types import Experiment, Model

_NONE: dict[str, Any] = {"count": 0}
_NO_JUMP = np.zeros(1, dtype=np.int64)


def input_arrays(model: Model, experiment: Experiment) -> dict[str, Any]:
    """What `Inputs` of the kernel points to."""
    driven = [(name, signal, 0) for name, signal in experiment.inputs.items()]
    driven += [(name, experiment.inputs[of], 1) for name, of in experiment.rates.items()]
    if not driven:
        return _NONE
    signals = [signal for _, signal, _ in driven]
    present = [signal.sines[..., 0] != 0 for signal in signals]
    pieces = _offsets([signal.starts.size for signal in signals])
    return {
        "count": len(driven),
        "references": np.array([model[name].reference for name, _, _ in driven], dtype=np.uint32),
        "rate": np.array([rate for _, _, rate in driven], dtype=np.int64),
        "pieces": pieces,
        "starts": np.concatenate([s.starts for s in signals]),
        "cubics": np.concatenate([s.cubics for s in signals]),
        "waves": _offsets(np.concatenate([p.sum(axis=1) for p in present])),
        "sines": np.concatenate([s.sines[p] for s, p in zip(signals, present, strict=True)]),
        "cursor": pieces[:-1].copy(),
        "values": np.zeros(len(driven)),
    }


def _offsets(sizes: Any) -> NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)


def break_arrays(experiment: Experiment) -> dict[str, Any]:
    """What `Breaks` of the kernel points to: times after the start at which an input jumps or kinks, up to the end.

    Where one jumps at the very end, a segment of no length lies behind it: the last row is one of after the jump.
    """
    end = float(experiment.times[-1])
    if not experiment.inputs:
        return {"count": 1, "times": np.array([end]), "jumps": _NO_JUMP}
    found: dict[float, int] = {end: 0}
    for name, signal in experiment.inputs.items():
        if not np.any((signal.starts > experiment.start) & (signal.starts <= end)):
            continue
        jumps, kinks = signal.breaks()
        if name in experiment.rates.values():
            jumps = jumps | kinks  # the input that carries the rate jumps where the signal kinks
        for t, jump, kink in zip(signal.starts.tolist(), jumps, kinks, strict=True):
            if experiment.start < t <= end and (jump or (kink and t < end)):
                found[t] = max(found.get(t, 0), int(jump))
    if found[end]:
        found[np.inf] = 0
    times = sorted(found)
    return {"count": len(times), "times": np.array(times), "jumps": np.array([found[t] for t in times], dtype=np.int64)}
