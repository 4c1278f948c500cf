"""One case from beginning to end: measured, diagnosed, judged."""

from __future__ import annotations

from functools import cache

from pysim.diagnose import diagnose, subject
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.fingerprint import fingerprint
from validation.blind.benchmark.judged import judged
from validation.blind.benchmark.stopwatch import timed, today
from validation.blind.benchmark.truth import Truth
from validation.blind.benchmark.workshop import Workshop, workshop
from validation.blind.plant import Case, measure

SEED = 0  # of the diagnosis


def examine(case: Case) -> Answer:
    """The answer to one case, in this process and with one thread."""
    shop = warm()
    measured = measure(case)
    catalogue = tuple(effect for effect in shop.catalogue if effect.name not in case.left_out)
    with timed(shop) as spent:
        found = diagnose(subject(shop.model, measured.dataset, catalogue, shop.variant), seed=SEED, workers=1)
    return Answer(
        case.name,
        code(),
        today(),
        found.verdict,
        tuple(one.effect.name for one in found.added),
        tuple(candidate.effect for candidate in found.ranking if candidate.round == 1)[:2],
        found.confusable,
        wall=spent.wall,
        cpu=spent.cpu,
        **judged(Truth(case, measured, shop), found),
    )


@cache
def code(*, places: bool = False) -> str:
    """The fingerprint of this process' code, from when it began."""
    return fingerprint(places=places)


@cache
def warm() -> Workshop:
    """Every effect compiled, so that no case waits for it."""
    shop = workshop()
    for effect in shop.catalogue:
        shop.variant([effect])
    return shop
