"""`pysim data check` and `pysim data describe`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import DONE, Command, Given
from pysim.cli.option import Role, argument, file, names, text
from pysim.cli.options import DATASET, JSON, LIBRARY, MODEL, OUTPUT

if TYPE_CHECKING:
    from pysim.identify.data_check import DataCheck
    from pysim.io.dataset import Described
    from pysim.types import MeasuredSignal


def _check(given: Given) -> DataCheck:
    """What is in it, and what should be looked at, beside a model too."""
    from pysim.nouns.data import Data
    from pysim.nouns.model import model
    from pysim.types import BadInput

    if given.library and not given.typed["model"]:
        raise BadInput("--library: no model is named; add --model, or leave --library out")
    beside = model(given.model, library=given.library) if given.typed["model"] else None
    return Data.of(given.dataset).check(beside).result


def _describe(given: Given) -> int:
    """Write the draft; never over a description that is there."""
    from pysim.io import draft_dataset, draft_text, write_file
    from pysim.types import BadInput
    from pysim.workflow import command_line

    target = given.folder / "dataset.toml"
    if not given.folder.is_dir():
        raise BadInput(f"{given.folder} is no folder; name the folder of the logs")
    if target.exists():
        raise BadInput(f"{target} is there already and stays as it is; remove it first where it is to be drafted anew")
    found = draft_dataset(given.folder, _units(given.input), _units(given.response))
    write_file(target, draft_text(found))
    print(
        f"Drafted: {target}, {len(found.columns)} log{'s' * (len(found.columns) > 1)}, signals {', '.join(found.roles)}"
    )
    for remark in found.remarks:
        print(f"  {remark}")
    if found.without_unit:
        print(f"  to fill in: the unit of {', '.join(found.without_unit)}")
    print(f"Look through it, then: {command_line(['data', 'check', str(given.folder)])}")
    return DONE


def _prepare(given: Given) -> int:
    """Raw logs with the steps that make them ready, as a new data set."""
    from pysim.io.prepare import step_typed
    from pysim.nouns.data import load

    steps = [step_typed(word) for word in given.step]
    inputs, outputs = _columns(given.input), _columns(given.response)
    if inputs or outputs:
        units = {name: unit for name, unit in (inputs | outputs).items() if unit}
        data = load(given.source, inputs=list(inputs), outputs=list(outputs), time=given.time, units=units)
    else:
        data = load(given.source)
    for remark in dict.fromkeys(remark for remarks in data.remarks.values() for remark in remarks):
        print(f"  {remark}")
    data = data.after(*steps)
    target = data.save(given.into)
    print(f"{data}\nWritten: {target}, with the raw logs and {len(data.history)} steps that every command does again")
    return DONE


def _columns(texts: list[str]) -> dict[str, str]:
    """Heading -> unit, "" where the heading tells it: of F, F:kN, and x [mm]."""
    parts = [one.rpartition(":") for one in texts]
    return {name.strip() or unit.strip(): unit.strip() if colon else "" for name, colon, unit in parts}


def _units(texts: list[str]) -> dict[str, str]:
    """Signal -> unit in the files."""
    from pysim.io.units import unit_cure
    from pysim.types import UNITS, BadInput

    signals = [_signal("input", text) for text in texts]
    for signal in signals:
        if signal.unit not in UNITS:
            raise BadInput(f"signal {signal.name}: unit = {signal.unit!r} is not known; {unit_cure(signal.unit)}")
    return {signal.name: signal.unit for signal in signals}


def _read(given: Given) -> Described:
    from pysim.io import read_thesis_folder
    from pysim.io.dataset import Described
    from pysim.types import BadInput
    from pysim.workflow import described_at

    inputs, responses = given.input, given.response
    if not (inputs or responses):
        return described_at(given.typed["dataset"])
    if len(inputs) != 1 or not responses:
        raise BadInput("logs without a dataset.toml need one --input NAME:UNIT and at least one --response NAME:UNIT")
    signals = [_signal("input", inputs[0]), *(_signal("output", text) for text in responses)]
    return Described(read_thesis_folder(given.typed["dataset"], signals), (), {})


def _signal(role: str, text: str) -> MeasuredSignal:
    from pysim.types import BadInput, MeasuredSignal

    name, colon, unit = (part.strip() for part in text.rpartition(":"))
    if not (name and colon and unit):
        raise BadInput(f"{text}: write NAME:UNIT, as alphaCMD:%")
    return MeasuredSignal(name, role, unit, name, name)


_COMMAND = "the command, second column of logs without a dataset.toml whose names tell their frequency"
_DRIVES = "inputs, by their headings or in the order of the columns (the second)"
_BEHIND = "outputs, the columns behind it"

COMMAND = Command(
    "data",
    "Say what a data set holds and what should be looked at; draft a dataset.toml for plain logs.",
    parts=(
        Command(
            "check",
            "read a data set and print what it holds",
            _check,
            options=(
                replace(DATASET, about="folder with a dataset.toml, or that file", read=_read),
                names("--input", _COMMAND, "NAME:UNIT,..."),
                names("--response", _BEHIND, "NAME:UNIT,..."),
                replace(
                    MODEL, about="model to check signs, units and columns with: an .fmu or a class", required=False
                ),
                LIBRARY,
                JSON,
                OUTPUT,
            ),
        ),
        Command(
            "describe",
            "draft a dataset.toml into a folder of logs that has none",
            _describe,
            options=(
                argument("FOLDER", "folder of logs; nothing else in it is changed", convert=Path),
                names("--input", _DRIVES, "NAME:UNIT,..."),
                names("--response", _BEHIND, "NAME:UNIT,..."),
            ),
        ),
        Command(
            "prepare",
            "write a new data set from logs of any form, with steps that make them ready",
            _prepare,
            options=(
                argument("SOURCE", "a data set, or a file, folder or pattern of logs", role=Role.READ),
                text("--step", "STEP:...", "preparation step such as flip:x or trim:start=0.5; repeat", repeated=True),
                names("--input", "inputs, by their headings; commas or repeat", "NAME[:UNIT],..."),
                names("--response", "outputs, by their headings; commas or repeat", "NAME[:UNIT],..."),
                text("--time", "HEADING", "heading of the time column, if several could be it"),
                file("--into", "FOLDER", "new folder for the data set", role=Role.PLACE, required=True),
            ),
        ),
    ),
)
