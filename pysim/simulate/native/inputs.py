"""Inputs: Signals packed into arrays that native code evaluates, and the times at which they are not smooth."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.simulate.native.compiled import doubles, longs, native
from pysim.simulate.native.fmu_calls import OK, WARNING, set_reals
from pysim.types import Experiment, Model

# Addresses; input i follows signal i, or its rate.
INPUTS = np.dtype(
    [
        ("count", np.int64),  # n_u
        ("references", np.int64),  # (n_u,) of uint32
        ("rate", np.int64),  # (n_u,) of int64, 1 for the rate
        ("pieces", np.int64),  # (n_u + 1,) of int64, signal i owns the pieces pieces[i]:pieces[i + 1]
        ("starts", np.int64),  # (n_k,) s
        ("cubics", np.int64),  # (n_k, 4)
        ("waves", np.int64),  # (n_k + 1,) of int64, piece k owns the sines waves[k]:waves[k + 1]
        ("sines", np.int64),  # (n_s, 4)
        ("cursor", np.int64),  # (n_u,) of int64, piece in force
        ("values", np.int64),  # (n_u,)
    ]
)

# Where integration restarts because an input is not smooth.
BREAKS = np.dtype(
    [
        ("count", np.int64),  # n_b
        ("times", np.int64),  # (n_b,) s, increasing; the last one is the end of the run
        ("jumps", np.int64),  # (n_b,) of int64, 1 where a value jumps, which is an event
    ]
)


_NONE: dict[str, Any] = {"count": 0}
_NO_JUMP = np.zeros(1, dtype=np.int64)


def input_arrays(model: Model, experiment: Experiment) -> dict[str, Any]:
    """What INPUTS points to."""
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
    """What BREAKS points to: times after the start at which an input jumps or kinks, up to the end of the run.

    Where one jumps at the very end, a segment of no length lies behind it: the last row is one of after the jump.
    """
    end, offset = float(experiment.times[-1]), offset_arrays(experiment).get("offset_at", experiment.start)
    if not experiment.inputs and not experiment.start < offset:
        return {"count": 1, "times": np.array([end]), "jumps": _NO_JUMP}
    found: dict[float, int] = {end: 0}
    if experiment.start < offset:
        found[offset] = 0
    for name, signal in experiment.inputs.items():
        if not np.any((signal.starts > experiment.start) & (signal.starts <= end)):
            continue
        jumps, kinks = signal.breaks()
        if name in experiment.rates.values():
            jumps = jumps | kinks  # the input that carries the rate jumps where the signal kinks
        for t, jump, kink in zip(signal.starts.tolist(), jumps, kinks, strict=True):
            if experiment.start < t <= end and (jump or (kink and t < end)):
                found[t] = max(found.get(t, 0), int(jump))
    if found[end] or offset == end:
        found[np.inf] = 0
    times = sorted(found)
    return {"count": len(times), "times": np.array(times), "jumps": np.array([found[t] for t in times], dtype=np.int64)}


def offset_arrays(experiment: Experiment) -> dict[str, Any]:
    """The fields of RUN that say what is added to the states, and when; none where nothing is."""
    if not experiment.offset.size:
        return {}
    at = experiment.start if experiment.offset_at is None else experiment.offset_at
    return {"offset_at": float(at), "offset": experiment.offset}


@native
def _value(inputs: Any, k: int, s: float) -> float:
    c, waves = doubles(inputs.cubics + 32 * k), longs(inputs.waves)
    y = c[0] + s * (c[1] + s * (c[2] + s * c[3]))
    for j in range(waves[k], waves[k + 1]):
        w = doubles(inputs.sines + 32 * j)
        y += w[0] * math.sin(w[1] + (w[2] + 0.5 * w[3] * s) * s)
    return y


@native
def _rate(inputs: Any, k: int, s: float) -> float:
    c, waves = doubles(inputs.cubics + 32 * k), longs(inputs.waves)
    y = c[1] + s * (2.0 * c[2] + 3.0 * s * c[3])
    for j in range(waves[k], waves[k + 1]):
        w = doubles(inputs.sines + 32 * j)
        y += w[0] * (w[2] + w[3] * s) * math.cos(w[1] + (w[2] + 0.5 * w[3] * s) * s)
    return y


@native
def _find_piece(inputs: Any, i: int, t: float, horizon: float) -> int:
    """Piece of input i at time t. One that starts at the horizon is not yet in force when t reaches it."""
    starts, cursor, pieces = doubles(inputs.starts), longs(inputs.cursor), longs(inputs.pieces)
    k, last = cursor[i], pieces[i + 1] - 1
    while k < last and starts[k + 1] <= t and starts[k + 1] < horizon:
        k += 1
    while k > pieces[i] and starts[k] > t:
        k -= 1
    cursor[i] = k
    return k


@native
def set_inputs(job: Any, t: float) -> int:
    """Set every driven input to its value at t, to the left of whatever happens at the horizon."""
    inputs = job.inputs
    if inputs.count == 0 or t == job.run.inputs_at:  # several stages of a step look at one moment
        return OK
    starts, rate, values = doubles(inputs.starts), longs(inputs.rate), doubles(inputs.values)
    for i in range(inputs.count):
        k = _find_piece(inputs, i, t, job.run.horizon)
        s = t - starts[k]
        if rate[i] == 0:
            values[i] = _value(inputs, k, max(s, 0.0))
        else:
            values[i] = _rate(inputs, k, s) if s >= 0.0 else 0.0
    status = set_reals(job.fmu, inputs.references, inputs.values, inputs.count)
    job.run.inputs_at = t if status <= WARNING else np.nan
    return status
