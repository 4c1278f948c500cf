"""`pysim demo`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import DONE, Command, Given
from pysim.cli.option import Role, switch
from pysim.cli.options import OUTPUT

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from pysim.present import Drawing
    from pysim.types import Comparison, Dataset, Model

QUICK_FREQUENCIES_HZ = (0.1, 1, 3, 6, 10, 15, 20, 30)
_TITLE = "The pump's swash plate against the transfer functions of thesis Table 4.1"


def run(given: Given) -> int:
    """Print both tables, and leave report.html, plots, JSON, the FMUs and the data set as each is there."""
    from pysim.cli.outputs import prepare_folder
    from pysim.identify.greybox import helper_processes
    from pysim.io import read_dataset, write_file
    from pysim.present.comparison import Comparisons, comparison_text, data, page
    from pysim.present.progress import Working
    from pysim.simulate import build_kernel
    from pysim.thesis import CLASSES, FREQUENCIES_HZ, write_dataset
    from pysim.thesis.page import against_the_thesis

    folder = prepare_folder(given.output)
    frequencies = QUICK_FREQUENCIES_HZ if given.quick else FREQUENCIES_HZ
    # On two cores the solver is compiled while the models are built, and pictures are drawn while the models run.
    with helper_processes(2) as helpers:
        compiled = helpers.submit(build_kernel)
        models = {label: _build(label, folder) for label in CLASSES}
        dataset = read_dataset(write_dataset(folder / "measurements", frequencies))
        with Working("Compiling the solver, once on this machine"):
            compiled.result()
        free = _compare("free", models["free"], dataset)
        early = helpers.submit(draw_picture, (free,), folder, "bode_O+50")  # something to look at
        comparisons = [free, _compare("locked", models["locked"], dataset)]
        for comparison in comparisons:
            print(comparison_text(comparison), end="\n\n")
        with Working("Drawing pictures"):
            early.result()  # or it could be written after the last picture of its name
            pictures = write_pictures(comparisons, folder, helpers)
    # with fewer frequencies the largest deviations are others, and the thesis' tables cannot be held against them
    remarks = () if given.quick else tuple(part for one in comparisons for part in against_the_thesis(one))
    result = Comparisons(_TITLE, tuple(comparisons), remarks)
    write_file(folder / "comparison.json", json.dumps(data(result), indent=1, allow_nan=False))
    write_file(folder / "report.html", page(result, pictures, given.repeated))
    print(f"Report: {folder / 'report.html'}")
    return DONE


def write_pictures(comparisons: Sequence[Comparison], folder: Path, executor: Executor) -> list[Drawing]:
    """Write deviations and a Bode plot per offset, several at a time."""
    from pysim.present.comparison import picture_names

    return list(executor.map(partial(draw_picture, tuple(comparisons), folder), picture_names(comparisons)))


def draw_picture(comparisons: Sequence[Comparison], folder: Path, name: str) -> Drawing:
    """Write one of the pictures."""
    from pysim.present.comparison import comparison_picture
    from pysim.present.render import draw

    return draw(comparison_picture(comparisons, name), folder)


def _build(label: str, folder: Path) -> Model:
    """One parameter set's FMU."""
    from pysim.present.progress import Working
    from pysim.thesis import CLASSES, pump_model

    with Working(f"Building {CLASSES[label]}"):
        return pump_model(label, output=folder / f"{CLASSES[label].rpartition('.')[2]}.fmu")


def _compare(label: str, model: Model, dataset: Dataset) -> Comparison:
    """Run all tests through one model."""
    from pysim.identify import compare_responses
    from pysim.present.progress import ProgressBar
    from pysim.thesis import SOURCES

    with ProgressBar(f"{label} set") as progress:
        return compare_responses(model, dataset, label=label, about=SOURCES[label], progress=progress)


COMMAND = Command(
    "demo",
    "Build the thesis' pump, run its 18 tests for both parameter sets, and report.",
    run,
    options=(
        replace(OUTPUT, about="write everything here (results/demo)", default=Path("results/demo"), role=Role.VALUE),
        switch("--quick", "run 8 frequencies, not 19"),
    ),
)
