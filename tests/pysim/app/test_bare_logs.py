"""Columns of logs that nobody has described, and the data set made of them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.app.bare_logs import add_logs, describe_logs, guesses, matched
from pysim.app.description import description_text, read_description, uncounted
from pysim.io import read_dataset, write_dataset
from pysim.io.load import READERS
from pysim.types import BadInput, Dataset, Record
from tests.toy import measured

TIME = np.arange(0, 8, 0.005)


def guessed(folder: Path, head: str, *rows: str) -> list[dict[str, Any]]:
    """Of a log with that heading."""
    path = folder / "log.csv"
    path.write_text("\n".join([head, *rows, ""]))
    return guesses(READERS[".csv"](path)[0])


def column(
    heading: str, name: str, role: str, unit: str, variable: str = "", noise: float | None = None
) -> dict[str, Any]:
    return {"heading": heading, "name": name, "role": role, "unit": unit, "variable": variable, "noise": noise}


def taken(folder: Path, columns: list[dict[str, Any]], kind: str = "other") -> Dataset:
    """The logs of a folder, read as they were described."""
    describe_logs(folder, columns, kind, folder.parent / "described")
    return read_dataset(folder.parent / "described")


def test_headings_and_the_model_fill_in_what_they_can(tmp_path: Path) -> None:
    rows = [f"{k / 10},{k % 3},{k % 5},{k % 4}" for k in range(20)]
    found = guessed(tmp_path, "t,u,a,b", *rows)
    assert [one["role"] for one in found] == ["time", "input", "output", "output"]
    behind = [f"{'on' if k % 2 else 'off'},{k / 10},{k % 3},{k % 5}" for k in range(20)]
    assert [one["role"] for one in guessed(tmp_path, "state,t,u,a", *behind)] == ["-", "time", "input", "output"]
    column = guessed(tmp_path, "t,u,x [mm],y [furlong]", *rows)[2]
    assert (column["name"], column["unit"]) == ("x", "mm")
    assert guessed(tmp_path, "t,u,x [mm],y [furlong]", *rows)[3]["unit"] == ""
    matched(column, [["F", "input", "N", ""], ["X", "output", "m", ""]])
    assert (column["variable"], column["unit"], column["role"]) == ("X", "mm", "output")  # the heading's unit stays
    bare = guessed(tmp_path, "t,u,F,b", *rows)[2]
    matched(bare, [["F", "input", "N", ""]])
    assert (bare["variable"], bare["unit"], bare["role"]) == ("F", "N", "input")
    for name in ("p", "P"):  # a small letter may be another quantity
        other = guessed(tmp_path, f"t,{name} [bar],a,b", *rows)[1]
        matched(other, [["P", "output", "W", ""]])
        assert other["variable"] == ("P" if name == "P" else "")
    bare["variable"] = ""
    matched(bare, [["F", "input", "N", ""]])
    assert bare["variable"] == ""  # what was chosen stays


def test_a_date_is_the_clock_and_times_are_seconds_from_its_first(tmp_path: Path) -> None:
    folder = tmp_path / "logs"
    folder.mkdir()
    rows = [f"2026-03-01 10:00:{k / 4:06.3f};{k % 3},5;{k % 7}" for k in range(40)]
    found = guessed(folder, "Zeitstempel;u;p [bar]", *rows)
    assert [one["role"] for one in found] == ["time", "input", "output"]
    found[1]["unit"], found[2]["noise"] = "V", 0.5
    data = taken(folder, found)
    log = data.logs()[0].data
    assert isinstance(log, Record)
    assert log.time == pytest.approx(np.arange(40) / 4, abs=1e-9)
    assert log["u"][:3].tolist() == [0.5, 1.5, 2.5]
    assert (log["p"][1], data.signal("p").noise) == (1e5, 0.5e5)


def test_the_last_of_several_is_held_out_and_what_lacks_is_said(tmp_path: Path) -> None:
    folder = tmp_path / "logs"
    folder.mkdir()
    for name in "ab":
        (folder / f"{name}.txt").write_text("0 1 2 7\n1 2 3 7\n2 3 4 7\n")
    own = [column("column 1", "t", "time", "s"), column("column 2", 'odd "name"', "input", "%", "cmd")]
    own += [column("column 3", "p", "output", "bar", noise=0.5), column("column 4", "rest", "-", "")]
    for wrong, words in (
        (own[:1], "choose one as time, and at least one input and one output"),
        ([*own[:2], {**own[2], "unit": ""}], "p: choose a unit, or a dash to leave the column out"),
        ([*own[:3], {**own[3], "role": "output", "name": "p"}], "two have the same name"),
        ([*own[:2], {**own[2], "heading": "q"}], "^a.txt has no column 'q'"),  # without the folder
    ):
        with pytest.raises(BadInput, match=words):
            taken(folder, wrong)
    data = taken(folder, own)
    assert [record.use for record in data.records] == ["fit", "validate"]
    assert data.signal('odd "name"').variable == "cmd"
    assert data.logs()[0].data["p"].tolist() == [2e5, 3e5, 4e5]  # type: ignore[index]


@pytest.mark.parametrize(("unit", "si"), [("deg", np.pi / 180), ("bar", 1e5), ("%", 1.0)])
@pytest.mark.parametrize("place", ["O+25_A10", "plain"])  # told by the name, or read off the command
def test_sines_are_described_in_the_unit_of_their_files(tmp_path: Path, place: str, unit: str, si: float) -> None:
    folder = tmp_path / "logs"
    (folder / place).mkdir(parents=True)
    for frequency in (1, 2):
        wave = 25 + 10 * np.sin(2 * np.pi * frequency * TIME)
        np.savetxt(folder / place / f"{frequency}Hz.txt", np.column_stack([TIME, wave, wave]), fmt="%.5f")
    columns = [column("column 1", "time", "time", ""), column("column 2", "command", "input", unit)]
    columns.append(column("column 3", "angle", "output", unit))
    records = taken(folder, columns, "frequency-response").records
    told = [(r.offset, r.amplitude, r.frequency) for r in records]
    np.testing.assert_allclose(told, [(25 * si, 10 * si, 1), (25 * si, 10 * si, 2)], rtol=1e-12)


def test_times_are_in_the_unit_that_was_chosen(tmp_path: Path) -> None:
    folder = tmp_path / "logs"
    folder.mkdir()
    np.savetxt(folder / "a.txt", np.column_stack([1000 * TIME, TIME, TIME]), fmt="%.5f")
    own = [column("column 2", "u", "input", "V"), column("column 3", "y", "output", "bar")]
    with pytest.raises(BadInput, match="is in 'bar', which is no unit of time"):
        taken(folder, [column("column 1", "time", "time", "bar"), *own])
    log = taken(folder, [column("column 1", "time", "time", "ms"), *own]).records[0].data
    assert log.time[-1] == pytest.approx(TIME[-1])  # type: ignore[union-attr]


def test_each_heading_tells_the_unit_of_its_own_clock(tmp_path: Path) -> None:
    folder = tmp_path / "logs"
    folder.mkdir()
    for name, unit, factor in (("a", "ms", 1000), ("b", "s", 1)):
        table = np.column_stack([factor * TIME, TIME, TIME])
        np.savetxt(folder / f"{name}.csv", table, "%.6f", ",", header=f"time [{unit}],u [V],y [bar]", comments="")
    chosen = [column("time [ms]", "time", "time", "ms"), column("u [V]", "u", "input", "V")]
    data = taken(folder, [*chosen, column("y [bar]", "y", "output", "bar")])
    for log in data.logs():
        assert log.data.time == pytest.approx(TIME, abs=1e-6)  # type: ignore[union-attr]


def test_a_heading_in_volts_is_remembered_where_another_quantity_is_chosen(tmp_path: Path) -> None:
    folder = tmp_path / "logs"
    folder.mkdir()
    (folder / "a.csv").write_text("\n".join(["t [s],F [N],p [V]", *(f"{k / 10},{k % 3},{k % 5}" for k in range(20))]))
    columns = [column("t [s]", "t", "time", "s"), column("F [N]", "F", "input", "kN")]
    describe_logs(folder, [*columns, column("p [V]", "p", "output", "bar")], "other", tmp_path / "described")
    own = read_description(tmp_path / "described/dataset.toml")["signals"]
    assert (own["p"]["quantity"], own["F"]["quantity"]) == ("p [V]", "F")
    assert "1 V counts as 1 bar" in uncounted("p", own["p"])


HEAD, ROWS = "t [s],F [N],x [mm]", [f"{k / 10},{k % 3},{k % 5}" for k in range(20)]
CHOSEN = [column("t [s]", "t", "time", "s"), column("F [N]", "F", "input", "N"), column("x [mm]", "x", "output", "mm")]


def logs_in(folder: Path, **heads: str) -> Path:
    """A folder of logs with these headings; each has a first row of its own."""
    folder.mkdir()
    for name, head in heads.items():
        (folder / f"{name}.csv").write_text("\n".join([head, f"-1,{sum(map(ord, name + folder.name)) % 97},7", *ROWS]))
    return folder


def test_more_logs_are_described_as_those_before_and_one_takes_the_place_of_its_namesake(tmp_path: Path) -> None:
    data = tmp_path / "data"
    describe_logs(logs_in(tmp_path / "first", a=HEAD, b=HEAD), CHOSEN, "other", data)
    content = read_description(data / "dataset.toml")
    content["signals"]["x"]["noise"] = 0.5
    (data / "dataset.toml").write_text(description_text(content))
    add_logs(logs_in(tmp_path / "more", b=HEAD, c=HEAD), data, tmp_path / "all")
    found = read_dataset(tmp_path / "all")
    assert [(one.source, one.use) for one in found.records] == [
        ("a.csv", "fit"),
        ("b.csv", "validate"),
        ("c.csv", "fit"),
    ]
    assert found.signal("x").noise == pytest.approx(0.5e-3)
    first, second = (record.data for record in (read_dataset(data).records[1], found.records[1]))
    assert isinstance(first, Record)
    assert isinstance(second, Record)
    assert first["F"][0] != second["F"][0]  # the file that came
    assert first["F"][1:].tolist() == second["F"][1:].tolist()
    with pytest.raises(BadInput, match=r"d.csv has no column 'x \[mm\]', but 't', 'F', 'y'; all logs need the same"):
        add_logs(logs_in(tmp_path / "other", d="t,F,y"), data, tmp_path / "none")


def test_more_logs_that_nobody_has_described_lie_beside_the_others(tmp_path: Path) -> None:
    add_logs(logs_in(tmp_path / "more", b=HEAD), logs_in(tmp_path / "data", a=HEAD, b=HEAD), tmp_path / "all")
    assert sorted(path.name for path in (tmp_path / "all").iterdir()) == ["a.csv", "b.csv"]
    assert (tmp_path / "all/b.csv").read_bytes() == (tmp_path / "more/b.csv").read_bytes()


def test_a_data_set_of_the_user_takes_logs_of_its_own_form_and_no_others(tmp_path: Path) -> None:
    data = write_dataset(tmp_path / "data", measured(1)).parent
    more = tmp_path / "more"
    more.mkdir()
    (more / "c.txt").write_bytes((data / "a.txt").read_bytes())
    add_logs(more, data, tmp_path / "all")
    assert [one.source for one in read_dataset(tmp_path / "all").records] == ["a.txt", "b.txt", "c.txt"]
    (more / "c.txt").write_text("only words")
    with pytest.raises(BadInput, match="or put the data set aside"):
        add_logs(more, data, tmp_path / "none")


def test_headings_of_logs_may_differ_in_a_unit_that_one_has_and_the_other_lacks(tmp_path: Path) -> None:
    folder = logs_in(tmp_path / "logs", a=HEAD, b="t,F,x")
    describe_logs(folder, CHOSEN, "other", tmp_path / "described")
    first, second = (record.data for record in read_dataset(tmp_path / "described").records)
    assert isinstance(first, Record)
    assert isinstance(second, Record)
    assert first["x"][1:].tolist() == second["x"][1:].tolist()
    other = logs_in(tmp_path / "other", a=HEAD, b="t,F,x [m]")
    with pytest.raises(BadInput, match=r"b.csv has 'x \[m\]', and another log 'x \[mm\]'; give all logs one unit"):
        describe_logs(other, CHOSEN, "other", tmp_path / "none")
