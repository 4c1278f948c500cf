"""An answer of the diagnosis made whole: what it takes to repeat it, and the classes of the laws it learned."""

from __future__ import annotations

from dataclasses import replace

from pysim.identify.response_comparison import versions
from pysim.types import Diagnosis
from pysim.workflow.learned import with_classes
from pysim.workflow.session import SessionParts


def whole_answer(found: Diagnosis, parts: SessionParts, *, place: str = "", command: str = "") -> Diagnosis:
    """The answer with its conditions, judged by the thesis' limits where they hold, with a class for each learned law.

    Args:
        place, command: where the data set is, and what gives the answer again; "" where there is none.
    """
    conditions = _conditions(parts, place) | ({"command": command} if command else {})
    found = replace(found, conditions={**conditions, **found.conditions})
    if not parts.inside.is_thesis_pump:
        unjudged = (replace(step, criteria={}, passes=not step.not_simulated) for step in found.history)
        found = replace(found, history=tuple(unjudged))
    if found.learned and parts.variants is not None:
        found = with_classes(found, parts.variants.class_name, parts.variants.libraries)
    return found


def _conditions(parts: SessionParts, place: str) -> dict[str, str]:
    model = parts.model
    return {
        "model": parts.model_name,
        "FMU": f"FMI {model.abilities.fmi}, identifier {model.token}",
        "data set": f"{parts.dataset.name}, {len(parts.dataset.records)} records{f', {place}' if place else ''}",
        "libraries": ", ".join(str(library) for library in parts.libraries) or "the one that comes along",
        "free parameters": ", ".join(parts.free) or "none",
        "parameter values given": ", ".join(f"{name} = {value:g}" for name, value in parts.overrides.items()) or "none",
        "candidates": ", ".join(effect.name for effect in parts.catalogue) or "none",
        "versions": versions(),
    }
