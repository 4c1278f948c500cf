"""A line of a text log as fields: what separates them, whether commas are decimal, and what is a number."""

from __future__ import annotations

from typing import NamedTuple

LEFT_OUT = "-"  # name of a column that nobody wants; it may hold anything


class Dialect(NamedTuple):
    """What separates the columns of a line (None: blanks), and whether its commas are decimal."""

    separator: str | None
    decimal: bool

    def fields(self, line: str) -> list[str]:
        """Of one line, decimal commas turned into points."""
        fields = [field.strip() for field in line.split(self.separator)]
        return [field.replace(",", ".") for field in fields] if self.decimal else fields


TABS, SEMICOLONS, COMMAS, BLANKS = Dialect("\t", True), Dialect(";", True), Dialect(",", False), Dialect(None, True)
DIALECTS = (TABS, SEMICOLONS, COMMAS, BLANKS)


def dialect(line: str) -> Dialect:
    """Of a line that is all numbers, or names of columns.

    A comma at the edge of a word separates, and so does one in a line without blanks.
    """
    for one in (TABS, SEMICOLONS):
        if str(one.separator) in line:
            return one
    words = line.split()
    if "," in line and (len(words) == 1 or any(word.startswith(",") or word.endswith(",") for word in words)):
        return COMMAS
    return BLANKS


def number(field: str) -> float | None:
    """The number a field holds; Python would also read 1_000."""
    try:
        return None if "_" in field else float(field)
    except ValueError:
        return None


def without_end_mark(line: str) -> str:
    """A line that ends with a separator, without it."""
    line = line.rstrip(" ")
    return line[:-1] if line.endswith(("\t", ";", ",")) else line


def row_fields(line: str, columns: tuple[str, ...], usual: Dialect | None = None) -> tuple[list[str], Dialect]:
    """Fields of a row, and how they were separated.

    What a column that is left out holds may look like separators. So the dialect counts that gives a field for each
    column, and numbers in those that are wanted; where there is none, one that gives the fields alone, or the usual.

    Args:
        usual: dialect of the file; without it, the one that the line looks like.
    """
    bare = line.strip()
    first = dialect(bare) if usual is None or LEFT_OUT not in columns else usual
    tried = (first, *DIALECTS) if LEFT_OUT in columns else ()
    for judge in (fits, lambda fields, columns: len(fields) == len(columns)):
        for one in tried:
            for text in (bare, line):
                fields = one.fields(text)
                if judge(fields, columns):
                    return fields, one
    return first.fields(bare), first


def fits(fields: list[str], columns: tuple[str, ...]) -> bool:
    """Whether there is a field for each column, and a number in those that are not left out."""
    return len(fields) == len(columns) and all(
        name == LEFT_OUT or number(field) is not None for name, field in zip(columns, fields, strict=True)
    )
