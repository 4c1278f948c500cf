"""The diagnosis of the thesis' test bench: its linear friction is not enough (Section 5.5)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING

from pysim.diagnosis import diagnose
from pysim.types.answer import Diagnosis
from validation.findings import Finding
from validation.rig_diagnosis.machines import MACHINES, asked, measured, truth

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SEED = 1
_NONE = "none"


def run() -> Iterator[Finding]:
    """What is missing is named and nothing else, its numbers are the machine's, and the error falls to the noise."""
    for machine in MACHINES:
        found = answer(machine)
        named = ", ".join(one.effect.name for one in found.effects) or found.verdict
        yield Finding(f"{machine}: answered with {named}", float(named != machine), 0, "wrong")
        yield from _errors(machine, found)
        yield from _numbers(machine, found)


@cache
def answer(machine: str) -> Diagnosis:
    """The diagnosis of a machine's logs."""
    return diagnose(asked(measured(machine, SEED).dataset))


def _errors(machine: str, found: Diagnosis) -> Iterator[Finding]:
    refit, last = found.history[1], found.history[-1]
    for what, before, after in (("fitted", refit.fit, last.fit), ("held out", refit.validate, last.validate)):
        assert before is not None
        assert after is not None
        yield Finding(f"{machine}: residual over noise at the end, {what}", after, 1.05, "")
        if machine != _NONE:
            yield Finding(f"{machine}: the same over that of the refitted model, {what}", after / before, 0.3, "")


def _numbers(machine: str, found: Diagnosis) -> Iterator[Finding]:
    """How far each estimate is off, in half widths of its 95 percent interval."""
    true = truth(machine)
    estimates = {e.name: e for e in found.estimates}
    for name, value in true.items():
        estimate = estimates.get(name)
        if estimate is None or not estimate.determined:
            yield Finding(f"{machine}: {name} has no interval", 1.0, 0, "missing")
            continue
        low, high = estimate.interval
        off = abs(estimate.value - value) / (0.5 * (high - low))
        yield Finding(f"{machine}: {name} = {estimate.value:.5g}, truth {value:.5g}, off by half widths", off, 2, "")


def pictures() -> Mapping[str, Figure]:
    """The friction that was found on that of the machine."""
    from validation.rig_diagnosis.friction_figure import friction_figure

    return {
        "The friction that the model lacked, as it was found, and as the machine has it; right: near standstill": (
            friction_figure(answer("shaft.friction"))
        ),
    }


def notes() -> Sequence[str]:
    """What stood in for what."""
    return (
        "The machine is the virtual bench: the same equations with other numbers, noise, and what the model lacks.",
    )
