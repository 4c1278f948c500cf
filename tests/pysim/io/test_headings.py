"""What a log calls its columns."""

from pathlib import Path

import numpy as np
import pytest

from pysim.io import column_names, name_and_unit
from pysim.io.columns import read_columns
from pysim.types import BadInput


@pytest.mark.parametrize(
    ("content", "names"),
    [
        ("time\tcmd\tangle\n0\t1\t2\n", ("time", "cmd", "angle")),
        ("0;1,5;2\n1;2,5;3\n", ("time", "column 2", "column 3")),
        ("a story of a log\ntime cmd\n0 1\n", ("time", "cmd")),
        ("# time cmd\n0 1 2\n", ("time", "column 2", "column 3")),
        ("t [s],F [N],swash plate\n0.0,1.5,2\n", ("t [s]", "F [N]", "swash plate")),
        ("t [s];F, N\n0,0;1,5\n", ("t [s]", "F, N")),
        ('"t","F"\n"0,5","1,5"\n', ("t", "F")),
        ('"t","F, radial"\n0,1\n', ("t", "F radial")),
        ("stamp,time,cmd\n2024-01-01 12:00:00,0,1\n2024-01-01 12:00:01,1,2\n", ("-", "time", "cmd")),
        ('"stamp","t","p"\n"2024-01-01 12:00:00",0,1\n"2024-01-01 12:00:01",1,2\n', ("-", "t", "p")),
        ("01.02.2024 12:00;0,5;1,5\n01.02.2024 12:01;1,5;2,5\n", ("-", "time", "column 3")),
        ("a story, of a log\nt;p;state\n0,5;1,5;on, ok\n", ("t", "p", "-")),
        ("t,p,state\n0,1,pump on\n1,2,1\n2,3,\n", ("t", "p", "-")),
        ("2024-01-01 12:00:00 0 1\n2024-01-01 12:00:01 1 2\n", ("-", "-", "time", "column 4")),
        ("t\tp\tremark\n0\t1\t\n1\t2\t\n", ("t", "p", "-")),
        ("t\tp\n0\t1\t\n1\t2\t\n", ("t", "p")),
        ("t,p\n1_000,2\n", None),  # what Python alone takes for a number
        ("x,x\n0,1\n", ("time", "column 2")),  # a name that stands twice is none
    ],
)
def test_names_come_from_the_line_above_the_numbers(
    content: str, names: tuple[str, ...] | None, tmp_path: Path
) -> None:
    (tmp_path / "a.txt").write_text(content)
    if names is None:
        with pytest.raises(BadInput, match="no rows of numbers"):
            column_names(tmp_path / "a.txt")
        return
    assert column_names(tmp_path / "a.txt") == names


@pytest.mark.parametrize(
    ("heading", "name", "unit"),
    [
        ("p_A [bar]", "p_A", "bar"),
        ("swash plate( deg )", "swash plate", "deg"),
        ("q (furlongs)", "q", "furlongs"),  # known or not is the reader's business
        ("x []", "x", ""),
        ("plain", "plain", ""),
        ("[bar]", "[bar]", ""),
        ("p [bar] mean", "p [bar] mean", ""),
    ],
)
def test_a_heading_tells_a_name_and_a_unit(heading: str, name: str, unit: str) -> None:
    assert name_and_unit(heading) == (name, unit)


def test_named_columns_of_parquet_are_read(tmp_path: Path) -> None:
    arrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    parquet.write_table(arrow.table({"time": [0.0], "p": [1.0]}), tmp_path / "a.parquet")
    assert column_names(tmp_path / "a.parquet") == ("time", "p")


def test_channels_of_tdms_have_their_group_where_two_groups_have_the_same(tmp_path: Path) -> None:
    nptdms = pytest.importorskip("nptdms")
    channels = [("a", "time"), ("a", "x"), ("b", "x"), ("b", "y")]
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as writer:
        writer.write_segment([nptdms.ChannelObject(group, name, np.array([0.0, 1.0])) for group, name in channels])
    names = column_names(tmp_path / "a.tdms")
    assert names == ("time", "a/x", "b/x", "y")
    assert read_columns(tmp_path / "a.tdms", names, "test").values.shape == (2, 4)


def test_waveforms_of_tdms_carry_their_clock_and_other_channels_do_not(tmp_path: Path) -> None:
    nptdms = pytest.importorskip("nptdms")
    for properties, names in (({}, ("t", "x")), ({"wf_increment": 0.1}, ("time", "t", "x"))):
        with nptdms.TdmsWriter(tmp_path / "a.tdms") as writer:
            values = np.array([0.0, 1.0])
            writer.write_segment([nptdms.ChannelObject("a", name, values, properties) for name in ("t", "x")])
        assert column_names(tmp_path / "a.tdms") == names


@pytest.mark.parametrize("wrong", [0, 32, 41, None])
def test_a_damaged_tdms_file_is_refused(tmp_path: Path, wrong: int | None) -> None:
    nptdms = pytest.importorskip("nptdms")
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as writer:
        writer.write_segment([nptdms.ChannelObject("a", "x", np.array([0.0, 1.0]))])
    content = bytearray((tmp_path / "a.tdms").read_bytes())
    if wrong is None:
        del content[29:]
    else:
        content[wrong] = 255
    (tmp_path / "a.tdms").write_bytes(content)
    with pytest.raises(BadInput, match=r"cannot read .*a.tdms as TDMS \(.*\); .*export it again"):
        column_names(tmp_path / "a.tdms")


def test_a_file_without_numbers_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("nothing\nhere\n")
    (tmp_path / "b.txt").write_text("# nothing\n")
    with pytest.raises(BadInput, match=r"a.txt holds no rows of numbers; it needs a column of times"):
        column_names(tmp_path / "a.txt")
