"""The pump block against Appendix F: each name, each parameter, each equation with its sign, each port."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Model, Signal
from validation.findings import Finding
from validation.mirror.blocks import BLOCKS, PORTS, STATIC, Block

Array = NDArray[np.float64]

_CLASS = "HydraulicTestBench.Pump.A4VSGSignals"
_TEXT = Path(__file__).parents[2] / "modelica" / "HydraulicTestBench" / "Pump"
_SPEED = 1450 * 2 * np.pi / 60  # rad/s
_BESIDE = (
    "L", "A_p", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau", "omega_v", "zeta_v", "stroke_share",
    "V_d_max", "N_p", "eta_r", "alpha_t",
)  # fmt: skip
_SWINGS = ((60.0, 3.0), (-8.0, 11.0))  # % and Hz: both signs of angle, velocity, spool and flow
_LENGTH, _STEP = 0.7, 5e-5  # s


def run() -> Iterator[Finding]:
    """Names, static parameters, equations, ports."""
    there = {variable.name for variable in model().variables}
    missing = [block.name for block in BLOCKS if block.name != "pumpFlow" and f"pump.{block.name}" not in there]
    yield Finding(
        f"names of Tables 6 to 10 that the block lacks, of {len(BLOCKS)}{_listed(missing)}",
        float(len(missing)),
        0.0,
        "",
        alternative="a block of the thesis has no counterpart",
    )
    for name, value in STATIC.items():
        own = model()[f"pump.{name}"].start
        assert isinstance(own, float)
        off = abs(own - value) / (abs(value) or 1.0)
        yield Finding(f"{name} of Table 5", off, 1e-12, "of it", source="printed digits, converted to SI units")
    yield from (_equation(block) for block in BLOCKS if block.formula is not None)
    absent = [name for name in PORTS if name not in connectors()]
    yield Finding(
        f"ports of Appendix F that the block lacks, of {len(PORTS)}{_listed(absent)}",
        float(len(absent)),
        0.0,
        "",
        alternative="a circuit drawn around the thesis' block cannot be drawn around this one",
    )


def _listed(names: list[str]) -> str:
    return f" ({', '.join(names)})" if names else ""


@cache
def model() -> Model:
    """The block with signals for its connectors."""
    return read_model(fmu_build.build(_CLASS))


@cache
def values() -> Mapping[str, Array]:
    """A run with both signs of everything, every name as a row over time."""
    names = [block.name for block in BLOCKS if block.name not in ("pumpFlow", "alphaCMD")]
    recorded = (*(f"pump.{name}" for name in (*names, *_BESIDE)), "pump.alphaCMD", "pump.alphaCMD_t", "omega")
    times = np.arange(0.0, _LENGTH, _STEP)
    waves = [[[size, 0.0, 2 * np.pi * hertz, 0.0] for size, hertz in _SWINGS]]
    inputs = {
        "alphaCMD": Signal(np.array([0.0]), np.array([[0.0, 0.0, 0.0, 0.0]]), np.array(waves)),
        "omega": Signal.constant(_SPEED),
        "p_A": Signal.constant(77e5),
        "p_B": Signal.constant(25e5),
    }
    experiment = Experiment(times, recorded, inputs, rates={"alphaCMD_t": "alphaCMD"})
    record = simulate(model(), experiment, solver=Rodas(rtol=1e-9, atol=1e-9))
    rows = {name.removeprefix("pump."): record[name] for name in recorded}
    return {**rows, "time": record.time}


def off(block: Block) -> float:
    """By how much the block is off the thesis' equation, of its largest size."""
    assert block.formula is not None
    rows = values()
    wanted = np.broadcast_to(np.asarray(block.formula(rows), dtype=np.float64), rows["time"].shape)
    found = rows[block.name]
    if block.rate:  # over two steps, by Simpson's rule
        found = (found[2:] - found[:-2]) / (2 * _STEP)
        wanted = (wanted[2:] + 4 * wanted[1:-1] + wanted[:-2]) / 6
    late = rows["time"][-found.size :] > 0.1  # what is delayed has come through
    size = float(np.abs(wanted[late]).max()) or 1.0
    return float(np.abs(found - wanted)[late].max() / size)


def signs(block: Block) -> tuple[bool, bool]:
    """Whether the run has it below and above zero."""
    row = values()[block.name]
    return bool((row < 0).any()), bool((row > 0).any())


def _equation(block: Block) -> Finding:
    seen = "both signs" if all(signs(block)) else "one sign"
    equation = f"Eq. {block.equation}" if block.equation != "-" else "by its description"
    return Finding(
        f"{block.name} (Table {block.table}), {equation}, {seen}: off by",
        off(block),
        block.tolerance,
        "of its largest",
        alternative="a wrong sign is off by 2, a wrong factor by more than a tenth",
        source="solver at 1e-9; Simpson's rule, smoothing and dead time where they come in",
    )


@cache
def connectors() -> Mapping[str, str]:
    """Name -> class of every connector that the block and what it extends declare."""
    declared = re.compile(r"^  Interfaces\.(\w+) (\w+)\b", re.MULTILINE)
    found: dict[str, str] = {}
    for name in ("SwashPlateControl", "A4VSG"):
        found |= {one[2]: one[1] for one in declared.finditer((_TEXT / f"{name}.mo").read_text(encoding="utf-8"))}
    return found


def table() -> str:
    """The page's table: SimulationX's name, the thesis' equation, what it is here, how far off."""
    rows = ["| Table | SimulationX | Eq. | here, in `Pump.A4VSG` | off its equation |", "|---|---|---|---|---|"]
    for block in BLOCKS:
        checked = "" if block.formula is None else "< 1e-7" if block.tolerance < 1e-6 else f"< {block.tolerance:g}"
        rows.append(f"| {block.table} | `{block.name}` | {block.equation} | {block.about} | {checked} |")
    rows += [f"| - | {words} | - | connector `{name}` | |" for name, words in PORTS.items()]
    return "\n".join(rows)
