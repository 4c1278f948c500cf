"""What makes measurements differ from a model although no physics is missing: noise, sensors, loggers, starts."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Array = NDArray[np.float64]

SENSORS = ("offset", "gain", "shift", "drift")
"""Errors of the logged angle that a diagnosis may name."""
KINDS = ("coloured", "start", *SENSORS, "jitter", "understated", "overstated", "unstated")
_STATED = {"understated": 0.3, "overstated": 3.0, "unstated": 0.0}


@dataclass(frozen=True)
class Nuisance:
    """All off by default.

    Args:
        coloured: standard deviation of noise with memory, over that of the white noise.
        memory: s, its time constant.
        hold: s at the offset ahead of a test; under half a second the plate still moves when the log begins.
        before: percent, from where a wave's lead comes.
        offset: percent, added to the logged angle (not to the one that is fed back).
        gain: of the logged angle, over 1.
        shift: s by which outputs are logged later than the command beside them.
        drift: percent an hour, by which the logged angle goes off.
        jitter: s, by which a time stamp is off at most.
        stated: noise that the data set states over what there is; 0 where it states none.
    """

    coloured: float = 0.0
    memory: float = 0.02
    hold: float = 1.0
    before: float = 0.0
    offset: float = 0.0
    gain: float = 1.0
    shift: float = 0.0
    drift: float = 0.0
    jitter: float = 0.0
    stated: float = 1.0


def draw_nuisance(kinds: tuple[str, ...], rng: np.random.Generator) -> Nuisance:
    """Those kinds at seeded sizes."""
    unknown = set(kinds) - set(KINDS)
    if unknown:
        raise ValueError(f"no nuisance called {', '.join(sorted(unknown))}; there are {', '.join(KINDS)}")
    sign = rng.choice((-1.0, 1.0), size=4)
    ratio, memory, hold, before, offset, gain, shift, drift, jitter = rng.uniform(size=9)
    chosen: dict[str, float] = {}
    if "coloured" in kinds:
        chosen |= {"coloured": 0.3 + 1.2 * ratio, "memory": 0.01 * 10**memory}
    if "start" in kinds:
        chosen |= {"hold": round(0.02 + 0.1 * hold, 3), "before": float(sign[0]) * (5 + 15 * before)}
    if "offset" in kinds:
        chosen |= {"offset": float(sign[1]) * 0.1 * 10**offset}
    if "gain" in kinds:
        chosen |= {"gain": 1 + float(sign[2]) * 0.002 * 10**gain}
    if "shift" in kinds:
        chosen |= {"shift": round(0.2 * 10**shift, 1) * 1e-3}
    if "drift" in kinds:
        chosen |= {"drift": float(sign[3]) * 1.0 * 10**drift}
    if "jitter" in kinds:
        chosen |= {"jitter": 0.1e-3 * 10 ** (0.6 * jitter)}
    stated = [size for kind, size in _STATED.items() if kind in kinds] or [1.0]
    return Nuisance(**chosen, stated=stated[0])


def noise(n: int, deviation: float, nuisance: Nuisance, interval: float, rng: np.random.Generator) -> Array:
    """White noise, and noise with memory where the nuisance asks for it, of n samples."""
    white = deviation * rng.standard_normal(n)
    if nuisance.coloured == 0.0:
        return white
    kept = math.exp(-interval / nuisance.memory)
    size = nuisance.coloured * deviation
    drive = size * math.sqrt(1 - kept**2) * rng.standard_normal(n)
    drive[0] = size * rng.standard_normal()
    return white + np.asarray(lfilter([1.0], [1.0, -kept], drive))


def deviation_told(deviation: float, nuisance: Nuisance) -> float:
    """Of all noise together, which a good data sheet would state."""
    return deviation * math.hypot(1.0, nuisance.coloured)
