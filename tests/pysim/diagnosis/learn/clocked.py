"""Plants whose missing law no catalogue holds, on a clock; and whether a learned curve is the truth."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import odeint

from pysim.diagnosis import Session
from pysim.types.answer import LearnedLaw
from tests.known_answers.plants import PLANTS, Command, wave
from tests.pysim.diagnosis.plants import given, measured

DESIGN = {"m": 1.05, "d": 1.8, "k": 42.0}
# Time on the clock of all logs, state, and deflection of a bristle of 20 mm over its length -> force on the mass, N.
Force = Callable[[float, float, float, float], float]


def on_a_clock(force: Force, *, clock: bool = True) -> Session:
    """Logs of the mass with a force more, which say when they began if `clock`."""
    data, rng = measured("mass", {}, DESIGN, fit=(1, 2), validate=(3,), length=8.0), np.random.default_rng(5)
    records = []
    for record, seed, since in zip(data.records, (1, 2, 3), (0.0, 50.0, 25.0), strict=True):
        push, time = wave(seed, PLANTS["mass"].peak, PLANTS["mass"].band), record.data.time

        def slope(state: NDArray[np.float64], t: float, push: Command = push, since: float = since) -> list[float]:
            x, v, bristle = state.tolist()
            more = push(t) + force(since + t, x, v, bristle)
            return [v, (more - DESIGN["d"] * v - DESIGN["k"] * x) / DESIGN["m"], (v - abs(v) * bristle) / 0.02]

        place = odeint(slope, [0.0, 0.0, 0.0], time, rtol=1e-9, atol=1e-12)[:, 0] + rng.normal(0, 1e-3, time.size)
        values = np.column_stack([[push(t) for t in time.tolist()], place])
        records.append(replace(record, data=replace(record.data, values=values), begin=since if clock else None))
    return given("mass", replace(data, records=tuple(records)), [], initial="near rest")


def within_the_band(law: LearnedLaw, truth: NDArray[np.float64]) -> float:
    """Share of the knots at which the truth lies within the 95 percent band, but for what the parameters absorb."""
    keep = np.eye(law.knots.size) - law.absorbed @ law.absorbed.T
    half = 1.96 * np.sqrt(np.diag(law.covariance))
    return float(np.mean(np.abs(keep @ (law.coefficients - truth)) < half))
