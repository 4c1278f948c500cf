"""A class asked about as its user asks, and the model of every step of the answer as they take it away."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory

from pysim.diagnosis import Session
from pysim.effects import fitting, read_catalogue
from pysim.identify.greybox.workers import Threads
from pysim.types import Dataset, Effect, Model
from pysim.types.answer import Diagnosis, SensorError
from pysim.workflow import Variants, open_session, with_standard
from pysim.workflow.learned import with_classes, with_laws


@dataclass(frozen=True)
class Subject:
    """A class that may lack something.

    Args:
        class_name: full name of the Modelica class.
        libraries: where it and its effects are, beside the one that comes along.
    """

    class_name: str
    libraries: tuple[Path, ...] = ()

    @cached_property
    def variants(self) -> Variants:
        """It with effects, each built once."""
        return Variants(self.class_name, tuple(with_standard(self.libraries)))

    @cached_property
    def model(self) -> Model:
        """It alone."""
        return self.variants.build(())[0]

    @cached_property
    def catalogue(self) -> tuple[Effect, ...]:
        """What its slots take."""
        libraries = self.variants.libraries
        return fitting(read_catalogue(*libraries), self.class_name, libraries)

    def session(self, dataset: Dataset, left_out: Sequence[str] = (), workers: int | None = None) -> Session:
        """What a diagnosis of these measurements takes.

        Args:
            left_out: effects that it must not know of.
            workers: threads; all cores where None.
        """
        names = [effect.name for effect in self.catalogue if effect.name not in left_out]
        opened = open_session(self.class_name, dataset, library=self.libraries, effects=names)
        return replace(opened, workers=Threads(workers))

    def whole(self, found: Diagnosis) -> Diagnosis:
        """An answer with the classes of its laws."""
        return with_classes(found, self.class_name, self.variants.libraries)


PUMP = Subject("HydraulicTestBench.Pump.FreeGreyBox")


@dataclass(frozen=True)
class Step:
    """The model at one step.

    Args:
        name: "refit" of the base model, or what the step added.
        model: with everything so far.
        values: its parameters, by their names there.
        sensors: errors of sensors that it has.
    """

    name: str
    model: Model
    values: Mapping[str, float]
    sensors: tuple[SensorError, ...] = ()


def steps_of(found: Diagnosis, subject: Subject) -> tuple[Step, ...]:
    """From the refitted base model to the last one, which has the learned laws.

    Args:
        found: with the classes of its laws.
    """
    by_name = {one.effect.name: one.effect for one in found.effects if one.effect.class_name}
    steps, effects, variants = list[Step](), list[Effect](), subject.variants
    of_one_law = {step.step for step in found.history[-len(found.learned) : -1]} if found.learned else set()
    for k, step in enumerate(found.history[1:], start=2):  # the first is the untouched model
        if step.step in of_one_law:
            continue
        with TemporaryDirectory(prefix="asked-") as folder:
            if k == len(found.history) and found.learned:
                effects, variants = with_laws(found, variants, Path(folder))
            elif steps:
                effects += [by_name[name] for name in step.step.split(" + ") if name in by_name]
            model, _ = variants.build(effects)
        known = {variable.name for variable in model.variables}
        values = {one.name: one.value for one in step.estimates if one.name in known}
        steps.append(Step(step.step, model, values, step.sensors))
    return tuple(steps)
