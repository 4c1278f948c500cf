"""Data sets: what dataset.toml has to say, what tables of frequency responses become, what is refused where."""

from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_dataset, read_described
from pysim.io.units import SI
from pysim.types import BadInput

TOML = """[dataset]
name = "two tables"
description = "by hand"
system = "pump"

[signals.cmd]
role = "input"
unit = "%"
quantity = "command"
variable = "alphaCMD"

[signals."angle"]
role = "output"
unit = "%"
quantity = "angle"
noise = 0.1

[[records]]
file = "O+25_A5.csv"
columns = ["frequency_hz", "magnitude_db", "phase_deg"]
kind = "frequency-response-table"
offset = 25.0
amplitude = 5.0
use = "fit"

[[records]]
file = "sub/reordered.txt"
columns = ["phase_deg", "comment", "frequency_hz", "magnitude_db"]
kind = "frequency-response-table"
offset = -50
amplitude = 10
use = "validate"
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "sub").mkdir()
    (tmp_path / "dataset.toml").write_text(TOML, encoding="utf-8")
    (tmp_path / "O+25_A5.csv").write_text("# f, M, phi\n0.1,0.0,-1\n1,-6.0205999132796239,-170\n2,-20,170\n")
    (tmp_path / "sub" / "reordered.txt").write_text("-10 0 0,5 20\n")
    return tmp_path


@pytest.mark.parametrize(("use", "held_out"), [("fit", False), ("validate", True), ("test", True)])
def test_a_record_is_fitted_chooses_or_is_reported(folder: Path, use: str, held_out: bool) -> None:
    (folder / "dataset.toml").write_text(TOML.replace('"fit"', f'"{use}"'), encoding="utf-8")
    first, second = read_dataset(folder).records
    assert (first.use, first.held_out, second.held_out) == (use, held_out, True)


def test_reads_gain_phase_and_who_is_who(folder: Path) -> None:
    data = read_dataset(folder)
    assert (data.name, data.description, data.system) == ("two tables", "by hand", "pump")
    assert data.signal("cmd").variable == "alphaCMD"
    assert data.signal("angle").variable == "angle"
    assert data.signal("angle").noise == 0.1
    first, second = data.responses()
    np.testing.assert_allclose(first.gain, [1.0, 0.5, 0.1])
    np.testing.assert_allclose(np.degrees(first.phase), [-1, -170, -190])  # unwrapped
    assert (first.test.offset, first.test.amplitude, first.test.input, first.test.output) == (25.0, 5.0, "cmd", "angle")
    np.testing.assert_allclose([second.frequency[0], second.gain[0], second.phase[0]], [0.5, 10.0, -np.pi / 18])
    assert [record.use for record in data.records] == ["fit", "validate"]
    assert [(record.offset, record.amplitude, record.frequency) for record in data.records] == [
        (25.0, 5.0, None),
        (-50.0, 10.0, None),
    ]


def test_reading_changes_nothing(folder: Path) -> None:
    before = {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in folder.rglob("*.*")}
    read_dataset(folder)
    assert before == {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in folder.rglob("*.*")}


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[dataset]", "[dataset", r"dataset\.toml: .*line 1"),
        ("[dataset]", "[dataseat]", r"the section \[dataset\] is missing"),
        ('role = "input"\n', "", r"dataset\.toml, line 6: role is missing"),
        ('role = "input"', 'role = "in"', "line 6: role = 'in' is not known; use one of input, output"),
        (
            'role = "output"',
            'role = "input"',
            r"line 18: a response needs one input, and 2 signals",
        ),
        ('role = "input"', 'role = "output"', r"line 18: a response needs one input, and 0 signals"),
        ('unit = "%"', 'unit = "percent"', "line 6: unit = 'percent' is not known"),
        ("noise = 0.1", "noise = nan", "line 12: noise = nan is no finite number"),
        ("noise = 0.1", "noise = -0.1", "line 12: noise cannot be negative, got -0.1"),
        ("noise = 0.1", 'hold = "zero"', "line 12: hold is for inputs, and this is an output; remove it"),
        (
            'variable = "alphaCMD"',
            'hold = "cubic"',
            "line 6: hold = 'cubic' is not known; use one of zero, linear",
        ),
        ("[signals.cmd]", "[signals.time]", "line 6: time is the clock of every log and no signal"),
        ('file = "sub/reordered.txt"', 'file = ""', "line 26: file is missing or no text"),
        ("offset = 25.0\n", "", "line 18: offset is missing"),
        ("offset = 25.0", "ofset = 25.0", "line 18: the key 'ofset' is not known"),
        ("amplitude = 10\n", "amplitude = true\n", "line 26: amplitude = True is no finite number"),
        ("amplitude = 5.0", "amplitude = -5.0", "line 18: amplitude must be positive, got -5; correct it"),
        ("amplitude = 5.0\n", "", "line 18: amplitude is missing"),
        (
            "amplitude = 5.0",
            "amplitude = 5.0\nfrequency = 1.0",
            'line 18: frequency means nothing where kind = "frequency-response-table"; remove it, or correct the kind',
        ),
        ("amplitude = 5.0", "amplitude = 5.0\nbegin = 1.0", "line 18: begin means nothing where kind = "),
        ("amplitude = 5.0", 'amplitude = 5.0\ntime = "t"', "line 18: time means nothing where kind = "),
        ('use = "validate"', 'use = "tests"', "line 26: use = 'tests' is not known; use one of fit, validate, test"),
        (
            'kind = "frequency-response-table"',
            'kind = "wobble"',
            "line 18: kind = 'wobble' is not known; use one of freq",
        ),
        (
            'system = "pump"',
            'sistem = "pump"',
            r"dataset\.toml, line 1: the key 'sistem' is not known; use name, description",
        ),
        ("[dataset]", "[extra]\nx = 1\n\n[dataset]", r"dataset\.toml: the key 'extra' is not known; use dataset, sig"),
        (
            '"magnitude_db", "phase_deg"]',
            '"magnitude_db"]',
            "line 18: columns must name frequency_hz, magnitude",
        ),
        ("O+25_A5.csv", "O+25_A7.csv", r"line 18: cannot read .*O\+25_A7\.csv"),
    ],
)
def test_refuses_faults_in_the_description(folder: Path, old: str, new: str, words: str) -> None:
    assert old in TOML
    (folder / "dataset.toml").write_text(TOML.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(BadInput, match=words):
        read_dataset(folder)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("0.1,0,0\n0.1,0,0\n", r"O\+25_A5\.csv, line 2: frequencies must be positive and increase"),
        ("0,0,0\n0.1,0,0\n", "line 1: frequencies must be positive"),
        ("0.1,0\n", "line 1: 2 columns where 3 belong"),
        ("0.1,0,nan\n", "line 1: phase_deg is nan"),
    ],
)
def test_refuses_faults_in_a_table(folder: Path, text: str, words: str) -> None:
    (folder / "O+25_A5.csv").write_text(text)
    with pytest.raises(BadInput, match=words):
        read_dataset(folder)


def test_refuses_a_folder_without_description(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"holds no dataset\.toml; name the folder that does, or write one"):
        read_dataset(tmp_path)
    with pytest.raises(BadInput, match=r"there is no folder .*none; correct the name"):
        read_dataset(tmp_path / "none")
    (tmp_path / "log.txt").write_text("0 1 2\n")
    with pytest.raises(BadInput, match=r"log\.txt is a single file; name the folder"):
        read_dataset(tmp_path / "log.txt")
    with pytest.raises(BadInput, match=r"data set: cannot read .*other\.toml"):
        read_dataset(tmp_path / "other.toml")


def test_a_table_may_have_several_columns_that_are_left_out(folder: Path) -> None:
    columns = '["-", "phase_deg", "-", "frequency_hz", "magnitude_db"]'
    text = TOML.replace('["phase_deg", "comment", "frequency_hz", "magnitude_db"]', columns)
    (folder / "dataset.toml").write_text(text, encoding="utf-8")
    (folder / "sub" / "reordered.txt").write_text("a -10 b 0,5 20\n")
    np.testing.assert_allclose(read_dataset(folder).responses()[1].gain, [10.0])


def test_a_record_may_choose_among_outputs(folder: Path) -> None:
    extra = '[signals.u]\nrole = "output"\nunit = "1"\n\n[[records]]\noutput = "u"\n'
    text = TOML.replace("[[records]]\n", extra, 1).replace('file = "sub', 'output = "angle"\nfile = "sub')
    (folder / "dataset.toml").write_text(text, encoding="utf-8")
    assert [response.test.output for response in read_dataset(folder).responses()] == ["u", "angle"]


def test_units_of_the_bench_become_si(folder: Path) -> None:
    text = TOML.replace('unit = "%"', 'unit = "bar"', 1).replace('unit = "%"', 'unit = "l/min"', 1)
    (folder / "dataset.toml").write_text(text, encoding="utf-8")
    data = read_dataset(folder)
    assert (data.signal("cmd").unit, data.signal("angle").unit) == ("Pa", "m3/s")
    assert data.signal("angle").noise == pytest.approx(0.1 / 60000)
    first = data.responses()[0]
    assert (first.test.offset, first.test.amplitude) == (pytest.approx(25e5), pytest.approx(5e5))
    np.testing.assert_allclose(first.gain, np.array([1.0, 0.5, 0.1]) / 60000 / 1e5)


@pytest.mark.parametrize(
    ("unit", "si", "value"),
    [("rpm", "rad/s", 2 * np.pi / 60), ("deg", "rad", np.pi / 180), ("MPa", "Pa", 1e6), ("kN", "N", 1e3)]
    + [(same, same, 1.0) for same in ("%/s", "V/s", "m2", "%")],
)
def test_one_of_a_unit_in_si(unit: str, si: str, value: float) -> None:
    assert SI[unit] == (si, pytest.approx(value))


def test_what_stands_for_the_measurements_is_named(folder: Path) -> None:
    text = TOML.replace('use = "fit"', 'use = "fit"\norigin = "transfer function, thesis Table 4.1"')
    (folder / "dataset.toml").write_text(text, encoding="utf-8")
    origins = [response.origin for response in read_dataset(folder).responses()]
    assert origins == ["transfer function, thesis Table 4.1", "measured, sub/reordered.txt"]


def test_a_faulty_record_does_not_keep_the_others_from_being_read(folder: Path) -> None:
    (folder / "O+25_A5.csv").write_text("0.1,0.0,-1\n1,open,-170\n")
    found = read_described(folder, partly=True)
    data, refused = found.raw, found.refused
    assert [record.source for record in data.records] == ["sub/reordered.txt"]
    ((file, why),) = refused
    assert file == "O+25_A5.csv"
    assert "line 2: 'open' is no number for magnitude_db; correct it" in why


def test_a_wrong_description_is_refused_as_a_whole(folder: Path) -> None:
    (folder / "dataset.toml").write_text(TOML.replace('role = "output"', 'role = "exit"'))
    with pytest.raises(BadInput, match="role = 'exit'"):
        read_described(folder, partly=True)
