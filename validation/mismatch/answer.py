"""What is asked of a diagnosis, and the one place that asks it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from pysim.diagnosis import diagnose, session
from pysim.types import Model
from pysim.types.answer import SensorError
from validation.mismatch.tasks import Task


@dataclass(frozen=True)
class Step:
    """The model at one step.

    Args:
        name: "refit" of the base model, or the effects that the step added.
        model: with the effects so far.
        values: its parameters, by their names there.
        sensors: errors of sensors that it has.
    """

    name: str
    model: Model
    values: Mapping[str, float]
    sensors: tuple[SensorError, ...] = ()


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
    found = diagnose(session(task.model, task.given, task.catalogue, task.build))
    effects = {one.effect.name: one.effect for one in found.effects if one.effect.class_name}
    steps: list[Step] = []
    names: list[str] = []
    for step in found.history[1:]:  # the first is the untouched model
        if steps:
            names += step.step.split(" + ")
        built = task.build([effects[name] for name in names if name in effects])[0]
        steps.append(Step(step.step, built, {e.name: e.value for e in step.estimates}, step.sensors))
    return Answer(tuple(one.effect.name for one in found.effects), found.complete, tuple(steps))
