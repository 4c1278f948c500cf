"""The criteria of thesis Tables 1.3 and 1.4; the four numbers of Table 1.3 in text, in a table and as data."""

from __future__ import annotations

from collections.abc import Sequence

from pysim.identify import FREQUENCY_CRITERIA, TIME_CRITERIA
from pysim.present.page import Cell, cell
from pysim.types import Deviation

CRITERIA = {c.symbol: c for c in (*FREQUENCY_CRITERIA, *TIME_CRITERIA)}
KEYS = ("mean_magnitude_db", "max_magnitude_db", "mean_phase_deg", "max_phase_deg")
_DIGITS = (2, 2, 1, 1)


def numbers(values: Sequence[float]) -> list[str]:
    """The four with their digits."""
    return [f"{value:.{digits}f}" for value, digits in zip(values, _DIGITS, strict=True)]


def heads() -> list[str]:
    """Of their columns."""
    return [f"{c.name.replace(' deviation', '')} ({c.unit})" for c in FREQUENCY_CRITERIA]


def cells(deviations: Sequence[Deviation]) -> list[Cell]:
    """What is beyond its limit is marked."""
    texts = numbers([one.value for one in deviations])
    return [cell(text, "" if one.passes else "beyond") for one, text in zip(deviations, texts, strict=True)]


def keyed(deviations: Sequence[Deviation]) -> dict[str, float | None]:
    """By the keys that they have in JSON; None for each of a test that could not be run."""
    values = [float(one.value) for one in deviations]
    return dict(zip(KEYS, values, strict=True)) if values else dict.fromkeys(KEYS)
