"""What plants and 60 degrees say of Table 6.1's gains, by the thesis' plants and by our model's; the shaft between."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from pysim.control.tuning import (
    TABLE_6_1,
    Gains,
    Plant,
    fastest_pi,
    known_pi,
    load_pressure_plant,
    reachable_phase_margins,
    shaft_speed_plant,
    steady_above,
    tune_pi,
)
from pysim.present.tuning import tuning_figure
from validation.findings import Finding
from validation.load_circuit.case import WAYS, at_working_point
from validation.tuning.own_plants import off_the_model, own_plants

CROSSOVERS = np.geomspace(9.0, 140.0, 400)  # rad/s: where a PI controller can give the load 60 degrees
_MARGIN = math.radians(60)  # the aim of MATLAB's tuner where nothing else is asked for; the thesis names none
_TEN = 10.0  # of gain margin, 20 dB: what MATLAB's speed loop turns out to have, in a round number
_ROUNDING = 5.0  # percent: T_i = 0.023 s is good to 2, which moves K_p by 4


def run() -> Iterator[Finding]:
    """What plants and 60 degrees say, what margins of Table 6.1's own loops say, and the shaft between."""
    yield from _what_60_degrees_say()
    yield from _from_own_model()
    for name, plant in _plants().items():
        K_p, T_i = TABLE_6_1[name]["MATLAB tuned"]
        known = known_pi(plant, K_p, T_i)
        loop = known.loop
        margins = f"{math.degrees(loop.phase_margin):.5f} degrees at {loop.crossover:.5f} rad/s"
        back = tune_pi(plant, crossover=loop.crossover, phase_margin=loop.phase_margin)
        yield Finding(f"{name}: K_p from {margins}", _percent(back.K_p, K_p), 1e-3, "percent off", regression=True)
        yield Finding(f"{name}: T_i from the same", _percent(back.T_i, T_i), 1e-3, "percent off", regression=True)
    matlab, manual = (steady_above(*TABLE_6_1["load"][label]) for label in ("MATLAB tuned", "manually tuned"))
    yield Finding(
        f"the shaft runs without stick and slip above {matlab:.1f} rad/s with MATLAB's load gains; manually tuned",
        manual,
        matlab,
        "rad/s",
    )


def _what_60_degrees_say() -> Iterator[Finding]:
    """Plants of Eq. 5.30 and 5.31 and a phase margin alone; nothing of Table 6.1 goes in but where it is said."""
    load, speed = _plants().values()
    K_p, T_i = TABLE_6_1["load"]["MATLAB tuned"]
    family = _family(load, _MARGIN)
    nearest = min(family, key=lambda one: abs(math.log(one.K_p / K_p)) + abs(math.log(one.T_i / T_i)))
    at_T_i, at_50 = _gain_at(family, T_i), _gain_at(_family(load, math.radians(50)), T_i)
    yield Finding(
        f"load: K_p = {at_T_i:.4g} from 60 degrees and the printed T_i, off the printed {K_p:g} by",
        _percent(at_T_i, K_p),
        _ROUNDING,
        "percent",
        alternative=f"at 50 degrees it would be off by {_percent(at_50, K_p):.0f} percent",
        source="two printed digits of T_i",
    )
    span = max(one.K_p for one in family) / min(one.K_p for one in family)
    yield Finding(
        f"load: 60 degrees alone leave K_p open by a factor of {span:.0f} (nearest to the printed pair: "
        f"{nearest.K_p:.3g}, {nearest.T_i:.3g} s); short of 10 by",
        max(0.0, 10.0 - span),
        0.0,
        "",
        alternative="plant and margin determine the gains of Table 6.1",
    )
    for name, plant in _plants().items():
        fastest = fastest_pi(plant, phase_margin=_MARGIN)
        for label, gains in TABLE_6_1[name].items():
            share = known_pi(plant, *gains).integral / fastest.integral
            yield Finding(
                f"{name}, {label}: K_p/T_i over the fastest with 60 degrees and 6 dB ({fastest.K_p:.3g}, "
                f"{fastest.T_i:.3g} s)",
                share,
                1.0,
                "of it",
                alternative="the thesis' controllers are as fast as these margins allow",
            )
    twenty = fastest_pi(speed, phase_margin=_MARGIN, gain_margin=_TEN)
    printed = known_pi(speed, *TABLE_6_1["speed"]["MATLAB tuned"])
    yield Finding(
        f"speed: K_p/T_i = {twenty.integral:.3g} from 60 degrees and 20 dB, off MATLAB's {printed.integral:.3g} by",
        _percent(twenty.integral, printed.integral),
        _ROUNDING,
        "percent",
        alternative="with 6 dB it is five times as large; 20 dB were read off the loop of Table 6.1 and rounded",
        source="20 dB for 20.2",
    )


def _from_own_model() -> Iterator[Finding]:
    """The same rule on our own model of the bench, linearised."""
    model = at_working_point()
    for name, way in (("load", WAYS[0]), ("speed", WAYS[3])):
        plant = own_plants()[name]
        off = off_the_model(model, way, plant, np.geomspace(0.5, 400, 30))
        yield Finding(
            f"{name}: the plant with one pressure difference, off the linearised FMU", 100 * off, 1e-4, "percent"
        )
        own, theirs = (fastest_pi(one, phase_margin=_MARGIN) for one in (plant, _plants()[name]))
        for what, found, wanted in (("K_p", own.K_p, theirs.K_p), ("T_i", own.T_i, theirs.T_i)):
            yield Finding(
                f"{name}: {what} = {found:.4g} from our model's plant, off that from the thesis' by",
                _percent(found, wanted),
                1.0,
                "percent",
                alternative="the gains hang on the rounding of Table 5.1",
                source="rounding of Table 5.1, as in load-circuit",
            )


def _family(plant: Plant, phase_margin: float) -> list[Gains]:
    """The controllers with this margin, by rising crossover, up to where the integration time is longest."""
    family: list[Gains] = []
    for omega in CROSSOVERS:
        low, high = reachable_phase_margins(plant, float(omega))
        if low < phase_margin < high:
            family.append(tune_pi(plant, crossover=float(omega), phase_margin=phase_margin))
    return family


def _gain_at(family: Sequence[Gains], T_i: float) -> float:
    """K_p at an integration time, on the branch where both rise."""
    rising = family[: 1 + int(np.argmax([one.T_i for one in family]))]
    times, gains = (np.log([getattr(one, name) for one in rising]) for name in ("T_i", "K_p"))
    return float(np.exp(np.interp(math.log(T_i), times, gains)))


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


def _percent(found: float, wanted: float) -> float:
    return 100 * abs(found / wanted - 1)
