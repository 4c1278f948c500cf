"""Sampled controllers: every block in Modelica against its twin in Python, sample by sample."""

import math
from copy import deepcopy

import numpy as np
import pytest

from pysim.control import (
    PI,
    Block,
    CompensatedLoadController,
    Gain,
    Limiter,
    LoadController,
    NormalizeSignal,
    SpeedController,
    ValveCompensation,
    ZeroSwitch,
)
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Signal
from tests.modelica.built import built

DT, COUNT = 1e-3, 2000
PRESSURE, SPEED = 150e5, 40.0
# Modelica class -> (Python block, overrides, size of each input, start value of each input that stays)
TWINS: dict[str, tuple[Block, dict[str, float], dict[str, float]]] = {
    "PI": (
        PI(2.0, 0.05, DT, low=-1.5, high=2.0, start=0.5),
        {"K_p": 2.0, "T_i": 0.05, "low": -1.5, "high": 2.0, "u_start": 0.5},
        {"reference": 1.0, "measured": 1.0, "track": 3.0, "active": 1.0},
    ),
    "Gain": (Gain(-3.7), {"k": -3.7}, {"u": 1.0}),
    "Limiter": (Limiter(-0.3, 0.6), {"low": -0.3, "high": 0.6}, {"u": 1.0}),
    "ZeroSwitch": (ZeroSwitch(5.0), {"threshold": 5.0}, {"u": 1.0, "speed": SPEED}),
    "NormalizeSignal": (NormalizeSignal(math.radians(15)), {}, {"angle": 0.4}),
    "ValveCompensation": (
        ValveCompensation(1.863e-5, 875.0),
        {},
        {"flow_ref": 4e-3, "p_s": PRESSURE, "p_L": PRESSURE},
    ),
    "SpeedController": (SpeedController(DT), {}, {"reference": 1.5 * SPEED, "measured": SPEED}),
    "LoadController": (LoadController(DT), {}, {"reference": PRESSURE, "measured": PRESSURE, "speed": SPEED}),
    "CompensatedLoadController": (
        CompensatedLoadController(DT),
        {},
        {"reference": PRESSURE, "measured": PRESSURE, "speed": SPEED, "supply": PRESSURE},
    ),
}


def wander(size: float, seed: int) -> Signal:
    """Straight lines between random points, through zero now and then."""
    random = np.random.default_rng(seed)
    knots = np.arange(0.0, 2.5, 0.0371)
    return Signal.lines(knots, size * random.uniform(-1, 1, knots.size))


def gate(seed: int) -> Signal:
    """1 or 0, changing between two samples."""
    random = np.random.default_rng(seed)
    knots = np.arange(0.0205, 2.5, 0.101)
    return Signal.steps(np.append(0.0, knots), np.append(1.0, random.integers(0, 2, knots.size).astype(float)))


@pytest.mark.parametrize("name", TWINS)
def test_a_block_is_its_python_twin_to_rounding(name: str) -> None:
    kept, overrides, sizes = TWINS[name]
    block = deepcopy(kept)
    signals = {key: gate(k) if key == "active" else wander(size, k) for k, (key, size) in enumerate(sizes.items())}
    if "p_s" in signals:
        signals["p_s"] = Signal.constant(310e5)
    time = np.arange(COUNT) * DT
    columns = [signal.value(time) for signal in signals.values()]
    wanted = np.array([block.step(t, row) for t, row in zip(time, zip(*columns, strict=True), strict=True)])
    names = [port.name for port in block.outputs]
    names = ["y"] if names == ["u"] and name == "PI" else names
    held = Experiment(time + DT / 2, tuple(names), signals, overrides)
    found = simulate(built(f"Controllers.{name}"), held, solver=Rodas()).values
    scale = np.abs(wanted).max(axis=0)
    assert (scale > 0).all()
    assert np.abs(found - wanted).max(axis=0) / scale == pytest.approx(np.zeros(len(names)), abs=1e-10)
    assert np.unique(wanted[:, 0]).size > 100
