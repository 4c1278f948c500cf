"""What is kept of one case: the diagnosis' answer and how near it came to the truth; a file of JSON for each."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from pysim.io import write_file

_DIGITS = 6


@dataclass(frozen=True)
class Answer:
    """One case, answered and judged. Errors are root mean squares over the noise, of all held-out samples.

    Args:
        case: its name in the table.
        verdict: "" where there is none.
        added: effects, in order.
        ranking: the first two candidates for the base model.
        confusable: groups of effects that the answer says it cannot tell apart.
        detectability: sum of squares over the noise that the refitted base model leaves of the noise-free readings.
        residual: of the final model against the measurements.
        base, final: error against the noise-free truth, of the refitted base model and of the final one.
        bound: the same error of the true model with parameters as uncertain as Cramer and Rao allow.
        determined: intervals of the final model that could be looked at.
        missed: parameters whose interval does not hold the truth.
        wall, cpu: s of the diagnosis, models compiled.
        trouble: why there is no verdict.
    """

    case: str
    verdict: str = ""
    added: tuple[str, ...] = ()
    ranking: tuple[str, ...] = ()
    confusable: tuple[tuple[str, ...], ...] = ()
    detectability: float | None = None
    residual: float | None = None
    base: float | None = None
    final: float | None = None
    bound: float | None = None
    determined: int = 0
    missed: tuple[str, ...] = ()
    wall: float = 0.0
    cpu: float = 0.0
    trouble: str = ""


def write_answer(folder: Path, answer: Answer) -> None:
    """As `folder`/case.json, whole or not at all; numbers of six digits."""
    folder.mkdir(parents=True, exist_ok=True)
    short = {name: float(f"{v:.{_DIGITS}g}") if isinstance(v, float) else v for name, v in asdict(answer).items()}
    write_file(folder / f"{answer.case}.json", json.dumps(short, allow_nan=False, indent=1) + "\n")


def read_answers(folder: Path) -> dict[str, Answer]:
    """Case -> answer, of all that the folder holds; none where it is not there."""
    return {path.stem: _read(json.loads(path.read_text(encoding="utf-8"))) for path in sorted(folder.glob("*.json"))}


def _read(given: Mapping[str, Any]) -> Answer:
    return Answer(**{name: _tuples(value) for name, value in given.items()})


def _tuples(value: Any) -> Any:
    return tuple(_tuples(part) for part in value) if isinstance(value, list) else value
