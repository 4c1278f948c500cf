"""The user's mistake, as a type."""

from collections.abc import Callable
from typing import TypeVar

_T = TypeVar("_T")
_RED, _PLAIN = "\x1b[31m", "\x1b[0m"


def with_place(place: str, make: Callable[[], _T]) -> _T:
    """What `make` gives. What it refuses is said with its place in a file, if that is not said yet.

    Args:
        place: file, line and table, as far as they are known.
    """
    try:
        return make()
    except BadInput as error:
        said = str(error).startswith(place.partition(", line ")[0]) or place in str(error)
        raise error if said else BadInput(f"{place}: {error}") from error


def printable(text: str) -> str:
    """Signs that command a terminal or break a line, which names in a file may hold, by their codes."""
    return "".join(sign if sign.isprintable() or sign == "\n" else ascii(sign)[1:-1] for sign in text)


class BadInput(ValueError):
    """The caller asked for something that cannot be: one sentence with what and where; behind a semicolon the cure.

    Args:
        argument: of the function that was called, which has to change; "" where that is not known.
    """

    def __init__(self, sentence: str = "", *, argument: str = "") -> None:
        super().__init__(sentence)
        self.argument = argument

    def __str__(self) -> str:
        return printable(super().__str__())

    @property
    def cure(self) -> str:
        """What to do about it, for whoever shows it apart from the rest; "" where the sentence has none."""
        return str(self).rpartition("; ")[2] if "; " in str(self) else ""

    def _render_traceback_(self) -> list[str]:
        """What a notebook shows: the sentence, and no frames of ours, as the mistake is in the cell."""
        return [f"{_RED}{self}{_PLAIN}"]
