"""An answer of the diagnosis made whole: what it takes to repeat it, and the classes of the laws it learned."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from pysim.diagnosis.response_comparison import versions
from pysim.types import Diagnosis
from pysim.workflow.learned import with_classes
from pysim.workflow.session import SessionParts


def whole_answer(found: Diagnosis, parts: SessionParts, more: Mapping[str, str] | None = None) -> Diagnosis:
    """The answer with its conditions, and with a class for each law that was learned.

    Args:
        more: conditions that whoever asked knows, such as the command.
    """
    found = replace(found, conditions={**_conditions(parts), **(more or {}), **found.conditions})
    if found.learned and parts.variants is not None:
        found = with_classes(found, parts.variants.class_name, parts.variants.libraries)
    return found


def _conditions(parts: SessionParts) -> dict[str, str]:
    model = parts.model
    return {
        "model": f"{parts.model_name}, FMI {model.abilities.fmi}, token {model.token}",
        "data set": f"{parts.dataset.name}, {len(parts.dataset.records)} records",
        "libraries": ", ".join(str(library) for library in parts.libraries) or "the one that comes along",
        "free parameters": ", ".join(parts.free) or "none",
        "parameters set": ", ".join(f"{name} = {value:g}" for name, value in parts.overrides.items()) or "none",
        "candidates": ", ".join(effect.name for effect in parts.catalogue) or "none",
        "versions": versions(),
    }
