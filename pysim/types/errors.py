"""The user's mistake, as a type."""

from collections.abc import Callable
from typing import TypeVar

_T = TypeVar("_T")
_RED, _PLAIN = "\x1b[31m", "\x1b[0m"


def with_place(place: str, make: Callable[[], _T]) -> _T:
    """What `make` gives. What it refuses is said with its place in a file, if it has none yet.

    Args:
        place: file, line and table, as far as they are known.
    """
    try:
        return make()
    except BadInput as error:
        raise error if error.where else BadInput(str(error), where=place) from error


def printable(text: str) -> str:
    """Signs that command a terminal or break a line, which names in a file may hold, by their codes."""
    return "".join(sign if sign.isprintable() or sign == "\n" else ascii(sign)[1:-1] for sign in text)


class BadInput(ValueError):
    """The caller asked for something that cannot be: one sentence with what and where; behind a semicolon the cure.

    Args:
        argument: of the function that was called, which has to change; "" where that is not known.
        where: file, line and table that hold it, said ahead of the sentence; "" where that is not known.
    """

    def __init__(self, sentence: str = "", *, argument: str = "", where: str = "") -> None:
        super().__init__(f"{where}: {sentence}" if where else sentence)
        self.argument, self.where = argument, where

    def __str__(self) -> str:
        return printable(super().__str__())

    @property
    def cure(self) -> str:
        """What to do about it, for whoever shows it apart from the rest; "" where the sentence has none."""
        return str(self).rpartition("; ")[2] if "; " in str(self) else ""

    def _render_traceback_(self) -> list[str]:
        """What a notebook shows: the sentence, and no frames of ours, as the mistake is in the cell."""
        return [f"{_RED}{self}{_PLAIN}"]
