"""`pysim check-fmu`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import Option, Role, switch
from pysim.cli.options import JSON, OUTPUT

if TYPE_CHECKING:
    from pysim.present.fmu_check import Checked


def run(given: Given) -> Checked:
    """Every claim about every FMU."""
    from pysim.fmu_check import check_fmu
    from pysim.io import check_binary, read_model
    from pysim.present.fmu_check import Checked

    reports = []
    for file in given.files:
        model = read_model(file, faulty=True)
        own = model.abilities.stepping
        check_binary(model, own.library if own and not model.abilities.model_exchange else model.abilities.library)
        with given.progress(file.stem) as progress:
            reports.append(check_fmu(file, progress=progress))
    return Checked(tuple(reports), given.strict)


COMMAND = Command(
    "check-fmu",
    "Try FMUs as a strict importer would, and name their faults.",
    run,
    options=(
        Option(("FILES",), "FMUs of any tool, FMI 2 or 3", "FILE.fmu", convert=Path, nargs="+", role=Role.READ),
        switch("--strict", "count doubtful results as failing"),
        JSON,
        OUTPUT,
    ),
    passes=lambda checked: bool(checked.passes),
)
