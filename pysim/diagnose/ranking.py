"""The candidates of a round as the answer lists them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from pysim.diagnose import decide
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.rounds import Tried
from pysim.diagnose.scores import by_score, gain, score, share
from pysim.diagnose.story import Story
from pysim.diagnose.trials import promising
from pysim.types import Candidate


def rows(story: Story, tried: Tried, found: dict[str, Fitted], number: int) -> list[Candidate]:
    """Every candidate considered, the refitted ones first, the best of each first."""
    current = tried.current.point
    freedom, before = current.residual.size - current.x.size, story.blame(tried.current).cost
    order = by_score(story, tried.current, found)
    listed = []
    for name in order:
        extra = found[name].point.x.size - current.x.size
        fall = gain(story, tried.current, found[name])
        scale = decide.inflation(current, found[name].point.cost)
        part = share(story, tried.current, found[name])
        values = own_values(found[name], name)
        worth = score(story, tried.current, found[name])
        listed.append(Candidate(name, worth, decide.p_value(fall, extra, scale=scale), part, True, values, number))
    useless = [f for f in promising(tried) if found and f.effect.name not in found]
    for f in useless:
        price = decide.price(len(f.effect.parameters), current.residual.size)
        listed.append(Candidate(f.effect.name, -price, 1.0, 0.0, True, f.values, number))
    for f in tried.heads:
        if f.effect.name not in [row.effect for row in listed]:
            promised = tried.worth(f)
            worth = promised - decide.price(len(f.effect.parameters), current.residual.size)
            part = decide.explained(promised, before, freedom)
            by_chance = decide.p_value(promised, 1, scale=1.0)
            listed.append(Candidate(f.effect.name, worth, by_chance, part, False, f.values, number))
    return listed


def own_values(fitted: Fitted, name: str) -> dict[str, float]:
    """An effect's parameters, by their names as declared."""
    values, what = fitted.what.space.values(fitted.point.x), fitted.what
    effect = next(e for e in what.effects if e.name == name)
    return {p.name: values[f"{what.places[name]}.{p.name}"] for p in effect.parameters}


def as_data(listed: Sequence[Candidate]) -> list[dict[str, Any]]:
    """Rows for the journal."""
    return [{**asdict(row), "parameters": dict(row.parameters)} for row in listed]
