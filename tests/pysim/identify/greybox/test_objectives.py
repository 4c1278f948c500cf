"""The thesis' objectives, Eq. 2.24 to 2.26, and ours on pairs of numbers that were summed up by hand."""

import math

import numpy as np
import pytest

from pysim.identify.greybox import COMBINED, FREQUENCY, NOISE, TIME, Objective
from pysim.identify.greybox.observation import Run, Simulated
from pysim.identify.greybox.residuals import Carried, WeightedResiduals
from pysim.identify.greybox.response_table import ResponseTable
from pysim.identify.greybox.runs import Answer
from pysim.identify.greybox.time_log import TimeLog
from pysim.types import Experiment, FrequencyResponse, Record, SineTest
from pysim.types.answer import FloorSource, NoiseFloor

FLOOR = 0.5
SECONDS = np.array([0.0, 1.0])
DB, DEG = np.array([2.0, -1.0, 4.0]), np.array([3.0, -4.0, 0.5])  # measured minus simulated


def answer(*columns: np.ndarray) -> Simulated:
    """What a run gave, by no parameter."""
    values = np.column_stack(columns)
    return Simulated(values, np.zeros((*values.shape, 0)))


def log() -> TimeLog:
    """50 and 40 percent were measured; 100 percent of this signal are 50 of its units, its noise is 0.5 of them."""
    record = Record(SECONDS, np.array([[50.0], [40.0]]), ("y",), ("mm",), origin="measured")
    run = Run("log", Experiment(SECONDS, ("y",)))
    return TimeLog("by hand", "log", "step", "fit", record, (0.5,), (50.0,), run, index=0)


def table(reference: int | None) -> ResponseTable:
    """A response in a table, without noise: 20/90 dB and 1 degree count as its standard deviations."""
    gain, phase = 0.5 * 10 ** (DB / 20), np.radians(DEG - 60.0)
    measured = FrequencyResponse(np.array([1.0, 2.0, 3.0]), gain, phase, SineTest(25.0, 5.0, "u", "y"), "by hand")
    run = Run("table", Experiment(SECONDS, ("y",)))
    return ResponseTable("by hand", "table", "fit", measured, (run,) * 3, reference)


def cost(objective: Objective, reference: int | None = None) -> float:
    """Of a model that gives 49 and 42.5, and half a sine of 5 by 60 degrees late at each frequency."""
    turn = 2 * np.pi * np.arange(16) / 16
    swing = answer(12.5 + 0.5 * 5.0 * np.sin(turn - np.pi / 3))
    chosen = objective.chosen((log(), table(reference)))
    floors = {("by hand", "y"): NoiseFloor(FLOOR, FloorSource.SPECIFIED)}
    residuals = WeightedResiduals(chosen, floors, measure=objective.measure, absolute=not objective.squares)
    answers = {"time": [answer(np.array([49.0, 42.5]))], "frequency": [swing] * 3}
    simulated = [one for observation in chosen for one in answers[observation.domain]]
    return residuals.weigh(np.zeros(0), Answer(tuple(simulated), (None,) * len(simulated)), Carried(), 0).cost


@pytest.mark.parametrize(
    ("objective", "reference", "by_hand"),
    [
        (TIME, None, (1.0 + 2.5) / 50 * 100),  # Eq. 2.24, in percent of full scale
        (FREQUENCY, None, 90 / 20 * (2 + 1 + 4) + (3 + 4 + 0.5)),  # Eq. 2.25
        (FREQUENCY, 0, 90 / 20 * (0 + 3 + 2) + (3 + 4 + 0.5)),  # magnitudes relative to the first (Eq. 2.12)
        (COMBINED, None, 7.0 + 39.0),  # Eq. 2.26
        (NOISE, None, math.log((1.0**2 + 2.5**2) / 2) + 0.5 * (4.5**2 * (4 + 1 + 16) + (9 + 16 + 0.25))),
    ],
    ids=["Eq. 2.24", "Eq. 2.25", "Eq. 2.25 relative", "Eq. 2.26", "squares"],
)
def test_an_objective_is_the_sum_by_hand(objective: Objective, reference: int | None, by_hand: float) -> None:
    assert cost(objective, reference) == pytest.approx(by_hand, rel=1e-12)
