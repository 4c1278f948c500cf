"""A whole fit over one evaluation of the same objective by FMPy: what a search costs, in units of the plain way."""

from __future__ import annotations

from collections.abc import Iterator

from validation.benchmarks import pump_fit
from validation.benchmarks.measurement import Measurement, in_turn, load, middle, ratio, times_of

AIM, HOPED = 0.5, 0.25


def measure(pairs: int) -> Iterator[Measurement]:
    """By processor time, which counts; by the clock, which another load disturbs."""
    data = pump_fit.dataset()
    pump_fit.warm_up()
    both = in_turn(lambda: pump_fit.whole_fit(data), lambda: pump_fit.one_evaluation_by_fmpy(data), pairs)
    ours, fmpy = [one for one, _ in both], [other for _, other in both]
    words = f"whole fit over one FMPy evaluation, {pairs} pairs (hoped for: {HOPED})"
    cpu = f"{middle(ours, 'cpu'):.1f} s over {middle(fmpy, 'cpu'):.1f} s of CPU"
    wall = f"{middle(ours, 'wall'):.1f} s over {middle(fmpy, 'wall'):.1f} s by the clock, {load(list(times_of(both)))}"
    yield Measurement(f"{words}: {cpu}", ratio(both, "cpu"), AIM)
    yield Measurement(f"the same: {wall}", ratio(both, "wall"))
