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
        learned: place, factor and argument of laws that were learned.
    """

    effects: tuple[str, ...]
    complete: bool | None
    steps: tuple[Step, ...]
    learned: tuple[str, ...] = ()


def answer(task: Task, *, named: bool = True) -> Answer:
    """Diagnose a task without the logs that are withheld.

    Args:
        named: False withholds the catalogue too, so that only laws can be learned.
    """
    left_out = () if named else [effect.name for effect in task.subject.catalogue]
    found = task.subject.whole(diagnose(task.subject.session(task.given, left_out)))
    names = tuple(one.effect.name for one in found.effects)
    laws = tuple(f"{law.slot}, {str(law.factor) and f'{law.factor}*'}h({law.argument})" for law in found.learned)
    return Answer(names, found.all_named, steps_of(found, task.subject), laws)
