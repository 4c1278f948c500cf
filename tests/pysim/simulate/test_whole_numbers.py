"""Whole numbers of every size that FMI 3 has are recorded, set and driven as numbers; texts are left out."""

import zipfile
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.io import read_model, read_record
from pysim.simulate import simulate
from pysim.types import BadInput, Experiment, Model
from tests.pysim.simulate.fixture_fmus import WHOLE, build

SIZES = {
    **{f"Int{n}": (-(2.0 ** (n - 1)), 2.0 ** (n - 1) - 1) for n in (8, 16, 32)},
    **{f"UInt{n}": (0.0, 2.0**n - 1) for n in (8, 16, 32)},
    "Int64": (-(2.0**53), 2.0**53),
    "UInt64": (0.0, 2.0**53),
}


@pytest.fixture
def fmu(tmp_path: Path) -> Path:
    """Outputs of each size that hold its largest and its smallest number, a parameter of each, and a text."""
    variables, outputs = "", ""
    for k, size in enumerate(SIZES):
        for name, reference in ((f"high_{size}", 1000 + 2 * k), (f"low_{size}", 1001 + 2 * k)):
            variables += f'<{size} name="{name}" valueReference="{reference}" causality="output"/>'
            outputs += f'<Output valueReference="{reference}"/>'
        variables += f'<{size} name="set_{size}" valueReference="{2000 + 2 * k}" causality="parameter" start="1"/>'
    variables += '<String name="text" valueReference="3000" causality="output"/>'
    outputs += '<Output valueReference="3000"/>'
    path = tmp_path / "whole.fmu"
    with zipfile.ZipFile(build(WHOLE, 3, tmp_path)) as old, zipfile.ZipFile(path, "w") as new:
        for item in old.infolist():
            content = old.read(item)
            if item.filename == "modelDescription.xml":
                text = content.decode().replace("</ModelVariables>", variables + "</ModelVariables>")
                content = text.replace("<Output ", outputs + "<Output ", 1).encode()
            new.writestr(item, content)
    return path


def ran(model: Model, **overrides: float) -> dict[str, float]:
    names = tuple(f"{end}_{size}" for size in SIZES for end in ("low", "high"))
    record = simulate(model, Experiment(np.array([0.0, 1.0]), names, overrides=overrides))
    return dict(zip(names, record.values[-1], strict=True))


def test_every_size_is_read_as_it_lies_in_memory(fmu: Path) -> None:
    found = ran(read_model(fmu))
    assert found == {
        f"{end}_{size}": value for size, ends in SIZES.items() for end, value in zip(("low", "high"), ends, strict=True)
    }


def test_every_size_is_set(fmu: Path) -> None:
    wanted = {f"set_{size}": 7.0 for size in SIZES}
    found = ran(read_model(fmu), **wanted)
    assert {size: found[f"high_{size}"] for size in SIZES} == dict.fromkeys(SIZES, 7.0)


def test_all_outputs_that_are_numbers_are_recorded_by_default(fmu: Path, tmp_path: Path) -> None:
    assert main(["simulate", str(fmu), "--stop", "1", "-o", str(tmp_path / "a.npz")]) == 0
    names = read_record(tmp_path / "a.npz").names
    assert set(names) == {"level", *(f"{end}_{size}" for size in SIZES for end in ("low", "high"))}
    with pytest.raises(BadInput, match="text is String and cannot be recorded"):
        simulate(read_model(fmu), Experiment(np.array([0.0, 1.0]), ("text",)))
