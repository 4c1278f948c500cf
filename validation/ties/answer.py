"""One plant, diagnosed from a short log; where that gives a tie, again with the test that the tie came with."""

from __future__ import annotations

import sys
import time

import numpy as np

from pysim.diagnosis import diagnose
from pysim.present.diagnosis.words import next_test_sentence
from pysim.types.answer import Diagnosis
from validation.batch import Line, serve
from validation.ties.plant import KINDS, drawn

COUNT = 150
_SEED = 60_000  # of the first; nothing else is drawn from these
_SECONDS = (2.0, 4.0)  # of the short log, uniform
_PLANTS = [(kind, effect) for kind, own in KINDS.items() for effect in own.sizes]


def names(count: int = COUNT) -> list[str]:
    """number-effect, all effects in turn."""
    return [f"{k:03d}-{_PLANTS[k % len(_PLANTS)][1]}" for k in range(count)]


def answer(name: str) -> Line:
    """The tie, "" where there was none; the test, and what is named and tied once it was run."""
    number = int(name.partition("-")[0])
    begun, rng = time.process_time(), np.random.default_rng(_SEED + number)
    plant = drawn(*_PLANTS[number % len(_PLANTS)], rng)
    data = plant.first_log(rng, float(rng.uniform(*_SECONDS)))
    found = diagnose(plant.session(data))
    line: dict[str, object] = {"tie": _tie(found), "named": _named(found), "test": "", "right": False, "settled": False}
    if line["tie"] and found.next_test is not None:
        after = diagnose(plant.session(plant.tested(data, found.next_test.plan, number)))
        right = _named(after)[:1] == [plant.effect]
        line |= {"test": next_test_sentence(found.next_test), "after": _named(after), "tied": _tie(after)}
        line |= {"right": right, "settled": right and not any(plant.effect in group for group in after.ties)}
    return {**line, "cpu": round(time.process_time() - begun, 2)}


def _named(found: Diagnosis) -> list[str]:
    return [one.effect.name for one in found.effects]


def _tie(found: Diagnosis) -> str:
    return "; ".join(" | ".join(group) for group in found.ties)


if __name__ == "__main__":
    serve(answer, sys.argv[1:])
