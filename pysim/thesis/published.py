"""The thesis' own deviations between models and measurements (Tables 4.4, 4.7 and 4.8)."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.thesis.printed import printed_table


@dataclass(frozen=True)
class PublishedDeviations:
    """One printed row: mean and largest deviation in dB, then in degrees, and the printed verdict."""

    offset: float
    amplitude: float
    values: tuple[float, float, float, float]
    passes: bool


def published_deviations(table: str) -> tuple[PublishedDeviations, ...]:
    """All 18 rows of a table.

    Args:
        table: "4.4" (transfer functions), "4.7" (locked set) or "4.8" (free set).
    """
    return tuple(
        PublishedDeviations(
            float(row["offset_percent"]),
            float(row["amplitude_percent"]),
            (float(row["mean_db"]), float(row["max_db"]), float(row["mean_deg"]), float(row["max_deg"])),
            row["passes"] == "yes",
        )
        for row in printed_table(table)
    )
