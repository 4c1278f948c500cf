"""A vessel's heave, and references and pressures of ideal compensation (Figures 5.15 and 5.16, Eq. 5.42 to 5.51)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import fmu_build
from pysim.excitation import LeadIn, PiersonMoskowitz, StochasticWave
from pysim.io import read_model
from pysim.present.style import COLOURS, DASHES, SMALL, TEXT, new_figure, quiet
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record, Signal
from validation.findings import Finding
from validation.thesis.numbers import published

HEIGHT, PERIOD, SEED, LENGTH = 2.0, 10.0, 1, 60.0  # m, s: chosen, the sea state was not published
CRANE = "HydraulicTestBench.Crane.IdealCompensation"
WINCH = "HydraulicTestBench.Crane.HydraulicCompensation"
NAMES = ("omegaS_ref", "pL_ref", "z_PL")
_GRAVITY, _SEA = 9.81, 1025.0
_DRIVE, _PUMP = 1450 / 60, 71e-6  # 1/s and m3 of the pump
_SETTLED = 5.0  # s after which a winch that was at rest follows the vessel
_BEGIN = 20.0  # s of the minute at which Figure 5.16's fifteen begin
_SWING = 0.1  # of the supply pressure's swing: what the swash plate's lag may cost


def notes() -> Sequence[str]:
    """What was chosen."""
    return (
        "Sea state and crane were not published: H_s = 2 m and T_p = 10 s, and a crane that suits the test bench "
        "(Data.Crane). The friction of its winch is a damping of our choice, so the supply pressure is that of Figure "
        "5.16 in kind, not in size. By Eq. 5.44 as printed no payload would hang: its weight is missing there "
        "(MISPRINTS.md).",
    )


def run() -> Iterator[Finding]:
    """References by their equations; the pressure stands still; without compensation it does not."""
    record, z_t = _run(1.0), _velocity()
    r_d = _parameter("r_d")
    off = float(np.abs(record["omegaS_ref"] + z_t.value(record.time) / r_d).max())
    yield Finding("speed reference against Eq. 5.50", off, 1e-9, "rad/s")
    weight = (_parameter("m_PL") - _SEA * _parameter("V_PL")) * _GRAVITY
    expected = weight * r_d * 2 * np.pi / _parameter("Vm_max") / 1e5
    pressure = record["pL_ref"] / 1e5
    claim = f"load pressure of ideal compensation against the payload's weight, {expected:.1f} bar"
    yield Finding(claim, float(np.abs(pressure - expected).max()), 0.01, "bar")
    yield Finding("payload at rest, moved by", float(np.ptp(record["z_PL"])), 1e-4, "m")
    without = float(np.ptp(_run(0.0)["pL_ref"])) / 1e5
    yield Finding(
        f"without compensation the pressure swings by {without:.1f} bar; short of 1 by", max(0, 1 - without), 0, "bar"
    )
    yield from _supply()
    heave = _wave().signal().value(np.linspace(0, LENGTH, 6001))
    share = 4 * float(np.std(heave)) / HEIGHT
    yield Finding(
        "heave of one minute: four standard deviations over H_s, off 1 by", abs(share - 1), 0.4, "(few waves)"
    )


def _supply() -> Iterator[Finding]:
    """Ideal against a winch driven by the bench's own pump, which is fed forward and does not know of its errors."""
    winch = _winch()
    settled = winch.time > _SETTLED
    ideal = ideal_supply(winch.time)[settled]
    off = float(np.sqrt(np.mean((winch["pS"][settled] - ideal) ** 2)))
    swing = float(np.ptp(ideal))
    claim = f"supply pressure swings by {swing / 1e5:.1f} bar; that of a winch driven by the pump is off, rms"
    yield Finding(claim, off / swing, _SWING, "of the swing")
    heave = float(np.ptp(winch["z_v"][settled]))
    left = float(np.ptp(winch["z_PL"][settled]))
    yield Finding(f"its payload moves {left:.2f} m where the vessel moves {heave:.2f} m", left / heave, _SWING, "")


def ideal_supply(time: np.ndarray) -> np.ndarray:
    """Supply pressure (n_t,) in Pa where the drum follows the vessel exactly: Eq. 5.43, its torque from the motor."""
    values = {name: _parameter(name, WINCH) for name in ("J_eff", "c", "r_d", "m_PL", "V_PL", "Vm_max")}
    weight = (values["m_PL"] - _SEA * values["V_PL"]) * _GRAVITY
    omega, rate = (-signal.value(time) / values["r_d"] for signal in (_velocity(), _velocity(1)))
    torque = values["J_eff"] * rate + values["c"] * omega + values["r_d"] * weight
    return np.asarray(torque * 2 * np.pi / values["Vm_max"])


@cache
def _winch() -> Record:
    """Percent of the pump's angle over velocity by Eq. 5.35 and 5.50."""
    feed = 100 * _parameter("Vm_max", WINCH) / (_PUMP * _DRIVE) / (2 * np.pi * _parameter("r_d", WINCH))
    velocity = _velocity()
    sines = velocity.sines * np.array([-feed, 1.0, 1.0, 1.0])
    inputs = {"z_v_t": velocity, "alphaCMD": Signal(velocity.starts, velocity.cubics, sines)}
    times = np.linspace(0.0, LENGTH, 6001)
    experiment = Experiment(times, ("pS", "F_L", "z_PL", "z_v"), inputs, rates={"alphaCMD_t": "alphaCMD"})
    return simulate(read_model(fmu_build.build(WINCH)), experiment, solver=Rodas(rtol=1e-8, atol=1e-8))


def _wave() -> StochasticWave:
    return StochasticWave(PiersonMoskowitz(HEIGHT, PERIOD), LENGTH, SEED, lead=LeadIn.none())


def _velocity(more: int = 0) -> Signal:
    """Of the vessel, m/s, or a further derivative of it: the wave's sines, each turned on by its own rate."""
    amplitude, phase, omega = _wave().waves().T
    sines = np.column_stack([amplitude * omega ** (1 + more), phase + (1 + more) * np.pi / 2, omega, 0 * omega])
    return Signal(np.zeros(1), np.zeros((1, 4)), sines[None])


@cache
def _run(gain: float) -> Record:
    times = np.linspace(0.0, LENGTH, 6001)
    experiment = Experiment(times, NAMES, {"z_v_t": _velocity()}, {"gain": gain})
    return simulate(read_model(fmu_build.build(CRANE)), experiment, solver=Rodas(rtol=1e-8, atol=1e-8))


def _parameter(name: str, model: str = CRANE) -> float:
    start = read_model(fmu_build.build(model))[name].start
    assert start is not None
    return start


def pictures() -> Mapping[str, Figure]:
    """Heave over a minute, and fifteen seconds of pressure."""
    first = new_figure(7.2, 2.6)
    axes = first.subplots()
    quiet(axes)
    time = np.linspace(0, LENGTH, 2000)
    axes.plot(time, _wave().signal().value(time), color=COLOURS[0], linewidth=1.3)
    axes.set_xlim(0, LENGTH)
    axes.set_xlabel("Time (s)", fontsize=TEXT)
    axes.set_ylabel("Heave of the vessel (m)", fontsize=TEXT)
    second = new_figure(7.2, 2.8)
    axes = second.subplots()
    quiet(axes)
    ideal, winch = _run(1.0), _winch()
    for label, record, pressure in (
        ("load, ideal compensation", ideal, ideal["pL_ref"]),
        ("supply, ideal compensation", winch, ideal_supply(winch.time)),
        ("supply, winch driven by the pump", winch, winch["pS"]),
        ("load without compensation", _run(0.0), _run(0.0)["pL_ref"]),
    ):
        k = len(axes.lines)
        shown = (record.time >= _BEGIN) & (record.time <= _BEGIN + published(__file__)["length"])
        look: dict[str, Any] = {"color": COLOURS[k], "linestyle": DASHES[k], "linewidth": 1.3}
        axes.plot(record.time[shown], pressure[shown] / 1e5, label=label, **look)
    axes.set_xlabel("Time (s)", fontsize=TEXT)
    axes.set_ylabel("Pressure (bar)", fontsize=TEXT)
    axes.set_ylim(top=124)
    axes.legend(frameon=False, fontsize=SMALL, ncols=2, loc="upper center")
    return {
        "Figure 5.15 redone: heave motion of the vessel, in a sea of our choice.": first,
        "Figure 5.16 redone: supply and load pressure during ideal compensation.": second,
    }
