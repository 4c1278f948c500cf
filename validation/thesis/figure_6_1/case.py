"""Both PI controllers with both sets of gains: margins, and the Bode plots of Figures 6.1 and 6.2."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from pysim.control.tuning import Gains, known_pi, load_pressure_plant, shaft_speed_plant
from pysim.present.tuning import tuning_figure
from validation.findings import Finding
from validation.thesis.numbers import published

_PLANTS = {"load": load_pressure_plant(), "speed": shaft_speed_plant()}
_WORDS = {"matlab": "MATLAB tuned", "manual": "manually tuned"}
_DT = 1e-3  # s, of the sampled controller


def notes() -> Sequence[str]:
    """What the text says and the numbers do not."""
    return (
        "Section 6.1 calls the manually tuned gains much more conservative. Those of the supply circuit are; the load "
        "circuit's are faster than MATLAB's (claim below). Case `rig-control` shows what they are good for.",
    )


def loops(circuit: str) -> dict[str, Gains]:
    """Both sets of gains in one circuit."""
    told, plant = published(__file__), _PLANTS[circuit]
    return {
        words: known_pi(plant, told[f"{circuit}_K_P_{way}"], told[f"{circuit}_T_i_{way}"])
        for way, words in _WORDS.items()
    }


def run() -> Iterator[Finding]:
    """Stable, without steady error, and what is conservative about them."""
    told = published(__file__)
    crossover: dict[tuple[str, str], float] = {}
    for circuit in _PLANTS:
        for words, gains in loops(circuit).items():
            margin = float(np.rad2deg(gains.loop.phase_margins.min()))
            crossover[circuit, words] = float(gains.loop.crossovers.max()) / (2 * np.pi)
            yield Finding(f"{circuit}, {words}: the loop is stable (0: yes)", float(not gains.loop.stable), 0, "")
            claim = f"{circuit}, {words}: phase margin {margin:.1f} deg; short of 60 by"
            yield Finding(claim, max(0.0, told["matlab_margin"] - margin), 0.5, "deg")
    matlab = float(np.rad2deg(loops("load")["MATLAB tuned"].loop.phase_margins.min()))
    claim = "load, MATLAB tuned: its margin is the tuner's default, off by"
    yield Finding(claim, abs(matlab - told["matlab_margin"]), 0.5, "deg (rounding of the gains)")
    slower = crossover["speed", "manually tuned"] - crossover["speed", "MATLAB tuned"]
    yield Finding(
        "speed: the manual gains are more conservative (crossover lower), higher by", max(0.0, slower), 0, "Hz"
    )
    faster = crossover["load", "MATLAB tuned"] - crossover["load", "manually tuned"]
    claim = (
        f"load: the manual gains are faster ({crossover['load', 'manually tuned']:.1f} Hz for "
        f"{crossover['load', 'MATLAB tuned']:.1f} Hz), against the text; slower by"
    )
    yield Finding(claim, max(0.0, faster), 0, "Hz")


def pictures() -> Mapping[str, Figure]:
    """Open and closed loops of both circuits."""
    return {
        "Figure 6.1 redone: load circuit, with its steps.": tuning_figure(loops("load"), dt=_DT),
        "Figure 6.2 redone: supply circuit, with its steps.": tuning_figure(loops("speed"), dt=_DT),
    }
