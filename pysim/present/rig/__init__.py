"""Tests of the rig under its controllers, shown: `steps` and `heave`, a file each; here what their figures share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.present.style import COLOURS, DASHES, MEASURED

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

BAR = 1e-5  # bar/Pa
TRUE: dict[str, Any] = {"color": COLOURS[0], "linewidth": 1.3}
PULSES: dict[str, Any] = {"color": COLOURS[1], "linestyle": DASHES[3], "linewidth": 1.0}
REFERENCE: dict[str, Any] = {"color": MEASURED, "linestyle": DASHES[1], "linewidth": 1.1}


def within(time: Array, span: tuple[float, float]) -> NDArray[np.bool_]:
    """Which times (n,) are in a span."""
    return np.asarray((time >= span[0]) & (time <= span[1]))
