"""Inputs: Signals packed into arrays that native code evaluates."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._fmu_calls import OK, set_reals
from pysim.simulate._native import native
from pysim.types import Experiment, Model


class Inputs(NamedTuple):
    """All driven inputs. Input i follows signal i, or its rate where rate[i] is 1."""

    references: Any  # (n_u,) uint32, value references
    rate: Any  # (n_u,) int64
    pieces: Any  # (n_u + 1,) int64, signal i owns the pieces pieces[i]:pieces[i + 1]
    starts: Any  # (n_k,) s
    cubics: Any  # (n_k, 4)
    waves: Any  # (n_k + 1,) int64, piece k owns the sines waves[k]:waves[k + 1]
    sines: Any  # (n_s, 4)
    cursor: Any  # (n_u,) int64, piece in force; changed by the loop
    values: Any  # (n_u,) changed by the loop


class Breaks(NamedTuple):
    """Where integration restarts because an input is not smooth."""

    times: Any  # (n_b,) s, increasing; the last one is the end of the run
    jumps: Any  # (n_b,) int64, 1 where a value jumps, which is an event


def pack_inputs(model: Model, experiment: Experiment) -> Inputs:
    """The experiment's inputs, ready for native code."""
    driven = [(name, signal, 0) for name, signal in experiment.inputs.items()]
    driven += [(name, experiment.inputs[of], 1) for name, of in experiment.rates.items()]
    signals = [signal for _, signal, _ in driven]
    present = [signal.sines[..., 0] != 0 for signal in signals]
    pieces = _offsets([signal.starts.size for signal in signals])
    return Inputs(
        references=np.array([model[name].reference for name, _, _ in driven], dtype=np.uint32),
        rate=np.array([rate for _, _, rate in driven], dtype=np.int64),
        pieces=pieces,
        starts=np.concatenate([np.zeros(0), *(s.starts for s in signals)]),
        cubics=np.concatenate([np.zeros((0, 4)), *(s.cubics for s in signals)]),
        waves=_offsets(np.concatenate([np.zeros(0), *(p.sum(axis=1) for p in present)])),
        sines=np.concatenate([np.zeros((0, 4)), *(s.sines[p] for s, p in zip(signals, present, strict=True))]),
        cursor=pieces[:-1].copy(),
        values=np.zeros(len(driven)),
    )


def _offsets(sizes: Any) -> NDArray[np.int64]:
    return np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)


def find_breaks(experiment: Experiment) -> Breaks:
    """Times after the start and before the end at which an input jumps or kinks, and the end."""
    end = float(experiment.times[-1])
    found: dict[float, int] = {end: 0}
    for name, signal in experiment.inputs.items():
        jumps, kinks = signal.breaks()
        if name in experiment.rates.values():
            jumps = jumps | kinks  # the input that carries the rate jumps where the signal kinks
        for t, jump, kink in zip(signal.starts.tolist(), jumps, kinks, strict=True):
            if experiment.start < t < end and (jump or kink):
                found[t] = max(found.get(t, 0), int(jump))
    times = sorted(found)
    return Breaks(np.array(times), np.array([found[t] for t in times], dtype=np.int64))


@native
def _value(inputs: Any, k: int, s: float) -> float:
    c = inputs.cubics[k]
    y = c[0] + s * (c[1] + s * (c[2] + s * c[3]))
    for j in range(inputs.waves[k], inputs.waves[k + 1]):
        w = inputs.sines[j]
        y += w[0] * math.sin(w[1] + (w[2] + 0.5 * w[3] * s) * s)
    return y


@native
def _rate(inputs: Any, k: int, s: float) -> float:
    c = inputs.cubics[k]
    y = c[1] + s * (2.0 * c[2] + 3.0 * s * c[3])
    for j in range(inputs.waves[k], inputs.waves[k + 1]):
        w = inputs.sines[j]
        y += w[0] * (w[2] + w[3] * s) * math.cos(w[1] + (w[2] + 0.5 * w[3] * s) * s)
    return y


@native
def _find_piece(inputs: Any, i: int, t: float, horizon: float) -> int:
    """Piece of input i at time t. One that starts at the horizon is not yet in force when t reaches it."""
    k, last = inputs.cursor[i], inputs.pieces[i + 1] - 1
    while k < last and inputs.starts[k + 1] <= t and inputs.starts[k + 1] < horizon:
        k += 1
    while k > inputs.pieces[i] and inputs.starts[k] > t:
        k -= 1
    inputs.cursor[i] = k
    return k


@native
def set_inputs(fmu: Any, inputs: Any, t: float, horizon: float) -> int:
    """Set every driven input to its value at t, to the left of whatever happens at the horizon."""
    if inputs.references.size == 0:
        return OK
    for i in range(inputs.references.size):
        k = _find_piece(inputs, i, t, horizon)
        s = t - inputs.starts[k]
        if inputs.rate[i] == 0:
            inputs.values[i] = _value(inputs, k, max(s, 0.0))
        else:
            inputs.values[i] = _rate(inputs, k, s) if s >= 0.0 else 0.0
    return set_reals(fmu, inputs.references, inputs.values)
