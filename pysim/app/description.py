"""The data set's dataset.toml, edited on the page: signals, units, noise, which records are not fitted.

What edits it changes the `content` of the whole, or the `section` of a signal. What is refused is a `BadInput`.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from pysim.io import log_source, read_described, read_toml, toml_key, toml_table, write_file
from pysim.io.load.headings import name_and_unit
from pysim.io.prepare import HoldOut, prepared
from pysim.types import UNITS, BadInput, Dataset, conversion
from pysim.types.record_kind import RESPONSE_TABLE


def read_description(path: Path) -> dict[str, Any]:
    """What stands in a dataset.toml, in any encoding that the command line takes.

    Raises:
        BadInput: it cannot be read; the folder, which the user did not choose, is not named.
    """
    try:
        return read_toml(path, path.name).whole.values
    except BadInput as error:
        told = str(error).replace(f"{path.parent}{os.sep}", "")
        raise BadInput(f"{told}; drop the folder again") from error


def description_text(content: Mapping[str, Any]) -> str:
    """A dataset.toml with that content."""
    parts = [toml_table("[dataset]", content["dataset"])]
    parts += [toml_table(f"[signals.{toml_key(n)}]", s) for n, s in content["signals"].items()]
    parts += [toml_table("[[records]]", record) for record in content["records"]]
    return "\n".join(parts)


def change_description(path: Path, content: Mapping[str, Any], *, read: bool = True) -> Dataset | None:
    """Write other content into a dataset.toml, which stays as it was where the content is refused.

    Args:
        read: whether to see if it is; an edit that cannot be wrong needs not.
    Returns:
        what it reads as now; None where it was not read.
    """
    before = path.read_bytes() if path.is_file() else None
    write_file(path, description_text(content))
    if not read:
        return None
    try:
        found = read_described(path.parent, partly=True)
        return prepared(found.raw, found.steps)
    except BadInput:
        if before is None:
            path.unlink()
        else:
            write_file(path, before)
        raise


def put_use(content: dict[str, Any], read: Sequence[str], number: int, use: str) -> None:
    """Use a record otherwise: fit it, choose with it, or hold it out.

    Args:
        read: sources of the records that could be read, in order.
        number: which of these. Where other records of its file were refused, all of that file are meant.
        use: one of `pysim.types.dataset.USES`.
    """
    own = [record for record in content["records"] if _source(record) == read[number]]
    steps = [step.get("step") for step in content.get("dataset", {}).get("preparation", [])]
    if not own or HoldOut.word in steps:
        cure = (
            f"write `pysim data prepare ... --step hold_out:{PurePosixPath(read[number]).stem}`, or edit dataset.toml"
        )
        raise BadInput(f"{read[number]}: a step of its preparation says what it is for; {cure}")
    if len(own) == read.count(read[number]):
        own = [own[read[:number].count(read[number])]]
    for record in own:
        record["use"] = use


READ = {"as it looks": None, "held": "zero", "straight lines": "linear", "smooth": "spline"}  # words, and `hold`
ROLES = ("input", "output", "left out")


def put_role(content: dict[str, Any], name: str, role: str) -> None:
    """Another role of a signal, one of ROLES; an output does not say how it runs between samples."""
    content["signals"][name]["role"] = role
    if role != "input":
        content["signals"][name].pop("hold", None)
    if role == ROLES[-1]:
        leave_column_out(content, name)


def put_unit(name: str, section: dict[str, Any], unit: str, logged: str) -> None:
    """Another unit of a signal; one of another quantity, in which it was `logged`, stays in words."""
    section["unit"] = unit
    if logged in UNITS and logged != "1" and not _logged(section) and conversion(logged, unit) is None:
        section["quantity"] = f"{section.get('quantity', name)} [{logged}]"


def _logged(section: Mapping[str, Any]) -> str:
    """The unit that the words of a signal have; "" for none."""
    unit = name_and_unit(str(section.get("quantity", "")))[1]
    return unit if unit in UNITS else ""


def uncounted(name: str, section: Mapping[str, Any]) -> str:
    """What is wrong with a signal that was logged in another quantity; "" where nothing is, or a factor says more."""
    logged, unit = _logged(section), str(section.get("unit"))
    if not logged or conversion(logged, unit) is not None or {"factor", "offset"} & section.keys():
        return ""
    cure = f"write as its factor how many {unit} are 1 {logged}"
    return f"{name} was logged in {logged}, and 1 {logged} counts as 1 {unit} now; {cure}."


def put_steps(content: dict[str, Any], steps: Sequence[Mapping[str, Any]]) -> None:
    """Other steps of preparation, as a description has them."""
    content["dataset"].pop("preparation", None)
    if steps:
        content["dataset"]["preparation"] = [dict(step) for step in steps]


def moved(steps: Sequence[Mapping[str, Any]], number: int, by: int) -> list[Mapping[str, Any]]:
    """Steps with one of them so many places on, or without it where that is 0."""
    others = [one for k, one in enumerate(steps) if k != number]
    if by:
        others.insert(number + by, steps[number])
    return others


BEGINS = {  # words -> `initial` of a record, and what it means
    "near rest": (None, "Where each log begins is estimated, and expected close to the model at rest."),
    "at rest": ("rest", "Each log begins where the model comes to rest at the first value of its inputs."),
    "as the model says": ("model", "Each log begins at the start values that the model gives its states."),
    "anywhere, estimated": ("estimate", "Where each log begins is estimated from the log alone."),
}


def begins(content: Mapping[str, Any]) -> str:
    """How the logs begin, one of BEGINS; "" where they differ."""
    found = {record.get("initial") for record in content["records"]}
    return next((words for words, (one, _) in BEGINS.items() if found == {one}), "")


def begin_logs(content: dict[str, Any], words: str) -> None:
    """Let all logs over time begin so, as one of BEGINS says."""
    for record in content["records"]:
        if record.get("kind") != RESPONSE_TABLE.name:
            record.pop("initial", None)
            if (initial := BEGINS[words][0]) is not None:
                record["initial"] = initial


def leave_column_out(content: dict[str, Any], signal: str) -> None:
    """Read a signal no more."""
    del content["signals"][signal]
    for record in content["records"]:
        if "columns" in record:
            record["columns"] = ["-" if one == signal else one for one in record["columns"]]


def leave_out(content: dict[str, Any], sources: Collection[str]) -> None:
    """Leave out all records of some files."""
    content["records"] = [record for record in content["records"] if _source(record) not in sources]
    if not content["records"]:
        raise BadInput("no record would be left; mend at least one and drop the folder again")


def _source(record: Mapping[str, Any]) -> str:
    return log_source(str(record.get("file")))


def refuse_outside(path: Path) -> None:
    """Every file that a dataset.toml names lies beside it or below."""
    root = path.parent.resolve()
    for record in read_description(path).get("records", []):
        name = record.get("file") if isinstance(record, dict) else None
        if isinstance(name, str) and not (root / name.replace("\\", "/")).resolve().is_relative_to(root):
            raise BadInput(f"{path.name}: file = {name!r} lies outside the data set; put the log beside {path.name}")
