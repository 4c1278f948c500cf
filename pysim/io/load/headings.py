"""Names and units out of the headings of columns, and the column that a name means."""

from __future__ import annotations

import re
from collections.abc import Mapping
from difflib import get_close_matches

from pysim.io.load.foreign_units import known_unit
from pysim.io.load.table import Doubt, RawTable
from pysim.types import BadInput

_BRACKETS = re.compile(r"\s*(?P<name>[^\[\](){}]+?)\s*(?:\[(?P<a>[^\]]*)\]|\((?P<b>[^)]*)\)|\{(?P<c>[^}]*)\})\s*")
_SLASH = re.compile(r"\s*(?P<name>.*?\S)\s*(?:\s/\s*|/\s+|/)(?P<unit>\S.*?)\s*")
_IN = re.compile(r"\s*(?P<name>.*?\S)\s+in\s+(?P<unit>\S+)\s*")


def name_and_unit(heading: str) -> tuple[str, str]:
    """What a heading calls its column and the unit behind it: "x [mm]", "x (mm)", "x / mm", "x in mm"; "" for none.

    Brackets hold a unit of any spelling; behind a stroke or "in" only what is one counts.
    """
    found = _BRACKETS.fullmatch(heading)
    if found is not None:
        return found["name"], (found["a"] or found["b"] or found["c"] or "").strip()
    for form in (_SLASH, _IN):
        found = form.fullmatch(heading)
        if found is not None and known_unit(found["unit"]):
            return found["name"], found["unit"]
    return heading.strip(), ""


def heading_of(table: RawTable, name: str) -> str:
    """The heading of the column that a name means: the whole heading, or its part ahead of the unit.

    Capital letters count: P and p are different signals.

    Raises:
        BadInput: there is none, or there are several.
    """
    if name in table.headings:
        return _once(table, name)
    found = [heading for heading in table.headings if name_and_unit(heading)[0] == name]
    if len(found) == 1:
        return _once(table, found[0])
    if found:
        shown = " or ".join(repr(heading) for heading in dict.fromkeys(found))
        raise BadInput(f"{table.place}: which column is {name!r}, {shown}? Write it as it stands there, with its unit")
    small = {heading.casefold(): heading for heading in table.headings}
    small |= {name_and_unit(heading)[0].casefold(): heading for heading in table.headings}
    near = dict.fromkeys(small[one] for one in get_close_matches(name.casefold(), list(small), n=3))
    cure = f"did you mean {' or '.join(map(repr, near))}?" if near else f"it has {', '.join(table.headings)}"
    raise BadInput(f"{table.place} has no column {name!r}; {cure}")


def _once(table: RawTable, heading: str) -> str:
    if table.headings.count(heading) > 1:
        raise BadInput(
            f"{table.place}: {table.headings.count(heading)} columns are headed {heading!r}; give each its own name"
        )
    return heading


def unit_of(table: RawTable, heading: str, name: str, units: Mapping[str, str]) -> tuple[str, str]:
    """The unit of a column, "" where nothing says it, and a remark where two things say otherwise.

    Args:
        units: what the user says, by the name of the signal or the heading.
    """
    short, written = name_and_unit(heading)
    written = table.units.get(heading) or written
    given = next((units[one] for one in (name, heading, short) if one in units), "")
    if given and written and given != written:
        return given, Doubt(f"unit of {name}: {given} as you say, though {table.place} says {written}")
    return given or written, ""
