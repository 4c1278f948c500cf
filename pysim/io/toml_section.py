"""One table of a TOML file with the place it stands at, so that every complaint names file and line."""

from __future__ import annotations

import math
import re
import tomllib
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path, PureWindowsPath
from typing import Any

from pysim.io.text_table import read_text
from pysim.types import BadInput

# Of the parser's messages: where it stopped, and how those about a value begin.
_LINE = re.compile(r"\(at line (\d+), column \d+\)$")
_NO_VALUE = ("Invalid value", "Expected newline")
_DEEP = re.compile(r"""(?:\.\s*[\w"'-]+\s*){100}""")  # sections within sections; the parser counts them again for each
_SHOWN = 60  # characters of a value in a message
_BARE = re.compile(r"""\s*([\w.-]+)\s*=\s*([^"'\[\]{}#]*[^"'\[\]{}#\s])\s*(?:#.*)?""")  # a value without quotes


def log_source(name: str) -> str:
    """The file a record names, as its `source`: with / between folders whatever the system, without "./" and "//"."""
    return PureWindowsPath(name).as_posix()


@dataclass(frozen=True)
class Section:
    """A table and where it begins.

    Args:
        place: the file and the line, for messages.
        values: what it holds.
    """

    place: str
    values: dict[str, Any]

    def error(self, sentence: str) -> BadInput:
        """What is wrong with it."""
        return BadInput(sentence, where=self.place)

    def text(self, key: str, default: str | None = None, *, among: tuple[str, ...] = ()) -> str:
        """A string, one of `among` where that is not empty."""
        value = self.values.get(key, default)
        if not isinstance(value, str) or not value:
            raise self.error(f'{key} is missing or no text; write {key} = "..."')
        if among and value not in among:
            raise self.error(f"{key} = {value!r} is not known; use one of {', '.join(among)}")
        return value

    def source(self) -> str:
        """The file a record names, with / between folders whatever the system."""
        name = self.text("file")
        if not name.isprintable():  # TOML reads the \t of logs\test.txt as a tab
            raise self.error(f"file = {name!r} is no name; write / between folders")
        return log_source(name)

    def number(self, key: str) -> float:
        """A finite number that must be there."""
        value = self.optional_number(key)
        if value is None:
            raise self.error(f"{key} is missing; write {key} = and a number")
        return value

    def optional_number(self, key: str) -> float | None:
        """A finite number, or None where the key is absent."""
        value = self.values.get(key)
        if value is None:
            return None
        if not _is_number(value):
            raise self.error(f"{key} = {_short(value)} is no finite number; write {key} = and a number")
        return float(value)

    def moment(self, key: str) -> float | None:
        """A date and time, or a number of s, as s on one clock; None where the key is absent.

        A date without a zone is taken as one of UTC: only differences count.
        """
        value = self.values.get(key)
        if isinstance(value, datetime):
            return (value if value.tzinfo else value.replace(tzinfo=UTC)).timestamp()
        if value is not None and not _is_number(value):
            raise self.error(f"{key} = {_short(value)} is no moment; write a number of s, or 2026-03-01T14:05:00")
        return None if value is None else float(value)

    def positive(self, key: str) -> float | None:
        """A number above zero, or None where the key is absent."""
        value = self.optional_number(key)
        if value is not None and value <= 0:
            raise self.error(f"{key} must be positive, got {value:g}; correct it")
        return value

    def not_negative(self, key: str) -> float | None:
        """A number from zero on, or None where the key is absent."""
        value = self.optional_number(key)
        if value is not None and value < 0:
            raise self.error(f"{key} cannot be negative, got {value:g}; correct it")
        return value

    def texts(self, key: str, *, repeatable: str = "") -> tuple[str, ...]:
        """A row of strings that must be there, different but for the `repeatable` one."""
        values = self.values.get(key)
        if not isinstance(values, list) or not values or any(not isinstance(v, str) or not v for v in values):
            raise self.error(f'{key} is missing or no row of texts; write {key} = ["...", "..."]')
        for value in values:
            if values.count(value) > 1 and value != repeatable:
                raise self.error(f"{key} names {value!r} {values.count(value)} times; name it once")
        return tuple(values)

    def numbers(self, key: str) -> tuple[float, ...]:
        """A row of finite numbers that must be there."""
        values = self.values.get(key)
        if not isinstance(values, list) or not values or not all(_is_number(value) for value in values):
            raise self.error(f"{key} is missing or no row of numbers; write {key} = [1.0, 2.0]")
        return tuple(float(value) for value in values)

    def pairs(self, key: str) -> tuple[tuple[float, float], ...]:
        """A row of pairs of finite numbers that must be there."""
        values = self.values.get(key)
        rows = values if isinstance(values, list) else []
        if not rows or not all(isinstance(r, list) and len(r) == 2 and all(map(_is_number, r)) for r in rows):
            raise self.error(f"{key} is missing or no row of pairs; write {key} = [[1.0, 2.0], [3.0, 4.0]]")
        return tuple((float(first), float(second)) for first, second in rows)

    def integer(self, key: str, default: int | None = None, *, least: int | None = None) -> int:
        """A whole number, not below `least`; one that must be there where there is no default."""
        value = self.values.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int):
            raise self.error(f"{key} is missing or no whole number; write {key} = 1")
        if least is not None and value < least:
            raise self.error(f"{key} cannot be below {least}, got {value}; correct it")
        return value

    def flag(self, key: str, default: bool) -> bool:
        """true or false."""
        value = self.values.get(key, default)
        if not isinstance(value, bool):
            raise self.error(f"{key} = {value!r} is neither true nor false; write one of them")
        return value

    def inner(self, key: str) -> Section:
        """A table within this one, empty where the key is absent."""
        value = self.values.get(key, {})
        if not isinstance(value, dict):
            raise self.error(f"{key} = {value!r} is no table; write {key} = {{ name = value }}")
        return Section(f"{self.place}, {key}", value)

    def rows_of(self, key: str) -> tuple[Section, ...]:
        """The tables of a row of tables within this one, none where the key is absent."""
        rows = self.values.get(key, [])
        if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
            raise self.error(f'{key} is no row of tables; write {key} = [{{ step = "..." }}]')
        return tuple(Section(f"{self.place}, {key} {number}", row) for number, row in enumerate(rows, 1))

    def refuse_unknown(self, keys: tuple[str, ...]) -> None:
        """A misspelt key would be a silent default."""
        for key in self.values:
            if key not in keys:
                raise self.error(f"the key {key!r} is not known; use {', '.join(keys)}")


def _is_number(value: object) -> bool:
    """Whether it is a number that a float holds; TOML has whole numbers of any length."""
    try:
        return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:
        return False


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}..."


@dataclass(frozen=True)
class TomlFile:
    """A TOML file that gives out its tables with their places.

    Args:
        path: where it stands.
        whole: everything in it.
        headers: line number and text of every line that begins a table; the parser does not tell.
    """

    path: Path
    whole: Section
    headers: tuple[tuple[int, str], ...]

    def table(self, key: str) -> Section:
        """[key], which must be there."""
        return self._section(self._content(key), f"[{key}]", 0, key)

    def optional_table(self, key: str) -> Section:
        """[key], empty where it is not there."""
        return self.table(key) if key in self.whole.values else Section(f"{self.path}, [{key}]", {})

    def tables(self, key: str) -> dict[str, Section]:
        """Every [key.name], by its name."""
        return {
            name: self._section(values, f"[{key}.{name}]", 0, f"{key}.{name}")
            for name, values in self._content(key).items()
        }

    def rows(self, key: str, each: str) -> tuple[Section, ...]:
        """Every [[key]], in order; there must be one.

        Args:
            each: what one of them is, for the message.
        """
        rows = self.whole.values.get(key)
        if not isinstance(rows, list) or not rows:
            raise self.whole.error(f"there are no {key}; add one [[{key}]] section per {each}")
        return tuple(self._section(values, f"[[{key}]]", i, key) for i, values in enumerate(rows))

    def _content(self, key: str) -> dict[str, Any]:
        table = self.whole.values.get(key)
        if not isinstance(table, dict) or not table:
            raise self.whole.error(f"the section [{key}] is missing; add it")
        return table

    def _section(self, values: Any, header: str, nth: int, name: str) -> Section:
        places = [number for number, line in self.headers if line.startswith(header)]
        place = f"{self.path}, line {places[nth]}" if nth < len(places) else f"{self.path}, {header}"
        if not isinstance(values, dict):
            raise BadInput(f"{name} is no section; begin it with {header}", where=place)
        return Section(place, values)


def read_toml(path: Path, wanted_by: str, cure: str = "correct the TOML") -> TomlFile:
    """A TOML file.

    Args:
        wanted_by: what it is, for messages.
        cure: of what has none of its own.
    Raises:
        BadInput: it cannot be read or is no TOML, with the line.
    """
    text = read_text(path, wanted_by)
    if _DEEP.search(text):
        raise BadInput(f"{path}: a name has more than a hundred points; {cure}")
    try:
        content = tomllib.loads(text)
    except RecursionError as error:
        raise BadInput(f"{path}: its brackets stand too deep within each other; {cure}") from error
    except ValueError as error:  # beside faults of the TOML, numbers of thousands of digits
        raise BadInput(f"{path}: {error}; {_cure(error, text) or cure}") from error
    lines = ((number, line.replace('"', "").strip()) for number, line in enumerate(text.split("\n"), 1))
    headers = tuple((number, line) for number, line in lines if line.startswith("["))
    return TomlFile(path, Section(str(path), content), headers)


def _cure(error: ValueError, text: str) -> str:
    """What to do about a text that is no TOML, by the line at which the parser stopped; "" where that says nothing."""
    place = _LINE.search(str(error))
    line = text.split("\n")[int(place[1]) - 1] if place else ""
    if "\\" in line:
        return "write / between folders"
    bare = _BARE.fullmatch(line)
    if bare is None or not str(error).startswith(_NO_VALUE):
        return ""
    try:
        return f"write {bare[1]} = {float(bare[2].replace(',', '.'))}"
    except ValueError:
        return f'put texts in quotes: {bare[1]} = "{bare[2]}"'
