"""`pysim chirp`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import number, text
from pysim.cli.options import DATASET, JSON, OUTPUT, SIGNAL

if TYPE_CHECKING:
    from pysim.identify.chirp import ChirpAnalysis
    from pysim.present.chirp import Chirps
    from pysim.types import Dataset, FrequencyResponse

_UNITS = "%,%"  # of command and response, where none are given


def run(given: Given) -> Chirps:
    """Tops, bottoms and their mean of every chirp."""
    from pysim.identify.chirp import chirp_responses
    from pysim.present.chirp import Chirps

    dataset = given.dataset
    analyses = tuple(chirp_responses(dataset, output=given.signal, level=given.level))
    stepped = tuple(_stepped(dataset, one) if given.output else None for one in analyses)  # figures alone show them
    return Chirps(dataset.name, analyses, stepped)


def _read(given: Given) -> Dataset:
    from pysim.io import read_single_log
    from pysim.types import BadInput
    from pysim.workflow import data_of

    place: Path = given.typed["dataset"]
    if place.is_dir() or place.suffix == ".toml":
        for option in ("columns", "units"):
            if given.typed[option]:
                raise BadInput(f"--{option}: {place} is a data set, whose dataset.toml says that; leave it out")
        return data_of(place)
    if not given.columns:
        raise BadInput(f"{place}: is no data set; for a single log name its columns: --columns time,command,response")
    columns, units = (
        tuple(one.strip() for one in words.split(",")) for words in (given.columns, given.units or _UNITS)
    )
    return read_single_log(place, "chirp", columns, units)


def _stepped(dataset: Dataset, analysis: ChirpAnalysis) -> FrequencyResponse | None:
    """The stepped sines around the chirp's offset with its amplitude, where the data set has some."""
    from pysim.identify import measured_responses
    from pysim.types.record_kind import STEPPED_SINE

    point = (analysis.command.offset, analysis.command.amplitude)
    near = 0.02 * analysis.command.amplitude
    if not any(record.kind == STEPPED_SINE.name for record in dataset.logs()):
        return None
    for one in measured_responses(dataset, output=analysis.output):
        test = one.response.test
        if abs(test.offset - point[0]) < near and abs(test.amplitude - point[1]) < near:
            return one.response
    return None


COMMAND = Command(
    "chirp",
    "Responses of tops, bottoms and their mean from chirp logs.",
    run,
    options=(
        replace(DATASET, about="folder with a dataset.toml, or a single log", metavar="DATASET|LOG", read=_read),
        text("--columns", "TIME,COMMAND,RESPONSE", "column names of a single log, in order; the first is time"),
        text("--units", "UNIT,UNIT", f"units of command and response in a single log ({_UNITS})"),
        SIGNAL,
        number(
            "--level",
            "LEVEL",
            None,
            "level from which tops and bottoms count, in the response's SI unit (the command's offset)",
        ),
        JSON,
        OUTPUT,
    ),
)
