"""The keys that `pysim diagnose --json` must write, and what each holds; more may stand beside them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

Form = Callable[[Any, Path], bool]


def _number(value: Any, _: Path) -> bool:
    """Finite, or null."""
    return value is None or (isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value))


def _text(value: Any, _: Path) -> bool:
    return isinstance(value, str)


def _flag(value: Any, _: Path) -> bool:
    return isinstance(value, bool)


def _interval(value: Any, folder: Path) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(_number(end, folder) for end in value)


def _list(form: Form) -> Form:
    return lambda value, folder: isinstance(value, list) and all(form(one, folder) for one in value)


def _table(form: Form) -> Form:
    return lambda value, folder: isinstance(value, dict) and all(form(one, folder) for one in value.values())


def _row(**forms: Form) -> Form:
    return lambda value, folder: (
        isinstance(value, dict) and all(name in value and form(value[name], folder) for name, form in forms.items())
    )


def _or_null(form: Form) -> Form:
    return lambda value, folder: value is None or form(value, folder)


def _file(value: Any, folder: Path) -> bool:
    return isinstance(value, str) and not Path(value).is_absolute() and (folder / value).is_file()


_NUMBERS = _list(_number)
_SHAPE = _row(argument=_NUMBERS, value=_NUMBERS, low=_NUMBERS, high=_NUMBERS)

FIRST: Mapping[str, Form] = {
    "verdict": _text,
    "added": _list(_row(effect=_text, parameters=_table(_number), intervals=_table(_interval), unit=_table(_text))),
    "ranking": _list(_row(effect=_text, score=_number, p_value=_number, explained=_number)),
    "confusable": _list(_list(_text)),
    "error": _list(_row(step=_text, fit=_number, validate=_number, criteria=_table(_number), passes=_flag)),
    "parameters": _table(_row(value=_number, interval=_interval)),
    "where": _list(_row(record=_text, signal=_text, region=_text, error=_number)),
    "missing": _list(_row(slot=_text, share=_number, depends_on=_text, shape=_SHAPE)),
    "next_test": _or_null(_row(separates=_list(_text), gain=_number)),
    "seconds": _table(_number),
    "files": _table(_file),
}
SECOND: Mapping[str, Form] = {
    "complete": _flag,
    "left": _row(rms_over_floor=_row(fit=_number, validate=_number), share_explained=_number, t=_number),
    "learned": _list(_row(slot=_text, factor=_text, argument=_text, knots=_NUMBERS, coefficients=_NUMBERS)),
    "fit_percent": _list(_row(step=_text)),
    "notes": _list(_row(code=_text, text=_text)),
}


def broken(data: Mapping[str, Any], folder: Path, forms: Mapping[str, Form] = FIRST) -> Iterator[str]:
    """Keys that are missing, or hold something else.

    Args:
        data: the answer; folder: where its file is.
    """
    for key, form in forms.items():
        if key not in data:
            yield f"{key} is missing"
        elif not form(data[key], folder):
            yield f"{key} holds {str(data[key])[:200]}"
    if data.get("error") and [row["step"] for row in data["error"]][:2] != ["prior", "refit"]:
        yield "error does not begin with prior and refit"
