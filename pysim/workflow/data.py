"""Measurements by the place where they lie, and what their gains are relative to."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from pysim.workflow.shell import command_line

if TYPE_CHECKING:
    from pysim.io.dataset import Described
    from pysim.types import Dataset, FrequencyResponse

BY_DATA: Final = "by data"


def data_of(place: Path | str) -> Dataset:
    """Read a data set.

    Args:
        place: folder with a dataset.toml, or that file.
    Raises:
        BadInput: it cannot be read; of a folder without a description also how to come to one.
    """
    from pysim.io import read_dataset

    return read_dataset(_described(place))


def described_at(place: Path | str) -> Described:
    """A data set with the steps of its preparation still to be done, to be looked at; as `data_of`."""
    from pysim.io import read_described

    return read_described(_described(place))


def _described(place: Path | str) -> Path:
    from pysim.types import BadInput

    place = Path(place)
    if place.is_dir() and not (place / "dataset.toml").exists():
        draft = command_line(["data", "describe", str(place)])
        raise BadInput(f"{place} holds no dataset.toml; name the folder that does, or have one drafted: {draft}")
    return place


def reference_of(
    responses: Iterable[FrequencyResponse], asked: float | Literal["by data"] | None = BY_DATA
) -> float | None:
    """The frequency in Hz to which gains are relative; None for absolute gains.

    Args:
        asked: by the user; where that is left to the data, it is that of the thesis (Eq. 2.12) if every response has
            it, else None.
    """
    from pysim.identify import THESIS_REFERENCE_HZ

    if asked != BY_DATA:
        return asked
    lowest = (abs(response.frequency / THESIS_REFERENCE_HZ - 1).min() for response in responses)
    return THESIS_REFERENCE_HZ if all(away < 1e-6 for away in lowest) else None
