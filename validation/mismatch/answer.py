"""What is asked of a diagnosis, and the one place that asks it."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.diagnosis import diagnose
from validation.asked import Step, steps_of
from validation.mismatch.tasks import Task


@dataclass(frozen=True)
class Answer:
    """A diagnosis.

    Args:
        effects: names, the one whose leaving-out costs most first.
        complete: whether nothing else is missing; None where that was not answered.
        steps: from the refitted base model to the last effect or law.
        learned: places of laws that were learned.
    """

    effects: tuple[str, ...]
    complete: bool | None
    steps: tuple[Step, ...]
    learned: tuple[str, ...] = ()


def answer(task: Task) -> Answer:
    """Diagnose a task without the logs that are withheld."""
    found = task.subject.whole(diagnose(task.subject.session(task.given)))
    names, laws = tuple(one.effect.name for one in found.effects), tuple(law.slot for law in found.learned)
    return Answer(names, found.all_named, steps_of(found, task.subject), laws)
