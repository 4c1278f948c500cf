"""How long one case takes on an otherwise idle computer with two cores, and whether their number changes the answer."""

from __future__ import annotations

import time
from datetime import UTC, datetime

from pysim.diagnose import diagnose, subject
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.examine import SEED, code, warm
from validation.blind.plant import Case, measure

CORES = 2


def clock_case(case: Case) -> Answer:
    """Of any case, in this process, with a thread for each core; not judged."""
    shop, measured = warm(), measure(case)
    catalogue = tuple(effect for effect in shop.catalogue if effect.name not in case.left_out)
    given = subject(shop.model, measured.dataset, catalogue, shop.variant)
    compiled, wall, cpu = shop.seconds, time.monotonic(), time.process_time()
    found = diagnose(given, seed=SEED, workers=CORES)
    wall, cpu = time.monotonic() - wall - (shop.seconds - compiled), time.process_time() - cpu
    added = tuple(one.effect.name for one in found.added)
    return Answer(case.name, code(), datetime.now(UTC).date().isoformat(), found.verdict, added, wall=wall, cpu=cpu)
