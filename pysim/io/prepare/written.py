"""Steps as dataset.toml has them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import MISSING, fields
from types import MappingProxyType
from typing import Any

from pysim.io.prepare.cut import Exclude, HoldOut, Split, Trim
from pysim.io.prepare.filters import LowPass, Resample
from pysim.io.prepare.gaps import FillGaps
from pysim.io.prepare.outliers import DropOutliers
from pysim.io.prepare.signals import Delay, Detrend, Flip, Rename, Scaled
from pysim.io.prepare.step import Step
from pysim.io.toml_section import Section

_ALL: tuple[type[Any], ...] = (
    Trim, Exclude, FillGaps, DropOutliers, Resample, LowPass, Detrend, Delay, Flip, Scaled, Rename, HoldOut, Split,
)  # fmt: skip

_OFF = "off"
STEPS: Mapping[str, type[Any]] = MappingProxyType({one.word: one for one in _ALL})


def step_of(section: Section) -> Step:
    """A step from a table with its word as `step` and its fields.

    Raises:
        BadInput: a word or field that is not known, or missing, with the place.
    """
    kind = STEPS[section.text("step", among=tuple(STEPS))]
    own = {field.name: field for field in fields(kind)}
    section.refuse_unknown(("step", _OFF, *own))
    given = {}
    for name, field in own.items():
        if name in section.values or field.default is MISSING:
            given[name] = _READ[str(field.type)](section, name)
    step: Step = kind(**given)
    return step


def is_off(section: Section) -> bool:
    """Whether a step stands in the list and is not done.

    Raises:
        BadInput: it says neither true nor false.
    """
    value = section.values.get(_OFF, False)
    if not isinstance(value, bool):
        raise section.error(f"{_OFF} = {value!r} is neither true nor false; write {_OFF} = true, or remove it")
    return value


def values_of(step: Step) -> dict[str, object]:
    """A step as a table: its word, and the fields that differ from their defaults."""
    own = {field.name: (getattr(step, field.name), field.default) for field in fields(step)}  # type: ignore[arg-type]
    return {"step": step.word} | {
        name: list(value) if isinstance(value, tuple) else dict(value) if isinstance(value, Mapping) else value
        for name, (value, default) in own.items()
        if value != default
    }


def _names(section: Section, key: str) -> Mapping[str, str]:
    inner = section.inner(key)
    if not inner.values:
        raise section.error(f'{key} is missing; write {key} = {{ old = "new" }}')
    return MappingProxyType({name: inner.text(name) for name in inner.values})


_READ: Mapping[str, Callable[[Section, str], Any]] = MappingProxyType(
    {
        "str": lambda section, key: section.text(key),
        "float": lambda section, key: section.number(key),
        "float | None": lambda section, key: section.optional_number(key),
        "int": lambda section, key: section.integer(key),
        "tuple[str, ...]": lambda section, key: section.texts(key),
        "Mapping[str, str]": _names,
    }
)
