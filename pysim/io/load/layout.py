"""Where the rows of numbers begin in a sheet or a text, and what the rows above them call the columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date, datetime, time, timedelta

from pysim.io.load.foreign_units import known_unit
from pysim.io.load.moments import looks_like_moment
from pysim.io.load.table import number_of

Row = Sequence[object]


@dataclass(frozen=True)
class Layout:
    """What was found.

    Args:
        first: the row of the first numbers.
        headings: of all columns, "column 3" where there is none.
        counted: whether no column has a heading.
        units: heading -> unit, from a row of units.
    """

    first: int
    headings: tuple[str, ...]
    counted: bool = False
    units: dict[str, str] = field(default_factory=dict)


def is_value(cell: object) -> bool:
    """Whether a cell holds a number, a moment or a duration."""
    if isinstance(cell, datetime | date | time | timedelta):
        return True
    value = number_of(cell)
    return (value is not None and value == value) or looks_like_moment(cell)


def is_empty(cell: object) -> bool:
    """Whether nothing stands there."""
    return cell is None or (isinstance(cell, str) and not cell.strip())


def layout_of(head: Sequence[Row], tail: Sequence[Row]) -> Layout | None:
    """Read it off the first rows and the last ones, all of the same width.

    Returns:
        None where no column holds numbers.
    """
    width, tail = len(tail[0]), tail[len(tail) // 2 :]  # of a short file the first half may be headings
    wanted = [c for c in range(width) if _mostly_values([row[c] for row in tail])]
    first = next((k for k, row in enumerate(head) if 2 * _count(row, wanted) > len(wanted)), None)
    if not wanted or first is None:
        return None
    if first > 1 and _count(head[first - 1], wanted) > 0 and _names_all(head[first - 2], wanted):
        first -= 1  # a row of numbers with a text among them, which is refused where it is read
    above = [row for row in head[:first] if len(row) == width and not all(map(is_empty, row))]
    units: list[str] = []
    if len(above) > 1 and _is_units(above[-1], wanted):
        units = [_bare(cell) for cell in above.pop()]
    headings = _headings(above, width, wanted)
    counted = headings == tuple(f"column {k + 1}" for k in range(width))
    return Layout(first, headings, counted, {h: u for h, u in zip(headings, units, strict=False) if u})


def _mostly_values(cells: list[object]) -> bool:
    there = [cell for cell in cells if not is_empty(cell)]
    return 2 * sum(map(is_value, there)) > len(there)


def _count(row: Row, wanted: Sequence[int]) -> int:
    return sum(is_value(row[c]) for c in wanted) if row else 0


def _names_all(row: Row, wanted: Sequence[int]) -> bool:
    """Whether a row holds a name for every column."""
    return all(not is_empty(row[c]) and not is_value(row[c]) for c in wanted)


def _is_units(row: Row, wanted: Sequence[int]) -> bool:
    """Whether a row holds units: more than half of its cells are known ones, with brackets around them or not."""
    own = [_bare(row[c]) for c in wanted if not is_empty(row[c])]
    return bool(own) and 2 * sum(known_unit(unit) for unit in own) > len(own)


def _bare(cell: object) -> str:
    """A unit without the brackets around it."""
    return str(cell).strip().strip("[](){}").strip() if not is_empty(cell) else ""


def _headings(above: Sequence[Row], width: int, wanted: Sequence[int]) -> tuple[str, ...]:
    """The lowest row of names; where that gives two columns the same one, with what stands merged above them."""
    names = [str(cell).strip() if not is_empty(cell) else "" for cell in above[-1]] if above else [""] * width
    if not any(names[c] for c in wanted):
        names = [""] * width
    group = ""
    groups = []
    for cell in above[-2] if len(above) > 1 else [""] * width:
        group = group if is_empty(cell) else str(cell).strip()
        groups.append(group)
    full = [f"{g} {n}".strip() if names.count(n) > 1 or not n else n for g, n in zip(groups, names, strict=True)]
    kept = full if len(set(full)) == len(full) else names
    return tuple(name or f"column {k + 1}" for k, name in enumerate(kept))
