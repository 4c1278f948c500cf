"""One case from beginning to end: measured, diagnosed, held against the truth, and kept as a line."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from pysim.diagnosis import diagnose
from pysim.types import BadInput, Record
from pysim.types.answer import Diagnosis, ErrorStep
from validation.asked import PUMP, Step, steps_of
from validation.batch import Line, serve
from validation.blind.plant import FEW_SINES, UNSEEN, Case, Measured, cases, measure
from validation.held_out import held_out_rms

_COLUMNS = ("alphaPercent", "u")


@dataclass(frozen=True)
class Answer:
    """What is kept of one case.

    Args:
        kind: "none" | "named" | "shaped" | "beyond" | "left-out" | "pair".
        truth: right names of the effects in force, whether or not the catalogue has them.
        nuisances: kinds of nuisance in force.
        named: effects of the catalogue that the diagnosis names, in its order.
        sensors: sensor errors that it names.
        learned: places of laws that it learned.
        second: the best two effects beside the refitted base model.
        ties: groups of names that it cannot tell apart.
        complete: whether it says that nothing else is missing.
        errors: step -> error of its model on the wave that the diagnosis was not given, against the readings without
            noise and over the noise, root mean square; none of a model that cannot be simulated there.
        detectability: squares over noise by which the refitted base model is off the noise-free fitted readings.
        remaining: the same of the model with all that was found.
        cpu, wall: s of the diagnosis, one thread, compiling included.
        stages: wall time of each of its stages, s.
        trouble: why there is no answer.
    """

    case: str
    kind: str = ""
    truth: tuple[str, ...] = ()
    nuisances: tuple[str, ...] = ()
    named: tuple[str, ...] = ()
    sensors: tuple[str, ...] = ()
    learned: tuple[str, ...] = ()
    second: tuple[str, ...] = ()
    ties: tuple[tuple[str, ...], ...] = ()
    complete: bool = False
    errors: Mapping[str, float | None] | None = None
    detectability: float | None = None
    remaining: float | None = None
    cpu: float = 0.0
    wall: float = 0.0
    stages: Mapping[str, float] | None = None
    trouble: str = ""

    @property
    def refuses(self) -> bool:
        """Whether it says that something is missing which has no name."""
        return not (self.trouble or self.named) and (bool(self.learned) or not self.complete)

    @property
    def residuals(self) -> tuple[float, ...]:
        """Of each step on that wave as it would be logged: the noise counts too, and a model that fails is infinite."""
        return tuple(math.inf if one is None else math.hypot(1.0, one) for one in (self.errors or {}).values())

    def __str__(self) -> str:
        if self.trouble:
            return f"{self.case}: {self.trouble}"
        truth, named, ties = (
            ", ".join(names) or "-" for names in (self.truth, (*self.named, *self.sensors), map("|".join, self.ties))
        )
        steps = " -> ".join(f"{one:.3f}" for one in self.residuals)
        said = "complete" if self.complete else "more is missing"
        where = f"; learned at {', '.join(self.learned)}" if self.learned else ""
        return (
            f"{self.case}: truth {truth}; named {named}{where}; tied {ties}; {said}; unseen {steps}; "
            f"detectability {self.detectability or 0:.3g}, then {self.remaining or 0:.3g}; "
            f"{self.cpu:.0f} CPU s, {self.wall:.0f} s"
        )


def read_answer(line: Line) -> Answer:
    """The answer of a line."""
    return Answer(**{name: _tuples(value) for name, value in line.items()})


def _tuples(value: Any) -> Any:
    return tuple(_tuples(part) for part in value) if isinstance(value, list) else value


def answer(name: str) -> Line:
    """The line of a case, "seed/name", or "seed-few/name" where only a few of its sines are given."""
    table, _, own = name.partition("/")
    seed, _, few = table.partition("-")
    case = next((case for case in cases(int(seed)) if case.name == own), None)
    if case is None:
        raise BadInput(f"the table of seed {seed} has no case {own}; --names finds some by a pattern")
    return asdict(replace(examine(case, measure(case), few=bool(few)), case=name))


def examine(case: Case, measured: Measured, *, few: bool = False) -> Answer:
    """The answer to one case, in this process and with one thread.

    Args:
        few: whether only a few of the sines are given.
    """
    records = [r for r in measured.dataset.records if r.source != UNSEEN]
    given = tuple(r for r in records if not few or r.frequency is None or r.source in FEW_SINES)
    wall, cpu = time.monotonic(), time.process_time()
    found = diagnose(PUMP.session(replace(measured.dataset, records=given), case.left_out, workers=1))
    wall, cpu = time.monotonic() - wall, time.process_time() - cpu
    return Answer(
        case.name,
        case.kind,
        tuple(name.partition("~")[0] for name, _ in case.effects),
        case.nuisances,
        **_said(found),
        errors={step.name: _error(step, measured) for step in steps_of(PUMP.whole(found), PUMP)},
        detectability=_detectability(found.history[1], measured),
        remaining=_detectability(found.history[-1], measured),
        wall=round(wall, 1),
        cpu=round(cpu, 1),
        stages={name: round(seconds, 1) for name, seconds in found.seconds.items()},
    )


def _said(found: Diagnosis) -> dict[str, Any]:
    """What the diagnosis says."""
    beside_base = [rival.effects[0] for rival in found.rivals if len(rival.effects) == 1]
    return {
        "named": tuple(one.effect.name for one in found.effects if one.effect.class_name),
        "sensors": tuple(one.effect.name for one in found.effects if not one.effect.class_name),
        "learned": tuple(law.slot for law in found.learned),
        "second": tuple(dict.fromkeys(beside_base))[:2],
        "ties": found.ties,
        "complete": found.all_named,
    }


def _error(step: Step, measured: Measured) -> float | None:
    """Of one step's model on the wave that was not given."""
    data, clean = measured.dataset, measured.clean[UNSEEN]
    (wave,) = (r for r in data.records if r.source == UNSEEN)
    assert isinstance(wave.data, Record)
    names = wave.data.names
    values = wave.data.values.copy()
    for name, column in zip(_COLUMNS, clean.T, strict=True):
        if name in names:
            values[:, names.index(name)] = column
    unseen = replace(data, records=(replace(wave, use="test", data=replace(wave.data, values=values)),))
    try:
        sizes = held_out_rms(step.model, unseen, step.values, sensors=step.sensors)
    except BadInput:
        return None
    own = [(size / measured.deviation[name]) ** 2 for name, size in sizes.items()]
    return round(math.sqrt(sum(own) / len(own)), 4)


def _detectability(step: ErrorStep, measured: Measured) -> float:
    """Sum of squares over the noise, of all samples that were fitted: of stepped sines, once they have settled."""
    total = 0.0
    times = {log.source: log.data.time for log in measured.dataset.records if isinstance(log.data, Record)}
    for record in step.records:
        if record.use == "fit":
            fitted = np.isin(times[record.source], record.measured.time)
            clean = dict(zip(_COLUMNS, measured.clean[record.source][fitted].T, strict=True))
            for name, simulated in zip(record.simulated.names, record.simulated.values.T, strict=True):
                total += float(np.sum(((simulated - clean[name]) / measured.deviation[name]) ** 2))
    return float(f"{total:.4g}")


if __name__ == "__main__":
    serve(answer, sys.argv[1:])
