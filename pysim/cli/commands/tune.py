"""`pysim tune`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import argument, number, positive, text
from pysim.cli.options import JSON, OUTPUT

if TYPE_CHECKING:
    from pysim.control.tuning import Gains, Plant
    from pysim.present.tuning import Tuning


def run(given: Given) -> Tuning:
    """The gains that were asked for, with the thesis' and the user's own beside them."""
    from pysim.control.tuning import TABLE_6_1, known_pi
    from pysim.present.tuning import Tuning

    plant = _plant(given)
    beside = {f"{label} (Table 6.1)": known_pi(plant, *pair) for label, pair in TABLE_6_1.get(given.plant, {}).items()}
    loops = {"tuned": _tuned(given, plant), **beside}
    for words in given.gains:
        K_p, T_i = _numbers(words, "--gains", 2)
        loops[words] = known_pi(plant, K_p, T_i)
    return Tuning(loops, given.dt, frozenset(beside))


def _plant(given: Given) -> Plant:
    from pysim.control.tuning import Plant, load_pressure_plant, shaft_speed_plant
    from pysim.types import BadInput

    own = given.plant == "own"
    if own != (given.numerator is not None) or own != (given.denominator is not None):
        raise BadInput("tune own takes --numerator and --denominator, and only it does; give both, or name a plant")
    if own:
        plant = Plant(_numbers(given.numerator, "--numerator"), _numbers(given.denominator, "--denominator"))
    else:
        plant = load_pressure_plant() if given.plant == "load" else shaft_speed_plant()
    return plant.delayed(given.delay)


def _tuned(given: Given, plant: Plant) -> Gains:
    from pysim.control.tuning import fastest_pi, tune_pi

    phase_margin = math.radians(given.phase_margin)
    if given.crossover is None:
        return fastest_pi(plant, phase_margin=phase_margin, gain_margin=10 ** (given.gain_margin / 20))
    return tune_pi(plant, crossover=2 * math.pi * given.crossover, phase_margin=phase_margin)


def _numbers(words: str, option: str, count: int | None = None) -> tuple[float, ...]:
    from pysim.types import BadInput

    try:
        found = tuple(float(word) for word in words.split(","))
    except ValueError as error:
        raise BadInput(f"{option} {words}: write numbers with commas between them ({error})") from error
    if count is not None and len(found) != count:
        raise BadInput(f"{option} {words}: write {count} numbers with commas between them")
    return found


COMMAND = Command(
    "tune",
    "Gains of a PI controller from a phase margin and a crossover frequency.",
    run,
    options=(
        argument("PLANT", "load or speed of the thesis' bench, or own", choices=("load", "speed", "own")),
        text("--numerator", "X,X", "numerator of your own plant, highest power of s first"),
        text("--denominator", "X,X", "denominator of your own plant, highest power of s first"),
        number("--delay", "SECONDS", 0.0, "dead time of the plant"),
        number("--phase-margin", "DEG", 60.0, "phase margin to keep"),
        number("--crossover", "HZ", None, "crossover (the fastest that keeps the margins)"),
        number("--gain-margin", "DB", 6.0, "gain margin to keep without --crossover"),
        text("--gains", "K_P,T_I", "gains of yours, judged beside the tuned ones", repeated=True),
        number("--dt", "SECONDS", 1e-3, "sampling time of the controller", convert=positive),
        JSON,
        OUTPUT,
    ),
    passes=lambda result: bool(result.passes),
)
