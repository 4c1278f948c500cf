"""Whether the law of an effect makes events, as its Modelica text says."""

from __future__ import annotations

import re

from pysim.types import Effect

# Modelica text that makes events, calls inside which a relation makes none, and strings and comments.
_SWITCHES = re.compile(r"\b(when|pre|sample|reinit|edge|change|div|mod|rem|ceil|floor|integer)\b|[<>]")
_NO_EVENT = re.compile(r"\b(noEvent|smooth)\s*\(")
_WORDS = re.compile(r'"(?:[^"\\]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


def makes_events(effect: Effect) -> bool:
    """Whether the effect's law makes events: it has `when`, `pre` or the like, or a relation outside `noEvent`."""
    law = _WORDS.sub("", effect.law)
    while found := _NO_EVENT.search(law):
        depth, end = 1, found.end()
        while depth and end < len(law):
            depth += {"(": 1, ")": -1}.get(law[end], 0)
            end += 1
        law = law[: found.start()] + law[end:]
    return bool(_SWITCHES.search(law))
