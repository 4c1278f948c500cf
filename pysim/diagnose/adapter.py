"""Observations of a fit as this diagnosis counts them: in standard deviations of a noise that was fixed beforehand.

It goes when the diagnosis counts in the likelihood of the fit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.observation import Observation, Simulated
from pysim.identify.greybox.residuals import Point, failed_point
from pysim.identify.greybox.runs import Failure
from pysim.types import Outcome

Array = NDArray[np.float64]

Target = Observation


@dataclass(frozen=True)
class Residual:
    """Measured minus simulated: values (n_r,) and slopes (n_r, n_x)."""

    values: Array
    slopes: Array


def over_noise(target: Target, answers: Sequence[Simulated]) -> Residual:
    """Residuals of a target in standard deviations of its noise, initial states left where they are."""
    count = answers[0].slopes.shape[-1]
    rows = target.residual(answers)[:, : 1 + count]
    if target.channels:
        rows = rows / np.array(target.noise)[target.channel_of_row][:, None]
    return Residual(rows[:, 0], rows[:, 1:])


def bad_point(x: Array, why: str) -> Point:
    """A point where the model could not be simulated."""
    return failed_point(x, Failure("", Outcome.MODEL_ERROR, why))
