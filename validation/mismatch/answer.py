"""What is asked of a diagnosis, and the one place that asks it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from pysim.diagnose import diagnose, subject
from pysim.types import Model
from validation.mismatch.tasks import Task


@dataclass(frozen=True)
class Step:
    """The model at one step.

    Args:
        name: "refit" of the base model, or the effects that the step added.
        model: with the effects so far.
        values: its parameters, by their names there.
    """

    name: str
    model: Model
    values: Mapping[str, float]


@dataclass(frozen=True)
class Answer:
    """A diagnosis.

    Args:
        effects: names, the one whose leaving-out costs most first.
        complete: whether nothing else is missing; None where that was not answered.
        steps: from the refitted base model to the last effect.
    """

    effects: tuple[str, ...]
    complete: bool | None
    steps: tuple[Step, ...]


def answer(task: Task) -> Answer:
    """Diagnose a task without the logs that are withheld."""
    found = diagnose(subject(task.model, task.given, task.catalogue, task.build), seed=0)
    steps: list[Step] = []
    for stage in found.stages[1:]:  # the first is the untouched model
        added = [one.effect for one in found.added[: len(steps)]]
        steps.append(Step(stage.step, task.build(added)[0], {e.name: e.value for e in stage.estimates}))
    return Answer(tuple(one.effect.name for one in found.added), None, tuple(steps))
