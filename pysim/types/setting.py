"""A number of a method, with what it is counted in, what it means, and where it comes from, beside its default."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from typing import Any


def setting(default: Any, *, unit: str, meaning: str, source: str) -> Any:
    """A field of a settings type, which is a frozen dataclass.

    Args:
        default: the value that the method takes.
        unit: SI, "1" for a plain number.
        meaning: what it decides, in a sentence.
        source: a reference, or "measured:" with the validation case that shows it.
    """
    return field(default=default, metadata={"unit": unit, "meaning": meaning, "source": source})


@dataclass(frozen=True)
class SettingValue:
    """One field of a settings object, as a page or a report shows it."""

    name: str
    value: object
    unit: str
    meaning: str
    source: str


def settings_of(settings: Any) -> Iterator[SettingValue]:
    """Every field of a settings object with its three words."""
    for one in fields(settings):
        words = one.metadata
        yield SettingValue(one.name, getattr(settings, one.name), words["unit"], words["meaning"], words["source"])
