"""What is kept of one case: the diagnosis' answer and how near it came, small enough for a line of text."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import MISSING, Field, dataclass, field, fields
from typing import Any

DIGITS = 6


@dataclass(frozen=True)
class Answer:
    """One case, answered and judged. Errors are root mean squares over the noise, of all held-out samples.

    Args:
        case: its name in the table.
        code: fingerprint of what answered and judged it.
        day: on which it was answered, as year-month-day.
        verdict: "" where there is none.
        added: effects, in order.
        ranking: the first two candidates for the base model.
        confusable: groups that the answer says it cannot tell apart.
        footprint: sum of squares over noise that the base model leaves of the noise-free readings.
        parts: the same of each effect in force, once the base model has all others.
        held: residual of the final model on held-out records.
        base, final: error against the noise-free truth there, of the refitted base model and of the final one.
        bound: what Cramer and Rao allow, and
        floor: what the true model with the true parameters leaves there.
        determined: intervals of the final model that could be looked at, and
        missed: parameters whose interval does not hold the truth.
        slot: that the diagnosis located first, and
        alike: those tied with it.
        rank: of the effect's own slot among all places, 1 for the first, 0 where it was not looked at.
        over, share, said: what the term at that slot depends on, its share of the misfit, its formula.
        cover: share of its range in which that term's band holds the true one; None where it is no function of that.
        rivals: two that were tied, and that the next test is to separate,
        after: the verdict once it was carried out,
        settled: whether that is the right effect, alone.
        wall, cpu: s of the diagnosis, models compiled.
        trouble: why there is no verdict.
    """

    case: str
    code: str
    day: str
    verdict: str = ""
    added: tuple[str, ...] = ()
    ranking: tuple[str, ...] = ()
    confusable: tuple[tuple[str, ...], ...] = ()
    footprint: float | None = None
    parts: Mapping[str, float | None] = field(default_factory=dict)
    held: float | None = None
    base: float | None = None
    final: float | None = None
    bound: float | None = None
    floor: float | None = None
    determined: int = 0
    missed: tuple[str, ...] = ()
    slot: str = ""
    alike: tuple[str, ...] = ()
    rank: int = 0
    over: str = ""
    share: float | None = None
    said: str = ""
    cover: float | None = None
    rivals: tuple[str, ...] = ()
    after: str = ""
    settled: bool | None = None
    wall: float = 0.0
    cpu: float = 0.0
    trouble: str = ""

    def line(self) -> str:
        """As JSON on one line, without what is empty, numbers of six digits."""
        kept = {f.name: _plain(getattr(self, f.name)) for f in fields(self) if not self._usual(f)}
        return json.dumps(kept, separators=(",", ":"), allow_nan=False)

    def _usual(self, f: Field[Any]) -> bool:
        """Whether that field says nothing."""
        empty = {} if f.default_factory is not MISSING else f.default
        return bool(getattr(self, f.name) == empty)

    @classmethod
    def read(cls, line: str) -> Answer:
        """The answer of a line.

        Raises:
            ValueError: no JSON, or not an answer.
        """
        given = json.loads(line)
        unknown = set(given) - {f.name for f in fields(cls)} if isinstance(given, dict) else {"a line"}
        if unknown:
            raise ValueError(f"an answer has no {', '.join(sorted(unknown))}")
        for name in ("added", "ranking", "missed", "alike", "rivals"):
            given[name] = tuple(given.get(name, ()))
        given["confusable"] = tuple(tuple(group) for group in given.get("confusable", ()))
        return cls(**given)


def _plain(value: Any) -> Any:
    """Shortened floats, lists for tuples."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, Mapping):
        return {name: _plain(part) for name, part in value.items()}
    return [_plain(part) for part in value] if isinstance(value, tuple) else value
