"""Answers to the sixteen data sets, kept as text."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from fmu_build.version import this_commit
from pysim.diagnosis import diagnose
from pysim.io import write_file
from pysim.types.answer import Diagnosis
from validation.asked import PUMP
from validation.diagnosis.intervals import named
from validation.diagnosis.sets import read_set

ANSWERS = Path(__file__).parent / "answers.json"


@dataclass(frozen=True)
class Kept:
    """What is kept of one answer; numbers of four digits.

    Args:
        verdict, added, ties: as answered.
        values: "effect: parameter" -> estimate and 95 percent interval, in the unit of the class.
        fit, validate: residual over noise of the refitted base model and of the final one.
        commit, day: of the checkout that answered, "" where that was not noted, and when.
    """

    verdict: str
    added: tuple[str, ...]
    ties: tuple[tuple[str, ...], ...]
    values: Mapping[str, tuple[float, float, float]]
    fit: tuple[float, float]
    validate: tuple[float, float]
    commit: str
    day: str


def answered(name: str, workers: int | None = None) -> Diagnosis:
    """Diagnose that set with the base model and the whole catalogue."""
    return diagnose(PUMP.session(read_set(name), workers=workers))


def kept(found: Diagnosis) -> Kept:
    """The part of a diagnosis that is stored."""
    values = {}
    for added in named(found):
        for parameter, estimate in zip(added.effect.parameters, added.estimates, strict=True):
            row = (estimate.value, *estimate.interval)
            values[f"{added.effect.name}: {parameter.name}"] = (_short(row[0]), _short(row[1]), _short(row[2]))
    base, last = found.history[1], found.history[-1]
    return Kept(
        found.verdict,
        tuple(added.effect.name for added in named(found)),
        found.ties,
        values,
        (_short(base.fit), _short(last.fit)),
        (_short(base.validate), _short(last.validate)),
        this_commit(),
        datetime.now(UTC).date().isoformat(),
    )


def _short(value: float | None) -> float:
    return float(f"{value or 0.0:.4g}")


def read_answers(path: Path = ANSWERS) -> dict[str, Kept]:
    """Set -> its stored answer; empty where nothing is stored."""
    given: dict[str, dict[str, Any]] = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    return {name: Kept(**{key: _tuples(value) for key, value in row.items()}) for name, row in given.items()}


def write_answers(answers: Mapping[str, Kept], path: Path = ANSWERS) -> None:
    """In the order of their names, a line per answer."""
    rows: Iterable[str] = (f' "{name}": {json.dumps(asdict(answers[name]))}' for name in sorted(answers))
    write_file(path, "{\n" + ",\n".join(rows) + "\n}\n")


def _tuples(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _tuples(part) for name, part in value.items()}
    return tuple(_tuples(part) for part in value) if isinstance(value, list) else value
