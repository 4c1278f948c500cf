"""One case from beginning to end: measured, diagnosed, judged."""

from __future__ import annotations

import time
from datetime import UTC, datetime
from functools import cache

from pysim.diagnose import diagnose, subject
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.fingerprint import fingerprint
from validation.blind.benchmark.judged import judged
from validation.blind.benchmark.truth import Truth
from validation.blind.benchmark.workshop import Workshop, workshop
from validation.blind.plant import Case, measure

SEED = 0  # of the diagnosis


def examine(case: Case) -> Answer:
    """The answer to one case, in this process and with one thread."""
    shop = warm()
    measured = measure(case)
    catalogue = tuple(effect for effect in shop.catalogue if effect.name not in case.left_out)
    compiled, wall, cpu = shop.seconds, time.monotonic(), time.process_time()
    found = diagnose(subject(shop.model, measured.dataset, catalogue, shop.variant), seed=SEED, workers=1)
    wall, cpu = time.monotonic() - wall - (shop.seconds - compiled), time.process_time() - cpu
    return Answer(
        case.name,
        code(),
        datetime.now(UTC).date().isoformat(),
        found.verdict,
        tuple(one.effect.name for one in found.added),
        tuple(candidate.effect for candidate in found.ranking if candidate.round == 1)[:2],
        found.confusable,
        wall=wall,
        cpu=cpu,
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
