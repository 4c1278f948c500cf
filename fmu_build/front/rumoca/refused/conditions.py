"""Finds `if` statements inside when-clauses that rumoca has decided at compile time.

Where the condition holds parameters only, rumoca 0.10.2 keeps one branch, by the parameters' default values, and says
so nowhere. Setting the parameter later would have no effect, so such a model is refused. What is left of the
condition in the compiled model tells: nothing.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from fmu_build.errors import BuildError
from fmu_build.front.rumoca.form.places import Places
from fmu_build.text.statements import statements
from fmu_build.text.tokens import tokenise


@dataclass(frozen=True)
class Condition:
    """Byte ranges of an `if` condition and of the when-clause around it."""

    clause: tuple[int, int]
    start: int
    end: int


def refuse_folded_conditions(dae: Mapping[str, Any], places: Places) -> None:
    """Raise a BuildError where a condition inside a used when-clause has vanished."""
    storage = dae["storage"]
    acted = _starts(
        [*storage["discrete_real_equations"], *storage["event_actions"]]
        + [value for owner in storage["discrete_value_owners"] for b in owner["branches"] for value in b["values"]]
    )
    kept = _starts([{"provenance": provenance} for provenance in storage["expressions"]["provenance"]])
    for source, _, text in dae["source_map"]["files"]:
        if source not in acted or "when" not in text:
            continue
        for condition in conditions_in_clauses(text):
            is_used = any(condition.clause[0] <= start < condition.clause[1] for start in acted[source])
            is_kept = any(condition.start <= start < condition.end for start in kept.get(source, ()))
            if is_used and not is_kept:
                span = places.span({"span": {"source": source, "start": condition.start}})
                raise BuildError(
                    "the condition of this if inside a when-clause holds parameters only, and the compiler "
                    "would fix it at their default values; write an if-expression: variable = if ... then ... else ...",
                    span.file,
                    span.line,
                )


def _starts(items: list[Mapping[str, Any]]) -> dict[int, list[int]]:
    """Where in the text the items begin, by source."""
    starts: dict[int, list[int]] = {}
    for item in items:
        span = (item.get("provenance") or {}).get("span")
        if span:
            starts.setdefault(span["source"], []).append(span["start"])
    return starts


def conditions_in_clauses(text: str) -> Iterator[Condition]:
    """Conditions of `if` and `elseif` statements (not expressions) inside when-clauses."""
    words = tokenise(text.encode().decode("latin-1"))  # one character per byte, as rumoca counts
    for outer in statements(words):
        for clause in (outer, *outer.inside()):
            for inner in clause.inside() if clause.word == "when" else ():
                for condition in inner.conditions if inner.word == "if" else ():
                    yield Condition((clause.start, clause.end), condition[0].start, condition[-1].end)
