"""One case from beginning to end: measured, diagnosed, held against the truth, and kept as a line."""

from __future__ import annotations

import sys
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from pysim.diagnosis import diagnose
from pysim.types import BadInput, Record
from pysim.types.answer import Diagnosis, ErrorStep
from validation.asked import PUMP
from validation.batch import Line, serve
from validation.blind.plant import FEW_SINES, Case, Measured, cases, measure

_COLUMNS = ("alphaPercent", "u")


@dataclass(frozen=True)
class Answer:
    """What is kept of one case.

    Args:
        kind: "none" | "named" | "beyond" | "left-out" | "pair".
        truth: effects in force, whether or not the catalogue has them.
        nuisances: kinds of nuisance in force.
        named: effects of the catalogue that the diagnosis names, in its order.
        sensors: sensor errors that it names.
        learned: places of laws that it learned.
        second: the best two effects beside the refitted base model.
        ties: groups of names that it cannot tell apart.
        complete: whether it says that nothing else is missing.
        held_out: rms over the stated noise of the held-out logs, by step of the error history.
        detectability: squares over noise by which the refitted base model is off the noise-free fitted readings.
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
    held_out: Mapping[str, float] | None = None
    detectability: float | None = None
    cpu: float = 0.0
    wall: float = 0.0
    stages: Mapping[str, float] | None = None
    trouble: str = ""

    @property
    def refuses(self) -> bool:
        """Whether it says that something is missing which has no name."""
        return not (self.trouble or self.named) and (bool(self.learned) or not self.complete)

    def __str__(self) -> str:
        if self.trouble:
            return f"{self.case}: {self.trouble}"
        truth, named, ties = (
            ", ".join(names) or "-" for names in (self.truth, (*self.named, *self.sensors), map("|".join, self.ties))
        )
        error = " -> ".join(f"{value:.3f}" for value in (self.held_out or {}).values())
        said = "complete" if self.complete else "more is missing"
        where = f"; learned at {', '.join(self.learned)}" if self.learned else ""
        return (
            f"{self.case}: truth {truth}; named {named}{where}; tied {ties}; {said}; held out {error}; "
            f"detectability {self.detectability or 0:.3g}; {self.cpu:.0f} CPU s, {self.wall:.0f} s"
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
    measured = measure(case)
    return asdict(replace(examine(case, _few(measured) if few else measured), case=name))


def _few(measured: Measured) -> Measured:
    """Waves, chirp, and eight of the sines."""
    data = measured.dataset
    records = tuple(r for r in data.records if r.frequency is None or r.source in FEW_SINES)
    return replace(measured, dataset=replace(data, records=records))


def examine(case: Case, measured: Measured) -> Answer:
    """The answer to one case, in this process and with one thread."""
    wall, cpu = time.monotonic(), time.process_time()
    found = diagnose(PUMP.session(measured.dataset, case.left_out, workers=1))
    wall, cpu = time.monotonic() - wall, time.process_time() - cpu
    return Answer(
        case.name,
        case.kind,
        tuple(name for name, _ in case.effects),
        case.nuisances,
        **_said(found),
        held_out={step.step: _held_out(step, measured) for step in found.history},
        detectability=_detectability(found.history[1], measured),
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
        "complete": found.complete,
    }


def _held_out(step: ErrorStep, measured: Measured) -> float:
    """Root mean square of measured minus simulated over the stated noise."""
    noise = {signal.name: signal.deviation for signal in measured.dataset.signals if signal.role == "output"}
    rows = [
        (record.measured.values - record.simulated.values) / [noise[name] for name in record.measured.names]
        for record in step.records
        if record.use == "validate"
    ]
    return round(float(np.sqrt(np.mean(np.concatenate([row.ravel() for row in rows]) ** 2))), 4)


def _detectability(base: ErrorStep, measured: Measured) -> float:
    """Sum of squares over the noise, of all samples that were fitted: of stepped sines, once they have settled."""
    noise, total = {signal.name: signal.deviation for signal in measured.dataset.signals}, 0.0
    times = {log.source: log.data.time for log in measured.dataset.records if isinstance(log.data, Record)}
    for record in base.records:
        if record.use == "fit":
            fitted = np.isin(times[record.source], record.measured.time)
            clean = dict(zip(_COLUMNS, measured.clean[record.source][fitted].T, strict=True))
            for name, simulated in zip(record.simulated.names, record.simulated.values.T, strict=True):
                total += float(np.sum(((simulated - clean[name]) / noise[name]) ** 2))
    return float(f"{total:.4g}")


if __name__ == "__main__":
    serve(answer, sys.argv[1:])
