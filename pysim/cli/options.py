"""Options that several commands share."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.option import Option, Role, argument, file, names, text

if TYPE_CHECKING:
    from pysim.cli.command import Given
    from pysim.types import Dataset, Model, Variable

_WHAT = "an .fmu, or a Modelica class"
_BY_DATA = "by data"  # of `--reference-hz`, as pysim.workflow.BY_DATA


def reference_hz(text: str) -> float | str | None:
    """Of `--reference-hz`: a frequency in Hz, None, or that the data are to say it."""
    try:
        return {"none": None, _BY_DATA: _BY_DATA}[text] if text in ("none", _BY_DATA) else float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no frequency; write a number in Hz, or none") from None


def read_parameters(given: Given, model: Model) -> dict[str, float]:
    """Parameters of the model from both options.

    Raises:
        BadInput: a file that cannot be read, no finite number, or a name the model does not have.
    """
    values = parameters_of(given.parameters) if given.parameters else {}
    return settable(values | assigned(given.set, "--set", "the parameter's unit"), model)


def settable(values: dict[str, float], model: Model) -> dict[str, float]:
    """The same values, once they are known to be those of the model's parameters.

    Raises:
        BadInput: no finite number, or a name that the model does not have.
    """
    from pysim.types import BadInput

    for name in values:
        variable = model[name]
        if variable.causality != "parameter":
            raise BadInput(f"{name} of {model.label} has the causality {variable.causality}; set parameters only")
        if not math.isfinite(values[name]):
            raise BadInput(f"{name} = {values[name]}: write a finite number in the parameter's unit, {variable.unit}")
        _warn_beyond(variable, values[name], model)
    return values


def bounded(texts: Sequence[str]) -> dict[str, tuple[float, float]]:
    """Of `--bounds`: parameter -> lower and upper bound in its unit, from words NAME=LOW:HIGH.

    Raises:
        BadInput: another form, or bounds that do not increase.
    """
    from pysim.types import BadInput

    values = {}
    for word in texts:
        name, _, both = word.partition("=")
        try:
            low, high = (float(end) for end in both.split(":"))
        except ValueError:
            form = f"write NAME=LOW:HIGH with numbers in the parameter's unit{point_in_place(both)}"
            raise BadInput(f"--bounds {word}: {form}") from None
        if not low < high:
            raise BadInput(f"--bounds {word}: {low:g} is not below {high:g}; write the lower bound first")
        values[name.strip()] = (low, high)
    return values


def assigned(texts: Sequence[str], option: str, unit: str) -> dict[str, float]:
    """Numbers from words NAME=VALUE.

    Args:
        option, unit: what the words belong to and what the numbers are in, for messages.
    Raises:
        BadInput: no name, or no finite number.
    """
    from pysim.types import BadInput

    values = {}
    for word in texts:
        name, _, value = (part.strip() for part in word.partition("="))
        try:
            values[name] = float(value)
        except ValueError:
            values[name] = math.nan
        if not name or not math.isfinite(values[name]):
            hint = point_in_place(value)
            raise BadInput(f"{option} {word}: write NAME=VALUE with a finite number in {unit}{hint}")
    return values


def point_in_place(text: str) -> str:
    """What to add to a message where numbers have a decimal comma; nothing where they have none."""
    pointed = text.replace(",", ".").strip()
    try:
        _ = [float(number) for number in pointed.split(":")]
    except ValueError:
        return ""
    return f", and a point where the comma is: {pointed}" if "," in text else ""


def _warn_beyond(variable: Variable, value: float, model: Model) -> None:
    """Say that a value is outside its bounds; no error, because published parameter sets lie there too."""
    low = -math.inf if variable.min is None else variable.min
    high = math.inf if variable.max is None else variable.max
    if not low <= value <= high:
        text = f"{variable.name} = {value:g} of {model.label} is outside its bounds, {low:g} to {high:g}"
        print(f"pysim: warning: {text} [{variable.unit}]", file=sys.stderr)


def parameters_of(path: Path) -> dict[str, float]:
    """A TOML file of numbers; dotted names and sections mean the same.

    Raises:
        BadInput: it cannot be read, or holds something else.
    """
    from pysim.io import read_toml

    return _flat(read_toml(path, "--parameters", "write lines NAME = VALUE").whole.values, "", path)


def _flat(table: dict[str, object], prefix: str, path: Path) -> dict[str, float]:
    from pysim.types import BadInput

    values: dict[str, float] = {}
    for key, value in table.items():
        if isinstance(value, dict):
            values |= _flat(value, f"{prefix}{key}.", path)
        elif isinstance(value, int | float) and not isinstance(value, bool):
            values[prefix + key] = float(value)
        else:
            raise BadInput(f"--parameters {path}: {prefix + key} = {value!r} is no number; write NAME = VALUE")
    return values


def _dataset(given: Given) -> Dataset | list[Dataset]:
    from pysim.workflow import data_of

    typed = given.typed["dataset"]
    return [data_of(one) for one in typed] if isinstance(typed, list) else data_of(typed)


def _model(given: Given) -> Model:
    from pysim.present.progress import Working
    from pysim.types import BadInput
    from pysim.workflow import class_in, is_fmu, model_of

    name = given.typed["model"]
    if name.lower().endswith(".mo") or (Path(name).is_dir() and not given.library):
        class_name = "CLASS" if Path(name).is_dir() else class_in(Path(name))
        raise BadInput(f"{name} holds Modelica text; name the class, and where it lies: {class_name} --library {name}")
    with nullcontext() if is_fmu(name) else Working(f"Building {name}"):
        return model_of(name, given.library)


DATASET = argument("DATASET", "folder with a dataset.toml", convert=Path, role=Role.DATA, read=_dataset)
DATASETS = replace(DATASET, about="folder with a dataset.toml; several are taken together", nargs="+")
MODEL = text("--model", "MODEL", _WHAT, required=True, role=Role.READ, read=_model)
MODEL_FIRST = argument("MODEL", _WHAT, role=Role.READ, read=_model)
LIBRARY = file(
    "--library",
    "PATH",
    "Modelica library with the model: folder with package.mo, or .mo file; repeat",
    repeated=True,
    role=Role.READ,
)
PLAN = text("--plan", "PLAN", "a .toml, or a plan of this program: bench-01, thesis", required=True)
SIGNAL = text("--signal", "NAME", "name of the response, if the logs hold several")
REFERENCE_HZ = text(
    "--reference-hz",
    "HZ",
    "frequency in Hz whose gain counts as 0 dB, none for absolute gains, or by data: 0.1 where every test measured it, "
    "else none",
    default=_BY_DATA,
    convert=reference_hz,
)
JSON = file("--json", "FILE", "write all numbers here", suffixes=(".json",))
OUTPUT = Option(
    ("-o", "--output"),
    "write report.html and the plots here: a new or empty folder, or an earlier answer, which is replaced",
    "DIR",
    convert=Path,
    role=Role.FOLDER,
)
SET = text("--set", "NAME=VALUE", "set a parameter, in its own unit; repeat", repeated=True)
PARAMETERS = file(
    "--parameters",
    "FILE.toml",
    "lines NAME = VALUE, in their own units; where both set a parameter, --set wins",
    role=Role.READ,
)
FREE = names("--free", "parameters to fit (all with min, max and nominal that are not set)")
BOUNDS = text(
    "--bounds",
    "NAME=LOW:HIGH",
    "bounds in the parameter's own unit, in place of the model's; without --free they make it free too; repeat",
    repeated=True,
    read=lambda given: bounded(given.typed["bounds"]),
)
