"""A vessel's heave, and references and pressure of ideal compensation (Figures 5.15 and 5.16, Eq. 5.42 to 5.51)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache

import numpy as np
from matplotlib.figure import Figure

import fmu_build
from pysim.excitation import LeadIn, PiersonMoskowitz, StochasticWave
from pysim.io import read_model
from pysim.plot.style import COLOURS, DASHES, SMALL, TEXT, new_figure, quiet
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record, Signal
from validation.findings import Finding
from validation.thesis.numbers import published

HEIGHT, PERIOD, SEED, LENGTH = 2.0, 10.0, 1, 60.0  # m, s: chosen, the sea state was not published
CRANE = "HydraulicTestBench.Crane.IdealCompensation"
NAMES = ("omegaS_ref", "pL_ref", "z_PL")
_GRAVITY, _SEA = 9.81, 1025.0


def notes() -> Sequence[str]:
    """What was chosen."""
    return (
        "Sea state and crane were not published: H_s = 2 m and T_p = 10 s, and a crane that suits the test bench "
        "(Data.Crane). By Eq. 5.44 as printed no payload would hang: its weight is missing there (MISPRINTS.md).",
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
    heave = _wave().signal().value(np.linspace(0, LENGTH, 6001))
    share = 4 * float(np.std(heave)) / HEIGHT
    yield Finding(
        "heave of one minute: four standard deviations over H_s, off 1 by", abs(share - 1), 0.4, "(few waves)"
    )


def _wave() -> StochasticWave:
    return StochasticWave(PiersonMoskowitz(HEIGHT, PERIOD), LENGTH, SEED, lead=LeadIn.none())


def _velocity() -> Signal:
    """Of the vessel, m/s: the wave's sines, each turned on by its own rate."""
    amplitude, phase, omega = _wave().waves().T
    sines = np.column_stack([amplitude * omega, phase + np.pi / 2, omega, 0 * omega])
    return Signal(np.zeros(1), np.zeros((1, 4)), sines[None])


@cache
def _run(gain: float) -> Record:
    times = np.linspace(0.0, LENGTH, 6001)
    experiment = Experiment(times, NAMES, {"z_v_t": _velocity()}, {"gain": gain})
    return simulate(read_model(fmu_build.build(CRANE)), experiment, solver=Rodas(rtol=1e-8, atol=1e-8))


def _parameter(name: str) -> float:
    start = read_model(fmu_build.build(CRANE))[name].start
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
    for gain, label, colour, dash in (
        (1.0, "ideal compensation", COLOURS[0], "-"),
        (0.0, "none", COLOURS[1], DASHES[1]),
    ):
        record = _run(gain)
        axes.plot(record.time, record["pL_ref"] / 1e5, color=colour, linestyle=dash, linewidth=1.3, label=label)
    axes.set_xlim(0, published(__file__)["length"])
    axes.set_xlabel("Time (s)", fontsize=TEXT)
    axes.set_ylabel("Load pressure (bar)", fontsize=TEXT)
    axes.legend(frameon=False, fontsize=SMALL)
    return {
        "Figure 5.15 redone: heave motion of the vessel, in a sea of our choice.": first,
        "Figure 5.16 redone: load pressure during ideal compensation, and without.": second,
    }
