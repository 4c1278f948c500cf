"""What a caller gives, taken as the kind that is needed; one sentence where it is of another kind."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pysim.types.errors import BadInput


def number_of(given: Any, argument: str) -> float:
    """A number, also one of NumPy; no text."""
    try:
        if not isinstance(given, str | bytes):
            return float(given)
    except (TypeError, ValueError):
        pass
    raise BadInput(f"{argument}: {_shown(given)} is no number; write one, such as {argument}=0.5", argument=argument)


def whole_number_of(given: Any, argument: str) -> int:
    """A number without a fraction."""
    number = number_of(given, argument)
    if number.is_integer():
        return int(number)
    raise BadInput(f"{argument}: {number:g} is no whole number; write one, such as {argument}=3", argument=argument)


def names_of(given: Any, argument: str) -> tuple[str, ...]:
    """One name, several, or several of which some stand in lists."""
    if isinstance(given, str):
        return (given,)
    if isinstance(given, Iterable) and not isinstance(given, Mapping):
        return tuple(name for one in given for name in names_of(one, argument))
    raise BadInput(
        f'{argument}: {_shown(given)} is no name; write a text or a list of them: ["...", "..."]', argument=argument
    )


def path_of(given: Any, argument: str) -> Path:
    """The path of a file or a folder."""
    if isinstance(given, str | Path):
        return Path(given)
    raise BadInput(f'{argument}: {_shown(given)} is no path; write it as a text: "..."', argument=argument)


def mapping_of(given: Any, argument: str) -> dict[str, Any]:
    """Names with something to each; none where nothing is given."""
    if given is None or isinstance(given, Mapping):
        return dict(given or {})
    raise BadInput(f'{argument}: {_shown(given)} has no names; write {argument}={{"name": ...}}', argument=argument)


def _shown(given: Any) -> str:
    return repr(given) if isinstance(given, str | int | float | None) else f"a {type(given).__name__}"
