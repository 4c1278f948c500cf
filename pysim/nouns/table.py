"""Rows and columns that print well, and that pandas takes over where more is asked of them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

from pysim.io.named_columns import optional_package
from pysim.present.plain_text import with_interval
from pysim.types import BadInput
from pysim.types._frozen import FrozenMapping

MOST = 1900  # characters of what a noun prints
_WIDEST = 44  # characters of a cell
_ROOM = 500  # characters that the tables have at least
_INTERVAL = ("value", "95 % from", "to")  # columns
_FIRST = 4  # lines behind the tables that HTML shows too
EXTRA = '"hydraulic-test-bench[notebook]"'  # what pip calls all that notebooks may want


@dataclass(frozen=True)
class Table:
    """A table. What it cannot do itself, a pandas DataFrame of it does: `table.query(...)`, `table.round(2)`.

    Args:
        columns: name -> values, all of one length.
        key: the column that names the rows; "" for none.
        title: of the whole, for a caption.
    """

    columns: Mapping[str, tuple[Any, ...]]
    key: str = ""
    title: str = ""

    def __post_init__(self) -> None:
        columns = {name: tuple(values) for name, values in self.columns.items()}
        object.__setattr__(self, "columns", FrozenMapping(columns))

    @classmethod
    def of(cls, head: Sequence[str], rows: Sequence[Sequence[Any]], *, key: str = "", title: str = "") -> Table:
        """From rows."""
        columns = list(zip(*rows, strict=True)) if rows else [()] * len(head)
        return cls(dict(zip(head, columns, strict=True)), key, title)

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """Row by row."""
        for values in zip(*self.columns.values(), strict=True):
            yield dict(zip(self.columns, values, strict=True))

    def __getitem__(self, name: str) -> tuple[Any, ...]:
        """A column."""
        if name not in self.columns:
            raise BadInput(f"the table has no column {name!r}; it has {', '.join(self.columns)}")
        return self.columns[name]

    def of_columns(self, *names: str) -> Table:
        """The same with these columns alone."""
        return Table({name: self[name] for name in names})

    def row(self, key: str) -> dict[str, Any]:
        """The first row of that name."""
        names = self[self.key] if self.key else ()
        if key not in names:
            raise BadInput(f"the table has no row {key!r}; it has {', '.join(map(str, names)) or 'no names'}")
        return next(row for row in self if row[self.key] == key)

    def to_dataframe(self) -> Any:
        """As a pandas DataFrame, with the key as its index."""
        frame = pandas().DataFrame({name: list(values) for name, values in self.columns.items()})
        return frame.set_index(self.key) if self.key else frame

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name in ("columns", "key", "title"):
            raise AttributeError(name)
        return getattr(self.to_dataframe(), name)

    def __repr__(self) -> str:
        return "\n".join(self.lines())

    def lines(self, most: int = MOST) -> list[str]:
        """Aligned text, with as many rows as fit into so many characters."""
        cells = [list(self.columns), *map(_cells, self)]
        right = [all(_is_number(v) for v in column) and len(column) > 0 for column in self.columns.values()]
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        found: list[str] = []
        for k, row in enumerate(cells):
            padded = [c.rjust(w) if r else c.ljust(w) for c, w, r in zip(row, widths, right, strict=True)]
            line = "  ".join(padded).rstrip()
            if k and sum(map(len, found)) + len(found) + len(line) > most:
                return [*found, f"... and {len(self) - k + 1} more"]
            found.append(line)
        return found

    def html(self, most: int = MOST) -> str:
        """As HTML, with as many rows as fit into so many characters."""
        ahead = f"<table><caption>{escape(self.title)}</caption><tr>" if self.title else "<table><tr>"
        text = ahead + "".join(f"<th>{escape(name)}</th>" for name in self.columns) + "</tr>"
        for k, row in enumerate(self):
            line = "<tr>" + "".join(f"<td>{escape(text)}</td>" for text in _cells(row)) + "</tr>"
            if len(text) + len(line) > most - 60:
                text += f"<tr><td>... and {len(self) - k} more</td></tr>"
                break
            text += line
        return f"{text}</table>"

    def _repr_html_(self) -> str:
        return self.html()


class Shown:
    """How a noun is shown: words, tables with as many rows as there is room for, more words, and warnings."""

    @property
    def table(self) -> Table:
        """What it holds, in rows."""
        raise NotImplementedError

    @property
    def _words(self) -> list[str]:
        """Lines ahead of the tables."""
        return []

    @property
    def _tables(self) -> tuple[Table, ...]:
        """What is printed of its tables."""
        return (self.table,)

    @property
    def _more(self) -> list[str]:
        """Lines behind the tables."""
        return []

    @property
    def _alarms(self) -> tuple[str, ...]:
        """Why not to trust it, in sentences."""
        return ()

    def to_dataframe(self) -> Any:
        """The table, as a pandas DataFrame."""
        return self.table.to_dataframe()

    def to_xarray(self) -> Any:
        """What `to_dataframe` gives, as an xarray.Dataset."""
        optional_package("xarray", "an xarray.Dataset needs xarray", EXTRA)
        return self.to_dataframe().to_xarray()

    def __repr__(self) -> str:
        said, tables = [*self._more, *(f"! {text}" for text in self._alarms)], [t for t in self._tables if len(t)]
        while len("\n".join([*self._words, *said])) > MOST - _ROOM and said:
            said = [*said[:-2], "... see .warnings for all"] if len(said) > 2 else []
        room = MOST - len("\n".join([*self._words, *said])) - 10
        rows = [line for table in tables for line in table.lines(room // len(tables))]
        return "\n".join([*self._words, *rows, *said])

    def _repr_html_(self) -> str:
        words = " | ".join([*self._words, *self._more[:_FIRST]])
        said = "".join(f'<p style="color:#b00020">{escape(one)}</p>' for one in self._alarms)
        said = f"<p>{escape(words)}</p>{said}"
        if len(said) > MOST // 2:
            said = f"{said[: MOST // 2].rpartition('<p')[0]}<p>...</p>" if "<p" in said[3 : MOST // 2] else "<p>...</p>"
        return said + self._tables[0].html(MOST - len(said))


def pandas() -> Any:
    """The package, loaded when a table is asked for.

    Raises:
        BadInput: it is not installed.
    """
    return optional_package("pandas", "a DataFrame needs pandas", '"hydraulic-test-bench[data]"')


def _is_number(value: Any) -> bool:
    return (isinstance(value, int | float) and not isinstance(value, bool)) or value is None


def _cells(row: Mapping[str, Any]) -> list[str]:
    """Of a row; a value and the ends of its interval with as many digits as tell them apart."""
    texts = {name: _cell(value) for name, value in row.items()}
    three = [number for name in _INTERVAL if isinstance(number := row.get(name), float) and math.isfinite(number)]
    if len(three) == len(_INTERVAL):
        texts |= zip(_INTERVAL, with_interval(three[0], (three[1], three[2])), strict=True)
    return [*texts.values()]


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.5g}"
    text = " ".join(str(value).split())
    return text if len(text) <= _WIDEST else f"{text[: _WIDEST - 3]}..."
