"""A data set on a command line."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Dataset


def read_measurements(place: Path) -> Dataset:
    """Read a data set.

    Raises:
        BadInput: it cannot be read; of a folder without a description also how to come to one.
    """
    from pysim.cli.outputs import command_line
    from pysim.io import read_dataset
    from pysim.types import BadInput

    if place.is_dir() and not (place / "dataset.toml").exists():
        draft = command_line(["data", "describe", str(place)])
        raise BadInput(f"{place} holds no dataset.toml; name the folder that does, or have one drafted: {draft}")
    return read_dataset(place)
