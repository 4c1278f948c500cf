"""One case with an effect: where `locate` sees it, without naming it, and whether its band holds the true term."""

from __future__ import annotations

from typing import Any

from pysim.diagnose import located, subject
from pysim.diagnose.subject import Inside
from pysim.effects import STANDARD_LIBRARY, slots
from pysim.types import Missing
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.examine import code
from validation.blind.benchmark.slots import SLOTS
from validation.blind.benchmark.stopwatch import timed, today
from validation.blind.benchmark.terms import covered, true_term
from validation.blind.benchmark.workshop import BASE, workshop
from validation.blind.plant import Case, measure
from validation.blind.plant.effects import told


def locate_case(case: Case) -> Answer:
    """Of a case with one effect, in this process and with one thread."""
    shop = workshop()
    inside = Inside(slots(BASE, [STANDARD_LIBRARY]), shop.probed)
    given = subject(shop.model, measure(case).dataset, shop.catalogue, shop.variant, inside=inside)
    with timed(shop) as spent:
        found = located(given, workers=1).missing
    return Answer(case.name, code(places=True), today(), wall=spent.wall, cpu=spent.cpu, **judged(case, found))


def judged(case: Case, found: tuple[Missing, ...]) -> dict[str, Any]:
    """Fields of an answer: the first place, those tied with it, and what is told of the right one."""
    (name, _), *_ = case.effects
    if not found:
        return {"trouble": "no place could be looked at"}
    first = found[0]
    fields: dict[str, Any] = {"slot": first.slot, "alike": first.alike}
    right = next((row for row in found if row.slot == SLOTS[name]), None)
    if right is None:
        return fields
    fields |= {"rank": found.index(right) + 1, "over": right.depends_on, "share": right.share, "said": right.formula}
    true = case.parameters()
    stretch = right.parameters.get("L", true.L) / true.L
    truth = true_term(name, told(name, case.strengths()), right, stretch)
    return fields if truth is None else {**fields, "cover": covered(right, truth)}
