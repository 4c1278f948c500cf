"""Rows of data files: what the thesis printed, a file per table."""

from __future__ import annotations

import csv
from pathlib import Path

_TABLES = Path(__file__).parent / "tables"


def printed_table(table: str) -> list[dict[str, str]]:
    """Rows of a table of the thesis by column name, digit for digit: "4.1", "4.3", "4.4", "4.7" or "4.8"."""
    return read_csv(_TABLES / f"table_{table.replace('.', '_')}.csv")


def read_csv(path: Path) -> list[dict[str, str]]:
    """Rows by column name; lines that start with # are comments."""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))
