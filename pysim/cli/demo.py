"""Build the thesis' pump, run its 18 tests for both parameter sets, and report."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Comparison, Dataset, Model

QUICK_FREQUENCIES_HZ = (0.1, 1, 3, 6, 10, 15, 20, 30)
_TITLE = "The pump's swash plate against the transfer functions of thesis Table 4.1"
_TABLES = {"free": "4.8", "locked": "4.7"}
_CAVEATS: dict[str, tuple[str, ...]] = {
    "free": (),
    "locked": (
        "At 75/20 and -75/20 the volume of a chamber (Eq. 3.5) reaches zero inside the stroke with this set, 21.1 cm3 "
        "against 21.5 cm3 swept. The model has a floor there; what the thesis' program did is not known.",
    ),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim demo`."""
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, default=Path("results/demo"), help="(results/demo)")
    parser.add_argument("--quick", action="store_true", help="8 frequencies in place of 19")


def run(args: argparse.Namespace) -> int:
    """Print both tables and leave report.html, plots, JSON, the FMUs and the data set; 0 when that is done."""
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    from pysim.cli._pictures import draw_picture, write_pictures
    from pysim.cli.outputs import prepare_folder, repeating
    from pysim.cli.progress import Working
    from pysim.io import read_dataset, write_file
    from pysim.present.comparison import Comparisons, comparison_text, data, page
    from validation.thesis import FREQUENCIES_HZ, write_dataset

    folder = prepare_folder(args.output)
    frequencies = QUICK_FREQUENCIES_HZ if args.quick else FREQUENCIES_HZ
    # On two cores the solver is compiled while the models are built, and pictures are drawn while the models run.
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as helpers:
        compiled = helpers.submit(_build_kernel)
        models = {label: _build(label, folder) for label in _TABLES}
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
    remarks = () if args.quick else tuple(part for one in comparisons for part in _against_the_thesis(one))
    result = Comparisons(_TITLE, tuple(comparisons), remarks)
    write_file(folder / "comparison.json", json.dumps(data(result), indent=1, allow_nan=False))
    write_file(folder / "report.html", page(result, pictures, repeating(args)))
    print(f"Report: {folder / 'report.html'}")
    return 0


def _build_kernel() -> None:
    from pysim.simulate import build_kernel

    build_kernel()


def _build(label: str, folder: Path) -> Model:
    """One parameter set's FMU."""
    from pysim.cli.progress import Working
    from validation.pump import CLASSES, pump_model

    with Working(f"Building {CLASSES[label]}"):
        return pump_model(label, output=folder / f"{CLASSES[label].rpartition('.')[2]}.fmu")


def _compare(label: str, model: Model, dataset: Dataset) -> Comparison:
    """Run all tests through one model."""
    from pysim.cli.progress import ProgressBar
    from pysim.diagnose import compare
    from validation.pump import SOURCES

    with ProgressBar(f"{label} set") as progress:
        return compare(model, dataset, label=label, about=SOURCES[label], progress=progress)


def _against_the_thesis(comparison: Comparison) -> list[str]:
    """Our numbers beside the thesis' own, and why they differ."""
    from pysim.present.page import cell, heading, items, table
    from validation.thesis import differences, explain

    printed = _TABLES[comparison.label]
    rows = differences(comparison, printed)
    head = ["offset %", "amplitude %"]
    for name, unit in (("mean", "dB"), ("max", "dB"), ("mean", "deg"), ("max", "deg")):
        head += [f"{name} {unit}", "thesis", "fit"]
    cells = [
        [cell(f"{row.offset:g}"), cell(f"{row.amplitude:g}")]
        + [
            cell(f"{value:.{2 if i < 2 else 1}f}")
            for i in range(4)
            for value in (row.ours[i], row.printed[i], row.misfit[i])
        ]
        for row in rows
    ]
    caption = f"{comparison.label}: this page | thesis Table {printed} | misfit of the transfer function, Table 4.4"
    title = f"Where and why this differs from thesis Table {printed} ({comparison.label} set)"
    return [heading(title), items([*explain(rows, printed), *_CAVEATS[comparison.label]]), table(caption, head, cells)]
