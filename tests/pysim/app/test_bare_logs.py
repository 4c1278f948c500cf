"""Columns of logs that nobody has described, and the description made of them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.app.bare_logs import bare_description, guesses, matched
from pysim.app.description import change_description
from pysim.types import BadInput, Dataset

TIME = np.arange(0, 8, 0.005)


def column(name: str, role: str, unit: str) -> dict[str, Any]:
    return {"name": name, "role": role, "unit": unit, "variable": "", "noise": None}


def taken(folder: Path, columns: list[dict[str, Any]], kind: str) -> Dataset:
    """The logs of a folder, read as they were described."""
    content = bare_description(folder, sorted(folder.rglob("*.txt")), columns, kind)
    dataset = change_description(folder / "dataset.toml", content)
    assert dataset is not None
    return dataset


def test_headings_and_the_model_fill_in_what_they_can() -> None:
    assert [one["role"] for one in guesses(("t", "u", "a", "b"))] == ["time", "input", "output", "output"]
    assert [one["role"] for one in guesses(("-", "t", "-", "u", "a"), 1)] == ["-", "time", "-", "input", "output"]
    column = guesses(("t", "u", "x [mm]"))[2]
    assert (column["name"], column["unit"]) == ("x", "mm")
    assert guesses(["x [furlong]"])[0]["unit"] == ""
    assert guesses(["x [mm]"], fixed=True)[0]["name"] == "x [mm]"
    matched(column, [["F", "input", "N", ""], ["X", "output", "m", ""]])
    assert (column["variable"], column["unit"], column["role"]) == ("X", "mm", "output")  # the heading's unit stays
    bare = guesses(("t", "u", "F"))[2]
    matched(bare, [["F", "input", "N", ""]])
    assert (bare["variable"], bare["unit"], bare["role"]) == ("F", "N", "input")
    for name, unit in (("p", "bar"), ("P", "bar")):  # a small letter may be another quantity
        other = guesses((f"{name} [{unit}]",), 1)[0]
        matched(other, [["P", "output", "W", ""]])
        assert other["variable"] == ("P" if name == "P" else "")
    bare["variable"] = ""
    matched(bare, [["F", "input", "N", ""]])
    assert bare["variable"] == ""  # what was chosen stays


@pytest.mark.parametrize(("unit", "si"), [("deg", np.pi / 180), ("bar", 1e5), ("%", 1.0)])
@pytest.mark.parametrize("place", ["O+25_A10", "plain"])  # told by the name, or read off the command
def test_sines_are_described_in_the_unit_of_their_files(tmp_path: Path, place: str, unit: str, si: float) -> None:
    (tmp_path / place).mkdir()
    for frequency in (1, 2):
        wave = 25 + 10 * np.sin(2 * np.pi * frequency * TIME)
        np.savetxt(tmp_path / place / f"{frequency}Hz.txt", np.column_stack([TIME, wave, wave]), fmt="%.5f")
    columns = [column("time", "time", ""), column("command", "input", unit), column("angle", "output", unit)]
    records = taken(tmp_path, columns, "frequency-response").records
    told = [(r.offset, r.amplitude, r.frequency) for r in records]
    np.testing.assert_allclose(told, [(25 * si, 10 * si, 1), (25 * si, 10 * si, 2)], rtol=1e-12)


def test_times_are_in_the_unit_that_was_chosen(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "a.txt", np.column_stack([1000 * TIME, TIME, TIME]), fmt="%.5f")
    columns = [column("time", "time", "ms"), column("u", "input", "V"), column("y", "output", "bar")]
    assert taken(tmp_path, columns, "other").records[0].data.time[-1] == pytest.approx(TIME[-1])
    with pytest.raises(BadInput, match="time is not stated in bar; choose s, ms"):
        taken(tmp_path, [column("time", "time", "bar"), *columns[1:]], "other")
