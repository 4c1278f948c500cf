"""`pysim bench`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import DONE, Command, Given
from pysim.cli.option import Option, Role, file, number, text
from pysim.cli.options import LIBRARY, MODEL_FIRST, PARAMETERS, PLAN, SET

if TYPE_CHECKING:
    from pysim.bench import Plan
    from pysim.types import Dataset


def run(given: Given) -> int:
    """Write the data set; 1 when a run stops early, with nothing written."""
    from pysim.bench import read_plan, run_plan, truth_data
    from pysim.cli.options import assigned, read_parameters
    from pysim.cli.outputs import prepare_file, prepare_folder
    from pysim.io import write_dataset, write_file
    from pysim.present.progress import announce_compilation

    plan, model = read_plan(given.plan), given.model
    parameters, strength = read_parameters(given, model), assigned(given.strength, "--strength", "SI units")
    _check_places(given)
    for option, folder in (("--output", given.output), ("--clean", given.clean)):
        if folder is not None:
            prepare_folder(folder.parent, option)
    if given.truth:
        prepare_file(given.truth, "--truth", (".json",))
    announce_compilation()
    with given.progress("tests") as progress:
        data = run_plan(
            model, plan, given.seed, parameters=parameters, effect=given.effect, strength=strength, progress=progress
        )
    units = {name: unit for name, (unit, _) in plan.units.items()}
    write_dataset(given.output, data.dataset, units=units)
    if given.truth:
        write_file(given.truth, json.dumps(truth_data(data.truth), indent=1, allow_nan=False) + "\n")
    if given.clean:
        write_dataset(given.clean, data.truth.clean, units=units)
    print(_summary(given, plan, data.dataset))
    return DONE


def _check_places(given: Given) -> None:
    """A new folder for the data set, and nothing of the truth within it."""
    from pysim.types import BadInput

    output = given.output.resolve()
    for option, path in (("--output", given.output), ("--clean", given.clean)):
        if path is not None and path.exists() and (not path.is_dir() or any(path.iterdir())):
            raise BadInput(f"{option} {path}: something is there already; choose a new folder")
    for option, path in (("--truth", given.truth), ("--clean", given.clean)):
        if path is not None and path.resolve().is_relative_to(output):
            raise BadInput(
                f"{option} {path}: inside the data set, whoever reads that would see it; choose a place outside"
            )
    if given.truth and given.clean and given.truth.resolve().is_relative_to(given.clean.resolve()):
        raise BadInput(
            f"--truth {given.truth}: inside the folder of --clean, which must be new; choose a place beside it"
        )
    if given.clean is not None and output.is_relative_to(given.clean.resolve()):
        raise BadInput(f"--clean {given.clean}: the data set would be inside it; choose a folder beside it")


def _summary(given: Given, plan: Plan, dataset: Dataset) -> str:
    from pysim.types import Record

    rows = sum(record.data.time.size for record in dataset.records if isinstance(record.data, Record))
    told = f"; truth in {given.truth}" if given.truth else ""
    return f"{plan.name}: {len(dataset.records)} logs, {rows} rows in {given.output}{told}"


COMMAND = Command(
    "bench",
    "Drive a model through a test plan and write the data set a bench would.",
    run,
    options=(
        MODEL_FIRST,
        LIBRARY,
        PLAN,
        Option(
            ("-o", "--output"), "new folder for the data set", "FOLDER", convert=Path, required=True, role=Role.PLACE
        ),
        number("--seed", "N", None, "random seed of the noise", convert=int, required=True),
        file("--truth", "FILE.json", "write parameters and effect here, outside FOLDER", role=Role.PLACE),
        file("--clean", "FOLDER2", "write the noise-free signals here, outside FOLDER", role=Role.PLACE),
        SET,
        PARAMETERS,
        text("--effect", "NAME", "name of the effect that the truth file states", default="none"),
        text("--strength", "NAME=VALUE", "strength of the effect that the truth file states", repeated=True),
    ),
)
