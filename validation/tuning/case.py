"""Margins of Table 6.1's gains; the same gains back from them; what the retuning did that the plants do not show."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from matplotlib.figure import Figure

from pysim.control.tuning import (
    TABLE_6_1,
    Gains,
    Plant,
    fastest_pi,
    known_pi,
    load_pressure_plant,
    shaft_speed_plant,
    steady_above,
    tune_pi,
)
from pysim.present.tuning import tuning_figure
from validation.findings import Finding


def run() -> Iterator[Finding]:
    """Gains back from margins, then from margins in round numbers, then the shaft between both loops."""
    for name, plant in _plants().items():
        K_p, T_i = TABLE_6_1[name]["MATLAB tuned"]
        known = known_pi(plant, K_p, T_i)
        loop = known.loop
        margins = f"{math.degrees(loop.phase_margin):.5f} degrees at {loop.crossover:.5f} rad/s"
        back = tune_pi(plant, crossover=loop.crossover, phase_margin=loop.phase_margin)
        yield Finding(f"{name}: K_p from {margins}", _percent(back.K_p, K_p), 5.0, "percent off")
        yield Finding(f"{name}: T_i from the same", _percent(back.T_i, T_i), 5.0, "percent off")
        yield from _rounded(name, plant, known)
    matlab, manual = (steady_above(*TABLE_6_1["load"][label]) for label in ("MATLAB tuned", "manually tuned"))
    yield Finding(
        f"the shaft runs without stick and slip above {matlab:.1f} rad/s with MATLAB's load gains; manually tuned",
        manual,
        matlab,
        "rad/s",
    )


def pictures() -> Mapping[str, Figure]:
    """Figures 6.1 and 6.2, with steps."""
    found = {}
    for (name, plant), number in zip(_plants().items(), ("6.1", "6.2"), strict=True):
        loops = {label: known_pi(plant, *gains) for label, gains in TABLE_6_1[name].items()}
        loops["fastest with 60 degrees, 6 dB"] = fastest_pi(plant, phase_margin=math.radians(60))
        found[f"Figure {number}: the {name} controller."] = tuning_figure(loops, dt=1e-3)
    return found


def _plants() -> Mapping[str, Plant]:
    return {"load": load_pressure_plant(), "speed": shaft_speed_plant()}


def _rounded(name: str, plant: Plant, known: Gains) -> Iterator[Finding]:
    """Margins as somebody would write them down: the crossover to three digits, the phase to a tenth of a degree."""
    crossover = float(f"{known.loop.crossover:.3g}")
    degrees = round(math.degrees(known.loop.phase_margin), 1)
    found = tune_pi(plant, crossover=crossover, phase_margin=math.radians(degrees))
    claim = f"{name}: K_p/T_i from {degrees} degrees at {crossover:g} rad/s"
    yield Finding(claim, _percent(found.integral, known.integral), 5.0, "percent off")
    if name == "load":
        yield Finding(f"{name}: K_p from the same", _percent(found.K_p, known.K_p), 5.0, "percent off")


def _percent(found: float, wanted: float) -> float:
    return 100 * abs(found / wanted - 1)
