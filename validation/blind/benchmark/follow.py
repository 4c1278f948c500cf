"""A case that ends in a tie: the next test carried out on the virtual bench, and the diagnosis with its logs."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from pysim.bench import read_plan, run_plan
from pysim.diagnose import diagnose, subject
from pysim.types import Dataset, Diagnosis, NextTest
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.examine import SEED, code, warm
from validation.blind.benchmark.stopwatch import timed, today
from validation.blind.benchmark.truth import Truth
from validation.blind.plant import Case, measure


def ties(cases: Sequence[Case], answers: Mapping[str, Answer]) -> list[Case]:
    """Those that were answered by effects that their measurements do not tell apart; not those without an answer.

    Args:
        answers: case -> what the diagnosis made of it.
    """
    return [case for case in cases if case.name in answers and answers[case.name].confusable]


def follow_case(case: Case) -> Answer:
    """Of a case with one effect, in this process and with one thread."""
    shop, measured = warm(), measure(case)

    def answered(dataset: Dataset) -> Diagnosis:
        return diagnose(subject(shop.model, dataset, shop.catalogue, shop.variant), seed=SEED, workers=1)

    with timed(shop) as spent:
        found = answered(measured.dataset)
        fields: dict[str, Any] = {"verdict": found.verdict, "confusable": found.confusable}
        if found.next_test is not None:
            more = carried_out(Truth(case, measured, shop), found.next_test)
            again = answered(joined(measured.dataset, more))
            alone = not any(again.verdict in group for group in again.confusable)
            settled = alone and (again.verdict,) == case.expected
            fields |= {"rivals": found.next_test.separates, "after": again.verdict, "settled": settled}
    return Answer(case.name, code(), today(), wall=spent.wall, cpu=spent.cpu, **fields)


def carried_out(truth: Truth, test: NextTest) -> Dataset:
    """What the virtual bench logs of the model with the case's effect, at its true numbers."""
    effects = [truth.shop.effect(name) for name, _ in truth.case.effects]
    model, places = truth.shop.variant(effects)
    values = dict(truth.base)
    for effect in effects:
        values |= {f"{places[effect.name]}.{name}": value for name, value in truth.strengths(effect).items()}
    with tempfile.TemporaryDirectory(prefix="next-test-") as folder:
        path = Path(folder) / "plan.toml"
        path.write_text(test.plan, encoding="utf-8")
        plan = read_plan(path)
    return run_plan(model, plan, truth.case.seed, parameters=values, workers=1).dataset


def joined(dataset: Dataset, more: Dataset) -> Dataset:
    """Both tests' logs, and what either of them logs."""
    known = {signal.name for signal in dataset.signals}
    signals = (*dataset.signals, *(signal for signal in more.signals if signal.name not in known))
    records = tuple(replace(record, source=f"next/{record.source}") for record in more.records)
    return replace(dataset, signals=signals, records=(*dataset.records, *records))
