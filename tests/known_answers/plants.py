"""The plants: their own equations, integrated by SciPy; nothing of the product is used here.

A plant reads a smooth command, and its logs are what sensors show of its states. The formulas of the effects stand a
second time in `models/*.mo`, where the product reads them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import odeint

Array = NDArray[np.float64]
Values = Mapping[str, float]
Effects = Mapping[str, Values]  # name of an effect -> its parameters
Command = Callable[[float], float]
Slope = Callable[[Array, float], list[float]]

MODELS = Path(__file__).parent / "models"

# Name of an effect -> its law: parameters, then what its slot sees -> force in N, or V beside the command.
FORCES: Mapping[str, Callable[[Values, float, float], float]] = {
    "mass.friction": lambda p, x, v: -p["F_c"] * math.tanh(v / 0.02),
    "mass.stick_slip": lambda p, x, v: -math.tanh(v / 0.005) * (p["F_c"] + p["F_d"] * math.exp(-abs(v) / 0.05)),
    "mass.drag": lambda p, x, v: -p["c_2"] * v * abs(v),
    "mass.hardening": lambda p, x, v: -p["k_3"] * x**3,
    "mass.bias": lambda p, x, v: p["F_b"],
    "axis.friction": lambda p, x, v: -p["F_c"] * math.tanh(v / 0.005),
    "axis.incline": lambda p, x, v: -p["F_g"],
    # In no catalogue: a damper that is stronger towards the ends of the way.
    "damper": lambda p, x, v: -p["d_2"] * x**2 * v,
    # In no catalogue: a magnet beside the way pulls the mass towards its place.
    "magnet": lambda p, x, v: -p["F_m"] * (x - p["x_m"]) / p["w"] * math.exp(0.5 - ((x - p["x_m"]) / p["w"]) ** 2 / 2),
}
VOLTAGES: Mapping[str, Callable[[Values, float], float]] = {
    "axis.dead_band": lambda p, u: (abs(u - p["u_0"]) - abs(u + p["u_0"])) / 2,
    "axis.offset": lambda p, u: p["u_n"],
}


@dataclass(frozen=True)
class Sensor:
    """An output: its state, unit, and the standard deviation of its noise in that unit."""

    state: int
    unit: str
    noise: float


@dataclass(frozen=True)
class Plant:
    """Equations, and how they are tested.

    Args:
        model: the Modelica class of the model as designed, in `library`.
        design: the numbers of that model.
        command, unit: name of the input, and its unit.
        sensors: of the outputs, by name.
        slope: parameters in force, effects in force, command -> derivative of the states over (states, time in s).
        states: how many.
        peak: largest value of a command, in `unit`; band: of its frequencies, Hz.
    """

    model: str
    library: Path
    design: Values
    command: str
    unit: str
    sensors: Mapping[str, Sensor]
    slope: Callable[[Values, Effects, Command], Slope]
    states: int
    peak: float
    band: tuple[float, float]


def _mass(p: Values, effects: Effects, push: Command) -> Slope:
    m, d, k = p["m"], p["d"], p["k"]
    laws = [(FORCES[name], values) for name, values in effects.items()]

    def slope(state: Array, t: float) -> list[float]:
        x, v = float(state[0]), float(state[1])
        force = push(t) - d * v - k * x
        for law, values in laws:
            force += law(values, x, v)
        return [v, force / m]

    return slope


def _axis(p: Values, effects: Effects, wanted: Command) -> Slope:
    m, d, gain, lag, stiff = p["m"], p["d"], p["K"], p["T"], p["K_v"]
    forces = [(FORCES[name], values) for name, values in effects.items() if name in FORCES]
    voltages = [(VOLTAGES[name], values) for name, values in effects.items() if name in VOLTAGES]

    def slope(state: Array, t: float) -> list[float]:
        x, v, i = float(state[0]), float(state[1]), float(state[2])
        command = stiff * (wanted(t) - x)
        reached = command + sum(law(values, command) for law, values in voltages)
        force = gain * i - d * v + sum(law(values, x, v) for law, values in forces)
        return [v, force / m, (reached - i) / lag]

    return slope


PLANTS: Mapping[str, Plant] = {
    "mass": Plant(
        "Mass.Design", MODELS / "Mass.mo", {"m": 1.0, "d": 2.0, "k": 40.0},
        "F", "N", {"x": Sensor(0, "m", 1e-3)}, _mass, 2, 8.0, (0.2, 2.5),
    ),
    "axis": Plant(
        "Axis.Design", MODELS / "Axis.mo", {"m": 10.0, "d": 100.0, "K": 20.0, "T": 0.02, "K_v": 50.0},
        "x_ref", "m", {"x": Sensor(0, "m", 1e-4), "i": Sensor(2, "V", 0.01)}, _axis, 3, 0.1, (0.1, 1.5),
    ),
}  # fmt: skip


def wave(seed: int, peak: float, band: tuple[float, float]) -> Command:
    """Eight sines of the band (Hz), grown smoothly from rest within the first second; `peak` high within 15 s."""
    rng = np.random.default_rng(seed)
    rates = (2 * np.pi * rng.uniform(*band, 8)).tolist()
    phases = rng.uniform(0, 2 * np.pi, 8).tolist()
    times = np.linspace(0, 15, 3001)
    highest = np.abs(sum(np.sin(w * times + phase) for w, phase in zip(rates, phases, strict=True))).max()
    pairs, size = list(zip(rates, phases, strict=True)), float(peak / highest)

    def command(t: float) -> float:
        s = min(max(t, 0.0), 1.0)
        grown = size * s**3 * (10 - 15 * s + 6 * s**2)
        return grown * sum([math.sin(w * t + phase) for w, phase in pairs]) if grown else 0.0

    return command


def stairs(seed: int, peak: float) -> Command:
    """Levels up to `peak` that hold for a second and a half, with smooth steps of 0.3 s between; from rest."""
    levels = [0.0, *np.random.default_rng(seed).uniform(-peak, peak, 40).tolist()]

    def command(t: float) -> float:
        k, s = divmod(max(t, 0.0), 1.5)
        s = min(s / 0.3, 1.0)
        return levels[int(k)] + (levels[int(k) + 1] - levels[int(k)]) * s**3 * (10 - 15 * s + 6 * s**2)

    return command


def simulate(plant: Plant, parameters: Values, effects: Effects, command: Command, times: Array) -> Array:
    """What the sensors would read without noise, (n_t, n_y), from rest at time 0; times in s, increasing.

    Parameters that are not named are those of the design.
    """
    slope = plant.slope({**plant.design, **parameters}, effects, command)
    grid = np.concatenate([[0.0], times]) if times[0] > 0 else times
    states = odeint(slope, np.zeros(plant.states), grid, rtol=1e-9, atol=1e-10, hmax=0.02, mxstep=5000)
    read = states[:, [sensor.state for sensor in plant.sensors.values()]]
    return np.asarray(read[grid.size - times.size :])


def noise(n: int, deviation: float, memory: float, rng: np.random.Generator) -> Array:
    """(n,) Gaussian noise of that standard deviation, correlated over `memory` samples (0: white), stationary."""
    kept = math.exp(-1 / memory) if memory > 0 else 0.0
    drawn = rng.standard_normal(n)
    for k in range(1, n if kept else 0):
        drawn[k] = kept * drawn[k - 1] + math.sqrt(1 - kept**2) * drawn[k]
    return deviation * drawn
