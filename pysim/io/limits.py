"""How much is read from files that pack their content: a small file may unpack to more than a machine holds."""

from __future__ import annotations

from dataclasses import dataclass

from pysim.types import setting


@dataclass(frozen=True)
class ReadLimits:
    """Of logs."""

    file_numbers: int = setting(
        60_000_000,
        unit="numbers",
        meaning="rows times named columns of one Parquet or TDMS file",
        source="a log of 10 million rows with a time, a command and four signals; measured: 1.5 GB while it is read",
    )
    file_bytes: int = setting(
        1_000_000_000,
        unit="bytes",
        meaning="the named columns of one Parquet file once unpacked, as its directory gives them",
        source="16 bytes for each of these numbers, as a text of 16 digits takes",
    )
    memory: int = setting(
        300_000_000,
        unit="bytes",
        meaning="taken while a Parquet file is read, beside four times what its directory announces",
        source="what pyarrow and other threads take by themselves; no computer is harmed by it",
    )
    dataset_numbers: int = setting(
        120_000_000,
        unit="numbers",
        meaning="times and values of all logs of a data set",
        source="two of the largest logs: 1 GB as float64, an eighth of a small computer's memory",
    )
    batch_rows: int = setting(
        65_536,
        unit="rows",
        meaning="of a Parquet file that are unpacked at a time",
        source="what pyarrow takes where nothing is said; 0.5 MB a column",
    )


LIMITS = ReadLimits()
