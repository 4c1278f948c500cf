"""Fields in quotation marks, as spreadsheets write them."""

from __future__ import annotations

import re
from functools import partial

# What stands in quotation marks between commas, a number there with a comma, and one whose comma may part thousands.
_BESIDE = re.compile(r',\s*"|"\s*,')
_QUOTED = re.compile(r'(?:(?<=,)|^)\s*"([^"]*)"(?=\s*(?:,|$))')
_DECIMAL = re.compile(r"\s*[+-]?\d*,\d+(?:[eE][+-]?\d+)?\s*")
_AMOUNT = re.compile(r"\s*[+-]?[\d.,]+(?:[eE][+-]?\d+)?\s*")  # a number, its commas decimal or not
# The same between semicolons or tabs: there only these separate.
_BETWEEN = re.compile(r'((?:^|(?<=[;\t])) *)"([^"]*[;\t][^"]*)"(?= *(?:[;\t]|$))')
_THOUSANDS = re.compile(r"\s*[+-]?[1-9]\d{0,2},\d{3}\s*")


def unquoted(text: str, gap: str = "_") -> str:
    """The same without quotation marks; where commas separate, nothing between such marks does.

    A comma in a number becomes a point, but not where every number of the file may be one whose comma parts thousands.

    Args:
        gap: stands for blanks, commas and the like in words.
    """
    if '"' not in text:
        return text
    lines = text.split("\n")
    beside = [i for i, line in enumerate(lines) if _BESIDE.search(line)]
    numbers = (n for i in beside for n in _QUOTED.findall(lines[i]) if "." not in lines[i] and _DECIMAL.fullmatch(n))
    decimal = any(not _THOUSANDS.fullmatch(number) for number in numbers)
    for i in beside:
        lines[i] = _QUOTED.sub(partial(_protected, decimal=decimal and "." not in lines[i], gap=gap), lines[i])
    return "\n".join(line if '"' not in line else _without_marks(line, gap) for line in lines)


def _without_marks(line: str, gap: str) -> str:
    """Of a line in which commas between marks mean nothing any more."""
    if _BETWEEN.fullmatch(line) is None:  # all of it may stand in marks
        line = _BETWEEN.sub(lambda field: field[1] + re.sub(r"[;\t]+", gap, field[2]), line)
    return line.replace('"', "")


def _protected(field: re.Match[str], *, decimal: bool, gap: str) -> str:
    """What stands between quotation marks, without anything that separates."""
    if decimal and _DECIMAL.fullmatch(field[1]):
        return field[1].replace(",", ".")
    word = any(letter.isalpha() for letter in field[1]) or not _AMOUNT.fullmatch(field[1])
    return re.sub(r"[,;\s]+", gap, field[1]) if word else field[1]
