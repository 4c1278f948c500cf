"""The logs of a cart whose friction its model leaves out."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fmu_build import build
from pysim.io import read_model, write_dataset
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, MeasuredRecord, MeasuredSignal, Record, Signal

LIBRARY = Path(__file__).with_name("Cart.mo")
NOISE = 1e-3  # m
_HOLD, _SECONDS, _EVERY = 1.0, 12.0, 0.02  # s: at rest before a log, its length, between its samples
_PUSHED, _BETWEEN = 6.0, 0.4  # N, standard deviation of the force at points that are so many s apart


def write_logs(folder: Path, seed: int = 1) -> None:
    """Two waves, the second held out."""
    random = np.random.default_rng(seed)
    records = []
    for name, use in (("a.txt", "fit"), ("b.txt", "validate")):
        points = np.arange(0.0, _SECONDS + _BETWEEN / 2, _BETWEEN)
        push = _PUSHED * random.standard_normal(points.size)
        push[0] = 0.0
        force, time = Signal.through(points, push), np.arange(0.0, _SECONDS, _EVERY)
        run = Experiment(time, ("x",), {"F": force}, start=-_HOLD)
        truth = read_model(build("Cart.Truth", libraries=[LIBRARY]))
        x = simulate(truth, run, solver=Rodas(rtol=1e-8, atol=1e-8))["x"] + NOISE * random.standard_normal(time.size)
        log = Record(time, np.column_stack([force.value(time), x]), ("F", "x"), ("N", "m"))
        records.append(MeasuredRecord(name, "stochastic", use, log))
    signals = (
        MeasuredSignal("F", "input", "N", "F", "F"),
        MeasuredSignal("x", "output", "m", "x", "x", noise=NOISE),
    )
    write_dataset(folder, Dataset("cart", "a cart that rubs", "made", signals, tuple(records)))
