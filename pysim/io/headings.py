"""The columns of a log that nobody has described yet, as far as it names them itself."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

from pysim.io.named_columns import optional_package
from pysim.io.quotation_marks import unquoted
from pysim.io.text_block import dialect
from pysim.io.text_table import read_text
from pysim.types import BadInput

_LINES = 400  # within which the first row of numbers must stand


def column_names(path: Path) -> tuple[str, ...]:
    """Names of the columns of a log: its own where a header line has as many, else "time", "column 2" and so on.

    Args:
        path: text, .parquet or .tdms.
    Raises:
        BadInput: the file cannot be read, or holds no rows of at least two numbers.
    """
    suffix = path.suffix.lower()
    if suffix in (".parquet", ".tdms"):
        return _named(path, suffix)
    lines = unquoted(read_text(path, path.name), " ").split("\n")[:_LINES]
    rows = [line for line in lines if line.strip() and not line.lstrip().startswith("#")]
    for heading, line in pairwise(["", *rows]):
        separator, decimal = dialect(_trimmed(line))
        row = [field.replace(",", ".") if decimal else field for field in _fields(line, separator)]
        if len(row) > 1 and all(_is_number(field) for field in row):
            above = _fields(heading, separator)  # a blank or a comma in a name is none of the numbers' business
            named = len(above) == len(row) == len(set(above)) and all(above)
            return tuple(above) if named else ("time", *(f"column {k + 1}" for k in range(1, len(row))))
    raise BadInput(f"{path.name} holds no rows of numbers; it needs a column of times and those of the signals")


def _named(path: Path, suffix: str) -> tuple[str, ...]:
    """Of a file that knows its columns."""
    if suffix == ".parquet":
        parquet = optional_package("pyarrow.parquet", f"{path.name} is a Parquet file", "pyarrow")
        try:
            return tuple(parquet.read_schema(path).names)
        except (OSError, ValueError) as error:
            raise BadInput(f"cannot read {path.name} as Parquet ({error}); export it again") from error
    tdms = optional_package("nptdms", f"{path.name} is a TDMS file", "npTDMS")
    try:
        groups = tdms.TdmsFile.read_metadata(path).groups()
    except (OSError, ValueError, KeyError, EOFError) as error:
        raise BadInput(f"cannot read {path.name} as TDMS ({error}); export it again") from error
    names = [channel.name for group in groups for channel in group.channels()]
    return tuple(names if "time" in names else ["time", *names])


def _fields(line: str, separator: str | None) -> list[str]:
    return [field.strip() for field in _trimmed(line).split(separator)]


def _trimmed(line: str) -> str:
    return line.strip().rstrip("\t;,")


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return True
