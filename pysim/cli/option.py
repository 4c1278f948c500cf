"""One option or argument of a command, as data."""

from __future__ import annotations

import argparse
import difflib
import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any


class Role(Enum):
    """What its value is, where that decides what may be written."""

    VALUE = "value"
    DATA = "data"  # a data set: nothing is written into it
    READ = "read"  # a file, or a folder of files: not overwritten
    FILE = "file"  # written
    FOLDER = "folder"  # of the report
    PLACE = "place"  # written, and looked at by the command itself


@dataclass(frozen=True)
class Option:
    """An argument (flags without dashes, such as DATASET) or an option.

    Args:
        flags: as typed; the last one names the value, `--settle-periods` as `given.settle_periods`.
        about: a phrase for the help.
        metavar: what stands for the value there; "" for a switch.
        default: where it is not given; the help states a number.
        convert: text -> value; raises ArgumentTypeError or ValueError.
        choices: the only texts that are allowed, or what gives them, where they are those of a registry.
        repeated: may be given more than once; the value is a list.
        nargs: how many words it takes, as argparse says it.
        required: only of options; arguments are unless nargs says otherwise.
        suffixes: of a file that is written; none for any.
        read: given -> what `given.NAME` is in place of the value, such as a data set in place of its folder.
    """

    flags: tuple[str, ...]
    about: str
    metavar: str = ""
    default: Any = None
    convert: Callable[[str], Any] = str
    choices: tuple[str, ...] | Callable[[], Iterable[str]] = ()
    repeated: bool = False
    nargs: int | str | None = None
    required: bool = False
    role: Role = Role.VALUE
    suffixes: tuple[str, ...] = ()
    read: Callable[[Any], Any] | None = None

    @property
    def positional(self) -> bool:
        return not self.flags[-1].startswith("-")

    @property
    def key(self) -> str:
        """The name of its value."""
        return self.flags[-1].lstrip("-").replace("-", "_").lower()

    @property
    def allowed(self) -> tuple[str, ...]:
        """The choices; none where any text will do."""
        return tuple(self.choices() if callable(self.choices) else self.choices)

    def add_to(self, parser: argparse.ArgumentParser) -> None:
        """Let a parser take it; the parsed value keeps the text beside it."""
        if not self.metavar and not self.choices and not self.positional:
            parser.add_argument(*self.flags, dest=self.key, action="store_true", help=self.about)
            return
        more: dict[str, Any] = {} if self.nargs is None else {"nargs": self.nargs}
        if self.repeated and not self.positional:
            more["action"] = "append"
        if not self.positional:
            more |= {"dest": self.key, "required": self.required}
        told = isinstance(self.default, int | float | str) and self.default != ""
        about = f"{self.about} ({_text(self.default)})" if told else self.about
        flags = (self.key,) if self.positional else self.flags
        more |= {
            "metavar": self.metavar or ("" if self.positional else "|".join(self.allowed)) or self.flags[-1],
            "type": self._typed,
            "help": about.replace("%", "%%"),
        }
        parser.add_argument(*flags, default=None, **more)

    def _typed(self, text: str) -> tuple[str, Any]:
        if self.choices and text not in self.allowed:
            near = did_you_mean(text, self.allowed)
            raise argparse.ArgumentTypeError(f"{text!r} is none of {', '.join(self.allowed)}{near}")
        try:
            return text, self.convert(text)
        except ValueError:
            comma = f"; write a point in place of the comma: {text.replace(',', '.')}" if "," in text else ""
            kind = "whole number" if self.convert is int else "number"
            raise argparse.ArgumentTypeError(f"{text!r} is no {kind}{comma}") from None

    def value(self, parsed: Any) -> Any:
        """What was given, or the default."""
        if parsed is None:
            return [] if self.repeated or self.nargs == "+" else self.default
        if isinstance(parsed, bool):
            return parsed
        return [value for _, value in parsed] if isinstance(parsed, list) else parsed[1]

    def words(self, parsed: Any) -> list[str]:
        """Those that give it again; none where it is the default."""
        if parsed is None or parsed is False or (not self.positional and self.value(parsed) == self.default):
            return []
        if parsed is True:
            return [self.flags[-1]]
        texts = [text for text, _ in parsed] if isinstance(parsed, list) else [parsed[0]]
        if self.positional:
            return texts
        if self.nargs is not None:
            return [self.flags[-1], *texts]
        return [word for text in texts for word in self._pair(text)]

    def _pair(self, text: str) -> list[str]:
        return [f"{self.flags[-1]}={text}"] if text.startswith("-") else [self.flags[-1], text]


def _text(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def argument(name: str, about: str, **more: Any) -> Option:
    """A word that needs no option ahead of it."""
    return Option((name,), about, **more)


def text(flag: str, metavar: str, about: str, **more: Any) -> Option:
    """An option whose value is taken as it is."""
    return Option((flag,), about, metavar, **more)


def number(
    flag: str, metavar: str, default: float | None, about: str, *, convert: Callable[[str], Any] = float, **more: Any
) -> Option:
    """An option of a number; a whole one with `convert=int`."""
    return Option((flag,), about, metavar, default=default, convert=convert, **more)


def positive(text: str) -> float:
    """A finite number above 0."""
    value = float(text)
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not above 0; give a positive number")
    return value


def choice(
    flag: str, default: str | None, of: tuple[str, ...] | Callable[[], Iterable[str]], about: str, **more: Any
) -> Option:
    """One of a few words, or of the names in a registry."""
    return Option((flag,), about, default=default, choices=of, **more)


def switch(flag: str, about: str) -> Option:
    """On where it is given."""
    return Option((flag,), about)


def names(flag: str, about: str, metavar: str = "NAME,...", *, required: bool = False) -> Option:
    """Names with commas between them, or repeated; one within brackets, as in `x[1,2]`, belongs to the name."""
    key = flag.lstrip("-").replace("-", "_")
    return Option(
        (flag,),
        f"{about}; commas or repeat",
        metavar,
        repeated=True,
        required=required,
        read=lambda given: names_of(given.typed[key]),
    )


def names_of(texts: Iterable[str]) -> list[str]:
    """Names between commas; one within brackets, as in `x[1,2]`, belongs to the name."""
    parts = [part.strip() for one in texts for part in re.split(r",(?![^\[]*\])", one)]
    return [part for part in parts if part]


def file(flag: str, metavar: str, about: str, *, role: Role = Role.FILE, **more: Any) -> Option:
    """A file to write, or with another role to read."""
    return Option((flag,), about, metavar, convert=Path, role=role, **more)


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """`; did you mean NAME?` where a name is near, else nothing."""
    near = difflib.get_close_matches(word, list(known), n=1, cutoff=0.7)
    return f"; did you mean {near[0]}?" if near else ""
