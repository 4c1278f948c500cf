"""An answer beside what is right: names, and the error of every step's model on the logs that were withheld."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

from validation.asked import Step
from validation.held_out import held_out_rms
from validation.mismatch.answer import Answer
from validation.mismatch.tasks import Task

RISE = 1.01  # times the error of the step before


@dataclass(frozen=True)
class Judged:
    """One row of the table.

    Args:
        task, answer: what was asked and answered.
        errors: on the logs withheld, a step each: over the noise, or in the signal's unit where no noise is known.
        wrong: what is wrong with the names; None where nobody knows the right ones.
    """

    task: Task
    answer: Answer
    errors: tuple[float, ...]
    wrong: tuple[str, ...] | None

    @property
    def rise(self) -> float:
        """Largest error of a step over that of the step before; 1 where there is one step."""
        return max((after / before for before, after in pairwise(self.errors)), default=1.0)

    def __str__(self) -> str:
        right = self.task.right
        sought = ", ".join("|".join(names) for names in right.order) if right else "?"
        sought = sought or ("unknown" if right and right.unknown else "none")
        said = {True: "complete", False: "more", None: "?"}[self.answer.complete]
        errors = " -> ".join(f"{error:.4g}" for error in self.errors) + (" RISES" if self.rise > RISE else "")
        best = "" if self.task.perfect is None else f" (true model {self.task.perfect:.3f})"
        verdict = "?" if self.wrong is None else "; ".join(self.wrong) or "right"
        named = ", ".join((*self.answer.effects, *(f"a law at {place}" for place in self.answer.learned))) or "nothing"
        return f"{self.task.name:<22} {sought:<42} named {named:<42} {said:<9} {errors}{best}  {verdict}"


def judged(task: Task, answer: Answer) -> Judged:
    """Hold an answer against the truth and the logs that it never saw."""
    errors = tuple(withheld_error(task, step) for step in answer.steps)
    wrong = None if task.right is None else tuple(task.right.wrong(answer.effects, answer.complete))
    return Judged(task, answer, errors, wrong)


def withheld_error(task: Task, step: Step) -> float:
    """Of one step's model: root mean square of all signals over their noise, or of the one signal in its unit."""
    sizes = held_out_rms(step.model, task.dataset, step.values, sensors=step.sensors)
    return math.sqrt(sum((size / task.noise.get(name, 1.0)) ** 2 for name, size in sizes.items()) / len(sizes))
