"""`pysim data describe`: from plain logs to a data set, without a page to read."""

import tomllib
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from nptdms import ChannelObject, TdmsWriter
from pyarrow import parquet

from pysim.cli import main
from pysim.io import read_dataset
from tests.pysim.cli.ran import refused

TIME = np.arange(400) / 100


def write(path: Path, head: str, *, separator: str = ",", sine: float = 1.0) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    wave = np.sin(2 * np.pi * sine * TIME)
    columns = [TIME, 25 + 10 * wave, 24 + 9 * wave, 0 * wave][: head.count(separator) + 1]
    rows = [separator.join(f"{v:.6f}" for v in row) for row in np.column_stack(columns)]
    path.write_text("\n".join([head, *rows]) + "\n")
    return path


def test_headings_with_units_need_nothing_else(tmp_path: Path) -> None:
    write(tmp_path / "log.csv", "time [s],p [bar],x [mm]")
    before = (tmp_path / "log.csv").read_bytes()
    assert main(["data", "describe", str(tmp_path)]) == 0
    data = read_dataset(tmp_path)
    assert [(s.name, s.role, s.unit) for s in data.signals] == [("p", "input", "Pa"), ("x", "output", "m")]
    assert data.logs()[0].data["p"].max() == pytest.approx(35e5)
    assert (tmp_path / "log.csv").read_bytes() == before


def test_units_are_taken_as_people_write_them(tmp_path: Path) -> None:
    write(tmp_path / "log.csv", "t [s];Druck [bar];Temperatur [°C];M [Nm]", separator=";")
    assert main(["data", "describe", str(tmp_path)]) == 0
    assert [s.unit for s in read_dataset(tmp_path).signals] == ["Pa", "K", "N.m"]


def test_what_nobody_told_is_left_open(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tmp_path / "log.csv", "Zeit;Soll;Ist", separator=";")
    assert main(["data", "describe", str(tmp_path)]) == 0
    text = (tmp_path / "dataset.toml").read_text(encoding="utf-8")
    assert text.count("FILL IN") == 2
    refused(["data", "check", str(tmp_path)], capsys, "unit = '?' is not known")
    (tmp_path / "dataset.toml").write_text(text.replace('unit = "?"', 'unit = "%"'), encoding="utf-8")
    assert main(["data", "check", str(tmp_path)]) == 0


def test_signals_are_named_by_their_headings_others_left_out(tmp_path: Path) -> None:
    write(tmp_path / "a.csv", "t [ms],spare,cmd,y")
    assert main(["data", "describe", str(tmp_path), "--input", "cmd:%", "--response", "y:bar"]) == 0
    content = tomllib.loads((tmp_path / "dataset.toml").read_text(encoding="utf-8"))
    assert content["records"][0]["columns"] == ["time", "-", "cmd", "y"]
    assert content["dataset"]["time_unit"] == "ms"
    assert content["signals"]["y"]["unit"] == "bar"


def test_a_column_of_words_is_left_out(tmp_path: Path) -> None:
    rows = [f"2024-01-01 12:00:00,{t:.3f},{np.sin(t):.6f},{np.cos(t):.6f},pump on" for t in TIME]
    for head, words in (
        ("date,t [s],cmd [%],p [bar],state", []),
        ("date,t,cmd,p,state", ["--input", "cmd:%", "--response", "p:bar"]),
        ("date,t,a,b,state", ["--input", "cmd:%", "--response", "p:bar"]),
    ):
        (tmp_path / "log.csv").write_text("\n".join([head, *rows]) + "\n")
        (tmp_path / "dataset.toml").unlink(missing_ok=True)
        assert main(["data", "describe", str(tmp_path), *words]) == 0
        content = tomllib.loads((tmp_path / "dataset.toml").read_text(encoding="utf-8"))
        assert content["records"][0]["columns"] == ["-", "time", "cmd", "p", "-"]
        assert list(content["signals"]) == ["cmd", "p"]
        assert read_dataset(tmp_path).logs()[0].data["p"][0] == pytest.approx(1e5)


def test_a_clock_of_another_pace_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = write(tmp_path / "log.csv", "t [min],cmd [%],y [bar]")
    assert main(["data", "describe", str(tmp_path)]) == 0
    assert tomllib.loads((tmp_path / "dataset.toml").read_text(encoding="utf-8"))["dataset"]["time_unit"] == "min"
    (tmp_path / "dataset.toml").unlink()
    write(log, "t [ticks],cmd [%],y [bar]")
    assert main(["data", "describe", str(tmp_path)]) == 0
    assert "time_unit" not in tomllib.loads((tmp_path / "dataset.toml").read_text(encoding="utf-8"))["dataset"]
    (tmp_path / "dataset.toml").unlink()
    write(log, "t [ms],cmd [%],y [bar]")
    write(tmp_path / "other.csv", "t [s],cmd [%],y [bar]")
    refused(["data", "describe", str(tmp_path)], capsys, "ms in log.csv, s in other.csv", "a folder of its own")
    write(tmp_path / "other.csv", "t,cmd [%],y [bar]")
    refused(["data", "describe", str(tmp_path)], capsys, "ms in log.csv, s in other.csv, whose heading tells no unit")


def test_signals_are_counted_where_the_headings_are_others(tmp_path: Path) -> None:
    write(tmp_path / "a.csv", "A,B,C,D")
    words = ["--input", "cmd:%,load:N.m", "--response", "y:bar"]
    assert main(["data", "describe", str(tmp_path), *words]) == 0
    (log,) = read_dataset(tmp_path).logs()
    assert log.data.names == ("cmd", "load", "y")


def of_named_columns(path: Path, names: list[str]) -> Path:
    """Times in ms, command and answer under these names."""
    columns = dict(zip(names, (1000 * TIME, np.sin(TIME), np.cos(TIME)), strict=True))
    if path.suffix == ".parquet":
        parquet.write_table(pa.table(columns), path)
    else:
        with TdmsWriter(path) as writer:
            writer.write_segment([ChannelObject("log", name, values) for name, values in columns.items()])
    return path


@pytest.mark.parametrize("file", ["log.parquet", "log.tdms"])
@pytest.mark.parametrize("words", [[], ["--input", "cmd [%]:%", "--response", "y [bar]:bar"]])
@pytest.mark.parametrize("clock", ["t [ms]", "Time [ms]", "Zeit [ms]", "time"])
def test_the_clock_of_a_file_that_names_its_columns_may_have_any_name(
    tmp_path: Path, file: str, words: list[str], clock: str
) -> None:
    of_named_columns(tmp_path / file, [clock, "cmd [%]", "y [bar]"])
    assert main(["data", "describe", str(tmp_path), *words]) == 0
    (log,) = read_dataset(tmp_path).logs()
    assert log.data.names == ("cmd [%]", "y [bar]")
    assert log.data.time[-1] == pytest.approx(TIME[-1] if "ms" in clock else 1000 * TIME[-1])


def test_the_clock_is_no_column_that_is_a_signal(tmp_path: Path) -> None:
    of_named_columns(tmp_path / "a.parquet", ["Zeit", "cmd", "t"])
    columns = parquet.read_table(tmp_path / "a.parquet").select(["cmd", "t", "Zeit"])
    parquet.write_table(columns, tmp_path / "a.parquet")
    assert main(["data", "describe", str(tmp_path), "--input", "cmd:%", "--response", "t:K"]) == 0
    (log,) = read_dataset(tmp_path).logs()
    assert (log.data.names, log.data.time[-1]) == (("cmd", "t"), pytest.approx(1000 * TIME[-1]))


def test_a_force_ahead_of_the_time_is_no_clock(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = [f"{50 * np.sin(3 * t):.6f},{t:.3f},{np.cos(t):.6f}" for t in TIME]
    (tmp_path / "log.csv").write_text("\n".join(["F [N],elapsed,x [mm]", *rows]))
    assert main(["data", "describe", str(tmp_path)]) == 0
    data = read_dataset(tmp_path)
    assert [signal.name for signal in data.signals] == ["F", "x"]
    np.testing.assert_allclose(data.logs()[0].data.time, TIME)
    (tmp_path / "dataset.toml").unlink()
    (tmp_path / "log.csv").write_text("\n".join(["F [N],p [bar],x [mm]", *(r.replace(",", ",-") for r in rows)]))
    refused(["data", "describe", str(tmp_path)], capsys, "no column is a clock", "F [N], p [bar], x [mm]")


def test_columns_are_counted_beside_the_time_wherever_it_stands(tmp_path: Path) -> None:
    rows = [f"{np.sin(3 * t):.6f},{t:.3f},{np.cos(t):.6f}" for t in TIME]
    (tmp_path / "log.csv").write_text("\n".join(["A,B,C", *rows]))
    assert main(["data", "describe", str(tmp_path), "--input", "cmd:%", "--response", "y:bar"]) == 0
    (log,) = read_dataset(tmp_path).logs()
    np.testing.assert_allclose(log.data.time, TIME)
    np.testing.assert_allclose(log.data["y"], 1e5 * np.cos(TIME), atol=0.1)


def test_dates_are_sent_to_where_they_can_be_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = [f"2026-03-01 14:05:{t:06.3f},{np.sin(t):.6f},{np.cos(t):.6f}" for t in TIME]
    (tmp_path / "log.csv").write_text("\n".join(["stamp,F [N],x [mm]", *rows]))
    refused(["data", "describe", str(tmp_path)], capsys, "its times are dates", "pysim.load", ".save(folder)")


def test_stepped_sines_are_known_by_their_names(tmp_path: Path) -> None:
    for f in (1.0, 2.0):
        write(tmp_path / "O+25_A10" / f"{f:g}Hz.txt", "t\tcmd\ty", separator="\t", sine=f)
    write(tmp_path / "wave.txt", "t\tcmd\ty", separator="\t", sine=0.3)
    assert main(["data", "describe", str(tmp_path), "--input", "cmd:bar", "--response", "y:%"]) == 0
    data = read_dataset(tmp_path)
    assert [(r.kind, r.offset, r.amplitude, r.frequency) for r in data.logs()] == [
        ("frequency-response", 25e5, 10e5, 1.0),
        ("frequency-response", 25e5, 10e5, 2.0),
        ("other", None, None, None),
    ]
    assert main(["frf", str(tmp_path)]) == 0


def test_a_description_that_is_there_stays(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(tmp_path / "log.csv", "time [s],p [bar],x [mm]")
    (tmp_path / "dataset.toml").write_text("mine")
    refused(["data", "describe", str(tmp_path)], capsys, "stays as it is", "remove it first")
    assert (tmp_path / "dataset.toml").read_text() == "mine"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["{}/none"], "is no folder"),
        (["{}/empty"], "holds no logs; they end in .txt"),
        (["{}", "--input", "cmd:furlong", "--response", "y:%"], "signal cmd: unit = 'furlong' is not known"),
        (["{}", "--input", "cmd"], "cmd: write NAME:UNIT"),
        (["{}", "--input", "cmd:%"], "one input and one response are needed"),
        (
            ["{}", "--input", "cmd:%", "--response", "z:%"],
            "its columns are t, a, b, c; name signals as they are called",
        ),
    ],
)
def test_what_cannot_be_drafted_leaves_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str
) -> None:
    write(tmp_path / "log.csv", "t,a,b,c")
    (tmp_path / "empty").mkdir()
    refused(["data", "describe", *(word.format(tmp_path) for word in words)], capsys, message)
    assert not (tmp_path / "dataset.toml").exists()


@pytest.mark.parametrize("command", [["frf"], ["blackbox", "--poles", "2"], ["compare", "--model", "m.fmu"]])
def test_a_folder_without_a_description_says_how_to_come_to_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: list[str]
) -> None:
    refused([*command, str(tmp_path)], capsys, f"data describe {tmp_path}")
