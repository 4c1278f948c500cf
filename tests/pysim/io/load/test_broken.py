"""Files as benches break them: each is read rightly, or refused in one sentence with file, place and cure."""

from __future__ import annotations

import re
from collections.abc import Callable
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.nouns.data import load
from pysim.types import BadInput, Record
from tests.pysim.io.load.files import write_mat73, write_xlsx

N = 40
TIME = np.round(np.arange(N) / 100, 6)
FORCE, PLACE = np.round(np.sin(20 * TIME), 6), np.round(2 * np.cos(15 * TIME), 6)
ROWS = np.column_stack([TIME, FORCE, PLACE]).tolist()
HEAD = "t [s],F [kN],x [mm]"
LINES = [",".join(map(repr, row)) for row in ROWS]


def of_lines(*lines: str, end: str = "\n", coding: str = "utf-8", name: str = "log.csv") -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        (folder / name).write_bytes(end.join(lines).encode(coding))
        return folder / name

    return write


def decimal(lines: list[str], separator: str = ";") -> list[str]:
    """With decimal commas."""
    return [line.replace(",", separator).replace(".", ",") for line in lines]


def sheet(rows: list[list[Any]], merged: tuple[str, ...] = (), **more: list[list[Any]]) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        pytest.importorskip("python_calamine")
        return write_xlsx(folder / "log.xlsx", {"Data": rows, **more}, merged)

    return write


def matlab(**variables: Any) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        pytest.importorskip("scipy.io").savemat(folder / "log.mat", variables)
        return folder / "log.mat"

    return write


def matlab73(**variables: Any) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        pytest.importorskip("h5py")
        return write_mat73(folder / "log.mat", variables)

    return write


BEGIN = datetime(2026, 3, 1, 14, 5)
DATED = [f"{BEGIN + timedelta(seconds=t):%d.%m.%Y %H:%M:%S.%f}" for t in TIME]
GERMAN = [f"{d};{f};{x}".replace(".", ",") for d, f, x in zip(TIME, FORCE, PLACE, strict=True)]
UNITS = {"units": {"F": "kN", "x": "mm"}}

# name: file, what is said beside it
READ: dict[str, tuple[Callable[[Path], Path], dict[str, Any]]] = {
    "byte order mark": (of_lines(HEAD, *LINES, coding="utf-8-sig"), {}),
    "UTF-16 of a Windows program": (of_lines(HEAD, *LINES, coding="utf-16"), {}),
    "Latin-1 with a degree sign": (of_lines("# Öl 40 °C", HEAD, *LINES, coding="latin-1"), {}),
    "ends of lines of an old Mac": (of_lines(HEAD, *LINES, end="\r"), {}),
    "decimal commas and semicolons": (of_lines(HEAD.replace(",", ";"), *decimal(LINES)), {}),
    "a row of units": (of_lines("t,F,x", "s,kN,mm", *LINES), {}),
    "a row of units in brackets": (of_lines("t;F;x", "[s];[kN];[mm]", *decimal(LINES)), {}),
    "a story above the headings": (of_lines("Bench 3", "Operator: Eva", "Rate: 100", "", HEAD, *LINES), {}),
    "headings in a comment": (of_lines("# t [s], F [kN], x [mm]", *LINES), {}),
    "mixed separators": (of_lines(HEAD, *LINES[:20], *(one.replace(",", "\t") for one in LINES[20:])), {}),
    "a separator at the end of every row": (of_lines(HEAD + ",", *(one + "," for one in LINES)), {}),
    "fields in quotation marks": (
        of_lines('"t [s]","F [kN]","x [mm]"', *('"' + one.replace(",", '","') + '"' for one in LINES)),
        {},
    ),
    "a last row cut off by a power failure": (of_lines(HEAD, *LINES, "0.4,0.9"), {}),
    "a note below the numbers": (of_lines(HEAD, *LINES, "", "Test ended by operator"), {}),
    "every row written twice by the logger": (of_lines(HEAD, *(one for one in LINES for _ in "ab")), {}),
    "German dates with decimal commas": (
        of_lines("Zeit;F [kN];x [mm]", *(f"{d};{g.split(';', 1)[1]}" for d, g in zip(DATED, GERMAN, strict=True))),
        {},
    ),
    "minus signs of a word processor": (of_lines(HEAD, *(one.replace("-", "\N{MINUS SIGN}") for one in LINES)), {}),
    "LabVIEW without its column of times": (
        of_lines(
            *("LabVIEW Measurement\t", "***End_of_Header***\t", "Y_Unit_Label\tkN\tmm", "X0\t0,0\t0,0"),
            *("Delta_X\t0,01\t0,01", "***End_of_Header***\t\t", "\tF\tx\tComment"),
            *(f"\t{f}\t{x}\t".replace(".", ",") for _, f, x in ROWS),
            name="log.lvm",
        ),
        {},
    ),
    "a column of words": (of_lines(HEAD + ",state", *(one + ",running" for one in LINES)), {}),
    "a counter ahead of the time": (of_lines("n," + HEAD, *(f"{k},{one}" for k, one in enumerate(LINES))), {}),
    "time in the last column": (
        of_lines("F [kN],x [mm],time [ms]", *(f"{f},{x},{1e3 * t:.1f}" for t, f, x in ROWS)),
        {},
    ),
    "Excel with a merged header": (
        sheet([["", "Cylinder", None], ["t [s]", "F [kN]", "x [mm]"], *ROWS], ("B1:C1",)),
        {},
    ),
    "Excel with empty rows and columns around": (
        sheet([[None] * 4, [None, "t [s]", "F [kN]", "x [mm]"], *([None, *row] for row in ROWS), [None] * 4]),
        {},
    ),
    "Excel with a cover sheet": (sheet([["Bench 3"], ["Eva"]], Log=[["t [s]", "F [kN]", "x [mm]"], *ROWS]), {}),
    "Excel with moments": (
        sheet([["t", "F [kN]", "x [mm]"], *([BEGIN + timedelta(seconds=t), f, x] for t, f, x in ROWS)]),
        {},
    ),
    ".mat with nested structs": (
        matlab(rig={"meta": {"rate": 100.0}, "log": {"t": TIME, "F": FORCE, "x": PLACE}}),
        UNITS,
    ),
    ".mat of Simulink's structure with time": (
        matlab(
            out={
                "time": TIME,
                "signals": [
                    {"values": FORCE, "label": "F", "dimensions": 1.0},
                    {"values": PLACE, "label": "x", "dimensions": 1.0},
                ],
            }
        ),
        UNITS,
    ),
    ".mat of Simulink's structure without labels": (
        matlab(t=TIME, F=FORCE, out={"signals": [{"values": PLACE, "label": ""}, {"values": FORCE, "label": "y"}]}),
        {**UNITS, "outputs": {"x": "values"}},
    ),
    ".mat of version 7.3 with a struct": (matlab73(log={"t": TIME, "F": FORCE, "x": PLACE}), UNITS),
}

# name: file, what is said beside it, the place in the message, and words of the cure
REFUSED: dict[str, tuple[Callable[[Path], Path], dict[str, Any], str, str]] = {
    "text in a column": (
        of_lines(HEAD, *LINES[:7], "0.07,ERROR,1.0", *LINES[8:]),
        {}, r"log\.csv, line 9: 'ERROR' is no number for F \[kN\]", "correct it, or empty the cell",
    ),
    "text in the first row": (
        of_lines(HEAD, "0.0,start,2.0", *LINES[1:]),
        {}, r"log\.csv, line 2: 'start' is no number for F \[kN\]", "correct it, or empty the cell",
    ),
    "a row with a column missing": (
        of_lines(HEAD, *LINES[:5], "0.05,0.8", *LINES[6:]),
        {}, r"log\.csv, line 7: 2 columns where 3 belong", "complete the row, or remove it",
    ),
    "a time that stands still": (
        of_lines(HEAD, *LINES[:5], "0.04,0.8,1.0", *LINES[5:]),
        {}, r"log\.csv, line 7: time stands still at 0\.04 s", "remove the repeated rows",
    ),
    "two tests in one file": (
        of_lines(HEAD, *LINES, *LINES),
        {}, r"log\.csv, line 42: time runs backwards from 0\.39 s to 0 s", "give each test a log of its own",
    ),
    "decimal commas that separate as well": (
        of_lines(HEAD, *(one.replace(".", ",") for one in LINES)),
        {}, r"log\.csv, line 2: 6 columns below 3 headings", "separate the columns by semicolons or tabs",
    ),
    "no unit anywhere": (
        of_lines("t,F,x", *LINES), {}, r"log\.csv: in which unit is F and x", r'units=\{"F": "\.\.\.", "x": "\.\.\."\}',
    ),
    "a misspelt unit": (
        of_lines("t [s],F [kN],x [mmm]", *LINES), {}, r"log\.csv, x: .*'mmm'", r"did you mean mm",
    ),
    "another letter's case": (
        of_lines("t [s],f [kN],x [mm]", *LINES), {}, r"log\.csv has no column 'F'", r"did you mean 'f \[kN\]'",
    ),
    "two columns of the same name": (
        of_lines("t [s],F [kN],F [V],x [mm]", *(f"{t},{f},{f},{x}" for t, f, x in ROWS)),
        {}, r"log\.csv: which column is 'F', 'F \[kN\]' or 'F \[V\]'", "with its unit",
    ),
    "two columns of the same name, both wanted": (
        of_lines("t [s],F [kN],x [V],x [mm]", *(f"{t},{f},{f},{x}" for t, f, x in ROWS)),
        {"outputs": ["x [V]", "x [mm]"]}, r"outputs name x twice, as 'x \[V\]' and 'x \[mm\]'", "another name",
    ),
    "a column that is named twice": (
        of_lines(HEAD, *LINES), {"outputs": ["x", "x"]}, "outputs name x twice", "name it once",
    ),
    "a column that is input and output": (
        of_lines(HEAD, *LINES), {"outputs": ["x", "F"]}, "F: input or output", "Name it once",
    ),
    "two signals of Simulink with one label": (
        matlab(out={"time": TIME, "signals": [{"values": v, "label": "x"} for v in (FORCE, PLACE)]}, F=FORCE),
        {**UNITS, "outputs": {"x": "out.x"}}, r"log\.mat: 2 columns are headed 'out\.x'", "give each its own name",
    ),
    "Parquet with two columns of one name": (
        lambda folder: _parquet(folder, ("t", "F", "x", "x"), (TIME, FORCE, PLACE, FORCE)),
        UNITS, r"log\.parquet: 2 columns are headed 'x'", "give each its own name",
    ),
    "a unit of a column that is not there": (
        of_lines(HEAD, *LINES), {"units": {"f": "N"}}, "units names 'f'", "use 'F'",
    ),
    "no clock, and a force that rises evenly": (
        of_lines("ramp,F [kN],x [mm]", *LINES), {}, r"log\.csv: is 'ramp' the time", r'name it: time="ramp"',
    ),
    "no clock at all": (
        of_lines("F [kN],x [mm]", *(f"{f},{x}" for _, f, x in ROWS)),
        {}, r"log\.csv: no column is a clock", r"one of F \[kN\], x \[mm\]",
    ),
    "day or month": (
        of_lines("t,F [kN],x [mm]", *(f"0{3 if t < 0.2 else 5}/04/2026 14:05,{f},{x}" for t, f, x in ROWS)),
        {}, r"log\.csv, t: is '03/04/2026 14:05' day/month/year or month/day/year", "Say it in units",
    ),
    "a header again in the middle": (
        of_lines(HEAD, *LINES[:20], HEAD, *LINES[20:]),
        {}, r"log\.csv, line 22: 't \[s\]' is no number for t \[s\]", "correct it",
    ),
    "a moment that is none": (
        of_lines("t,F [kN],x [mm]", *(f"2026-03-01 14:05:{t:06.3f},{f},{x}" for t, f, x in ROWS[:9]), "later,1.0,2.0"),
        {}, r"log\.csv, t, row 10: 'later' is no moment", "correct it or remove the row",
    ),
    "a day that no month has": (
        of_lines("t,F [kN],x [mm]", *(f"2026-02-31 14:05:{t:06.3f},{f},{x}" for t, f, x in ROWS)),
        {}, r"log\.csv, t: .*2026-02-31", "correct that cell",
    ),
    "an empty time": (
        of_lines(HEAD, *LINES[:5], ",0.1,0.2", *LINES[6:]),
        {}, r"log\.csv, line 7: the time 't \[s\]' is empty", "complete it or remove the row",
    ),
    "a column without a cell": (
        of_lines(HEAD, *(f"{t},{f}," for t, f, _ in ROWS)), {}, r"log\.csv: x is empty", "name another column",
    ),
    "an empty file": (of_lines(""), {}, r"log\.csv holds no rows of numbers", "it needs a column of times"),
    "a picture called csv": (
        lambda folder: _binary(folder / "log.csv"), {}, r"log\.csv is no text file", "export it as text",
    ),
    "Excel of another program's export": (
        lambda folder: _binary(folder / "log.xlsx"), {}, r"log\.xlsx", "save it again|python_calamine|pip install",
    ),
    ".mat with a single scalar": (
        matlab(k=3.0), {}, r"log\.mat holds no vectors", "save both",
    ),
    ".mat cut off": (lambda folder: _cut(matlab(t=TIME, F=FORCE, x=PLACE)(folder)), {}, r"log\.mat", "save it again"),
    "a file that is not there": (lambda folder: folder / "lug.csv", {}, r"lug\.csv", "correct the path"),
}  # fmt: skip


def _binary(path: Path) -> Path:
    path.write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(range(256)))
    return path


def _parquet(folder: Path, names: tuple[str, ...], columns: tuple[Any, ...]) -> Path:
    pyarrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    parquet.write_table(pyarrow.Table.from_arrays([*map(pyarrow.array, columns)], names), folder / "log.parquet")
    return folder / "log.parquet"


def _cut(path: Path) -> Path:
    path.write_bytes(path.read_bytes()[:300])
    return path


@pytest.mark.parametrize("name", READ)
def test_read_rightly(name: str, tmp_path: Path) -> None:
    write, said = READ[name]
    data = load(write(tmp_path), **{"inputs": "F", "outputs": "x", **said})
    (record,) = data.dataset.records
    assert isinstance(record.data, Record)
    np.testing.assert_allclose(record.data.time, TIME, atol=1e-6)  # a spreadsheet's moments are so fine
    np.testing.assert_allclose(record.data["F"], 1e3 * FORCE, rtol=1e-12)
    np.testing.assert_allclose(record.data["x"], 1e-3 * PLACE, rtol=1e-12)


@pytest.mark.parametrize("name", REFUSED)
def test_refused_with_file_place_and_cure(name: str, tmp_path: Path) -> None:
    write, said, place, cure = REFUSED[name]
    with pytest.raises(BadInput) as refused:
        _ = load(write(tmp_path), **{"inputs": "F", "outputs": "x", **said}).dataset
    text = str(refused.value)
    assert re.search(place, text), text
    assert re.search(cure, text), text
    assert "\n" not in text
    assert len(text) < 400


def test_there_are_thirty_and_more() -> None:
    assert len(READ) + len(REFUSED) >= 30


def test_what_is_asked_first_is_whether_the_logs_are_there(tmp_path: Path) -> None:
    """Then which of their columns are signals, by the headings that are there."""
    of_lines(HEAD, *LINES)(tmp_path)
    (tmp_path / ".hidden.csv").write_text("")
    with pytest.raises(BadInput, match=r"there is no file .*lgo\.csv; there is log\.csv$"):
        load(tmp_path / "lgo.csv")
    for given, missing in (({}, "inputs"), ({"inputs": "F"}, "outputs")):
        with pytest.raises(BadInput, match=re.escape("t [s], F [kN], x [mm]")) as refused:
            load(tmp_path / "log.csv", **given)
        assert refused.value.argument == missing
