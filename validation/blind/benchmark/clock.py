"""How long one case takes on an otherwise idle computer with two cores, and whether their number changes the answer."""

from __future__ import annotations

from pysim.diagnose import diagnose, subject
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.examine import SEED, code, warm
from validation.blind.benchmark.stopwatch import timed, today
from validation.blind.plant import Case, measure

CORES = 2


def clock_case(case: Case) -> Answer:
    """Of any case, in this process, with a thread for each core; not judged."""
    shop, measured = warm(), measure(case)
    catalogue = tuple(effect for effect in shop.catalogue if effect.name not in case.left_out)
    given = subject(shop.model, measured.dataset, catalogue, shop.variant)
    with timed(shop) as spent:
        found = diagnose(given, seed=SEED, workers=CORES)
    added = tuple(one.effect.name for one in found.added)
    return Answer(case.name, code(), today(), found.verdict, added, wall=spent.wall, cpu=spent.cpu)
