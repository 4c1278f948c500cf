"""What the thesis says in numbers outside its tables: published.csv of a folder, with what, value, unit and where."""

from __future__ import annotations

from pathlib import Path

from pysim.thesis import read_csv


def published(case: str) -> dict[str, float]:
    """Values by name, in the units of the file.

    Args:
        case: the case module's `__file__`; published.csv lies beside it.
    """
    return {row["what"]: float(row["value"]) for row in read_csv(Path(case).parent / "published.csv")}
