"""The diagnosis of the thesis' test bench: its linear friction is not enough (Section 5.5), and it is told so."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING

from pysim.diagnose import diagnose
from pysim.types import Diagnosis
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
        named = ", ".join(effect.effect.name for effect in found.added) or found.verdict
        yield Finding(f"{machine}: answered with {named}", float(named != machine), 0, "wrong")
        yield from _errors(machine, found)
        yield from _numbers(machine, found)


@cache
def answer(machine: str) -> Diagnosis:
    """The diagnosis of a machine's logs."""
    return diagnose(asked(measured(machine, SEED)), seed=SEED)


def _errors(machine: str, found: Diagnosis) -> Iterator[Finding]:
    steps = {step.step: step for step in found.error}
    refit, last = steps["refit"], found.error[-1]
    for what, before, after in (("fitted", refit.fit, last.fit), ("held out", refit.validate, last.validate)):
        assert before is not None
        assert after is not None
        yield Finding(f"{machine}: residual over noise at the end, {what}", after, 1.05, "")
        if machine != _NONE:
            yield Finding(f"{machine}: the same over that of the refitted model, {what}", after / before, 0.3, "")


def _numbers(machine: str, found: Diagnosis) -> Iterator[Finding]:
    """How far each estimate is off, in half widths of its 95 percent interval."""
    true = truth(machine)
    estimates = {e.name: e for e in found.parameters}
    for added in found.added:
        estimates |= {f"{added.place}.{e.name}": e for e in added.estimates}
    for name, value in true.items():
        estimate = estimates.get(name)
        if estimate is None or estimate.interval is None:
            yield Finding(f"{machine}: {name} has no interval", 1.0, 0, "missing")
            continue
        low, high = estimate.interval
        off = abs(estimate.value - value) / (0.5 * (high - low))
        yield Finding(f"{machine}: {name} = {estimate.value:.5g}, truth {value:.5g}, off by half widths", off, 2, "")


def pictures() -> Mapping[str, Figure]:
    """The staircase of the error, and the friction that was found on that of the machine."""
    from pysim.present.diagnosis import diagnosis_ledger_figure
    from validation.rig_diagnosis.friction_figure import friction_figure

    found = answer("shaft.friction")
    return {
        "Error over noise: the model as it is, refitted, and with the friction that the diagnosis added": (
            diagnosis_ledger_figure(found.error)
        ),
        "The friction that the model lacked, as it was found, and as the machine has it; right: near standstill": (
            friction_figure(found)
        ),
    }


def notes() -> Sequence[str]:
    """What stood in for what."""
    return (
        "The machine is the virtual bench: the same equations with other numbers, noise, and what the model lacks.",
    )
