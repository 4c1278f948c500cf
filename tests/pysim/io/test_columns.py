"""Parquet and TDMS files: the same numbers as from text, by the columns' names, and what is refused."""

import datetime
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from nptdms import ChannelObject, TdmsWriter
from pyarrow import parquet

from pysim.io import read_dataset
from pysim.io.columns import read_columns
from pysim.io.limits import ReadLimits
from pysim.io.load.parquet import read_parquet_log
from pysim.io.parquet_table import read_parquet
from pysim.io.tdms_table import read_tdms
from pysim.types import BadInput

TIME = [0.0, 0.5, 1.0]
SPEED = [1.0, -2.5, 3e-3]
NAMES = ("speed", "time")
START = datetime.datetime(2026, 3, 1, 8)


def as_parquet(path: Path, **columns: Any) -> Path:
    parquet.write_table(pa.table(columns), path)
    return path


def as_tdms(path: Path, **columns: Any) -> Path:
    return write_channels(path, [ChannelObject("log", name, np.array(values)) for name, values in columns.items()])


def write_channels(path: Path, channels: list[ChannelObject]) -> Path:
    with TdmsWriter(path) as writer:
        writer.write_segment(channels)
    return path


BOTH = pytest.mark.parametrize(("write", "suffix"), [(as_parquet, "parquet"), (as_tdms, "tdms")])
Write = Callable[..., Path]


@BOTH
def test_columns_are_found_by_name(tmp_path: Path, write: Write, suffix: str) -> None:
    path = write(tmp_path / f"log.{suffix}", time=TIME, torque=[7, 8, 9], speed=SPEED)
    columns = read_columns(path, NAMES, "test")
    np.testing.assert_array_equal(columns.values, np.column_stack([SPEED, TIME]))
    assert columns.place(2) == f"{path}, row 3"


@BOTH
def test_integers_and_stamps_become_numbers(tmp_path: Path, write: Write, suffix: str) -> None:
    moments = np.datetime64(START) + np.array([0, 500_000, 1_000_000], dtype="timedelta64[us]")
    path = write(tmp_path / f"log.{suffix}", time=moments, speed=np.array([1, -2, 3], dtype=np.int16))
    columns = read_columns(path, NAMES, "test")
    np.testing.assert_array_equal(columns["time"], TIME)
    np.testing.assert_array_equal(columns["speed"], [1.0, -2.0, 3.0])


@BOTH
@pytest.mark.parametrize(
    ("speed", "words"),
    [
        ([1.0, np.nan, 2.0], r"log\.\w+, row 2: speed is empty or not a number"),
        ([1.0, 2.0, np.inf], r"log\.\w+, row 3: speed is not finite"),
        (["1", "x", "2"], r"log\.\w+, row 2: 'x' is no number for speed"),
    ],
)
def test_faulty_cells_are_named_with_their_row(
    tmp_path: Path, write: Write, suffix: str, speed: list[Any], words: str
) -> None:
    path = write(tmp_path / f"log.{suffix}", time=TIME, speed=speed)
    with pytest.raises(BadInput, match=words):
        read_columns(path, NAMES, "test")


@BOTH
def test_a_missing_column_and_a_missing_file(tmp_path: Path, write: Write, suffix: str) -> None:
    path = write(tmp_path / f"log.{suffix}", time=TIME, n=SPEED)
    with pytest.raises(BadInput, match=r"line 4: .*log\.\w+ has no column 'speed'; name one of time, n"):
        read_columns(path, NAMES, "dataset.toml, line 4")
    with pytest.raises(BadInput, match=r"line 4: cannot read .*none\.\w+ as"):
        read_columns(tmp_path / f"none.{suffix}", NAMES, "dataset.toml, line 4")
    (tmp_path / f"text.{suffix}").write_text("0 1\n1 2\n")
    with pytest.raises(BadInput, match=r"line 4: cannot read .*text\.\w+ as"):
        read_columns(tmp_path / f"text.{suffix}", NAMES, "dataset.toml, line 4")


@BOTH
def test_an_empty_log_is_refused(tmp_path: Path, write: Write, suffix: str) -> None:
    path = write(tmp_path / f"log.{suffix}", time=np.zeros(0), speed=np.zeros(0))
    with pytest.raises(BadInput, match="holds no numbers; it needs rows of speed, time"):
        read_columns(path, NAMES, "test")


@pytest.mark.parametrize(
    ("suffix", "module", "package"), [("parquet", "pyarrow", "pyarrow"), ("tdms", "nptdms", "npTDMS")]
)
def test_a_missing_package_is_one_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, suffix: str, module: str, package: str
) -> None:
    monkeypatch.setitem(__import__("sys").modules, module, None)
    with pytest.raises(BadInput, match=f"line 4: .*is missing; run: pip install {package}$"):
        read_columns(tmp_path / f"log.{suffix}", NAMES, "dataset.toml, line 4")


def waveform(group: str, name: str, values: list[float], increment: float = 0.5) -> ChannelObject:
    properties = {"wf_start_time": START, "wf_start_offset": 0.0, "wf_increment": increment, "wf_samples": len(values)}
    return ChannelObject(group, name, np.array(values), properties=properties)


def test_waveforms_carry_their_clock(tmp_path: Path) -> None:
    path = write_channels(tmp_path / "log.tdms", [waveform("a", "speed", SPEED), waveform("a", "p", TIME)])
    columns = read_columns(path, ("time", "p", "speed"), "test")
    np.testing.assert_array_equal(columns.values, np.column_stack([TIME, TIME, SPEED]))


def test_a_channel_of_two_groups_needs_its_group(tmp_path: Path) -> None:
    path = write_channels(tmp_path / "log.tdms", [waveform("a", "speed", SPEED), waveform("b", "speed", TIME)])
    with pytest.raises(BadInput, match=r"has 2 columns named 'speed'; name one of a/speed, b/speed$"):
        read_columns(path, NAMES, "test")
    np.testing.assert_array_equal(read_columns(path, ("time", "b/speed"), "test").values[:, 1], TIME)


@pytest.mark.parametrize(
    ("channels", "words"),
    [
        (
            [waveform("a", "speed", SPEED), waveform("a", "p", SPEED, 0.1)],
            "speed and p were sampled at different times",
        ),
        (
            [waveform("a", "speed", SPEED), waveform("a", "p", [1.0])],
            r"different lengths \(speed 3, p 1, time 3 rows\)",
        ),
        (
            [ChannelObject("a", "speed", np.array(SPEED)), waveform("a", "p", SPEED)],
            r'neither a channel "time" nor the sampling interval of speed \(wf_increment\)',
        ),
    ],
)
def test_channels_that_do_not_belong_together(tmp_path: Path, channels: list[ChannelObject], words: str) -> None:
    path = write_channels(tmp_path / "log.tdms", channels)
    with pytest.raises(BadInput, match=words):
        read_columns(path, ("speed", "p", "time"), "test")


@BOTH
def test_a_data_set_of_such_files(tmp_path: Path, write: Write, suffix: str) -> None:
    write(tmp_path / f"log.{suffix}", command=[1, 2, 3], time=TIME, speed=[60.0, 30.0, 15.0])
    (tmp_path / "dataset.toml").write_text(
        '[dataset]\nname = "x"\n[signals.command]\nrole = "input"\nunit = "V"\n[signals.speed]\nrole = "output"\n'
        f'unit = "rpm"\n[[records]]\nfile = "log.{suffix}"\ncolumns = ["time", "command", "speed"]\nkind = "other"\n'
    )
    record = read_dataset(tmp_path).logs()[0].data
    assert (record.names, record.units) == (("command", "speed"), ("V", "rad/s"))
    np.testing.assert_allclose(record["speed"], np.pi * np.array([2.0, 1.0, 0.5]))


def described(folder: Path, record: str) -> Path:
    """A data set of a command in V and a speed in rpm."""
    (folder / "dataset.toml").write_text(
        '[dataset]\nname = "x"\ntime_unit = "ms"\n[signals.command]\nrole = "input"\nunit = "V"\n[signals.speed]\n'
        f'role = "output"\nunit = "rpm"\n[[records]]\nkind = "other"\n{record}\n'
    )
    return folder


@BOTH
def test_the_clock_may_have_another_name(tmp_path: Path, write: Write, suffix: str) -> None:
    write(tmp_path / f"log.{suffix}", **{"command": [1, 2, 3], "speed": SPEED, "t [ms]": [0.0, 500.0, 1000.0]})
    columns = f'file = "log.{suffix}"\ncolumns = ["time", "command", "speed"]'
    record = read_dataset(described(tmp_path, f'{columns}\ntime = "t [ms]"')).logs()[0].data
    np.testing.assert_allclose(record.time, TIME)
    assert record.names == ("command", "speed")
    with pytest.raises(BadInput, match=r"line 10: .*log\.\w+ has no column 'T'; name one of command, speed, t \[ms\]$"):
        read_dataset(described(tmp_path, f'{columns}\ntime = "T"'))
    with pytest.raises(BadInput, match="line 10: columns names 'speed' beside \"time\", which is the same; remove the"):
        read_dataset(described(tmp_path, f'{columns}\ntime = "speed"'))
    columns = columns.replace("time", "t [ms]")
    with pytest.raises(BadInput, match=r'no "time"; write "time" for the clock there, and time = "\.\.\." for what'):
        read_dataset(described(tmp_path, columns))


def test_the_clock_of_a_text_log_has_its_place_in_the_order(tmp_path: Path) -> None:
    (tmp_path / "log.txt").write_text("t command speed\n0 1 2\n1 2 3\n")
    columns = 'file = "log.txt"\ncolumns = ["time", "command", "speed"]\ntime = "t"'
    with pytest.raises(BadInput, match=r"line 10: time = 't' means nothing where columns go by .* log\.txt; remove it"):
        read_dataset(described(tmp_path, columns))


@BOTH
def test_moments_are_in_seconds_whatever_the_unit_of_bare_times(tmp_path: Path, write: Write, suffix: str) -> None:
    stamps = np.datetime64(START) + np.array([0, 500_000, 1_000_000], dtype="timedelta64[us]")
    write(tmp_path / f"stamps.{suffix}", time=stamps, speed=SPEED)
    write(tmp_path / f"bare.{suffix}", time=[0.0, 500.0, 1000.0], speed=SPEED)
    for name in ("stamps", "bare"):
        columns = read_columns(tmp_path / f"{name}.{suffix}", NAMES, "test")
        np.testing.assert_allclose(columns.in_seconds("time", 1e-3)["time"], TIME)
    path = write_channels(tmp_path / "waves.tdms", [waveform("a", "speed", SPEED)])
    np.testing.assert_allclose(read_columns(path, NAMES, "test").in_seconds("time", 1e-3)["time"], TIME)


def test_standing_time_is_named_by_row(tmp_path: Path) -> None:
    as_parquet(tmp_path / "log.parquet", command=[1, 2, 3], time=[0.0, 1.0, 1.0], speed=SPEED)
    (tmp_path / "dataset.toml").write_text(
        '[dataset]\nname = "x"\n[signals.command]\nrole = "input"\nunit = "V"\n[signals.speed]\nrole = "output"\n'
        'unit = "rpm"\n[[records]]\nfile = "log.parquet"\ncolumns = ["time", "command", "speed"]\nkind = "other"\n'
    )
    with pytest.raises(BadInput, match=r"log\.parquet, row 3: time stands still at 1 s"):
        read_dataset(tmp_path)


def test_a_small_file_that_would_fill_the_memory_is_refused(tmp_path: Path) -> None:
    """67 million zeros in some kB, half a GB as numbers and three times that while they are read."""
    group = pa.table(dict.fromkeys(("time", "speed"), np.zeros(2**24, dtype=bool)))
    with parquet.ParquetWriter(tmp_path / "bomb.parquet", group.schema, compression="zstd") as file:
        for _ in range(2):
            file.write_table(group)
    assert (tmp_path / "bomb.parquet").stat().st_size < 2**20
    with pytest.raises(BadInput, match=r"bomb\.parquet holds 67108864 numbers .* 60000000 at most .*; name fewer"):
        read_columns(tmp_path / "bomb.parquet", NAMES, "test")


@BOTH
def test_numbers_are_counted_before_any_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, write: Write, suffix: str
) -> None:
    path = write(tmp_path / f"log.{suffix}", time=TIME, torque=[7, 8, 9], speed=SPEED)
    read: Any = {"parquet": read_parquet, "tdms": read_tdms}[suffix]
    assert read(path, NAMES, "test", ReadLimits(file_numbers=6)).values.shape == (3, 2)
    for module, name in (("pyarrow.parquet.ParquetFile", "iter_batches"), ("nptdms.TdmsChannel", "__getitem__")):
        monkeypatch.delattr(f"{module}.{name}")
    with pytest.raises(BadInput, match="6 numbers in the columns that are named, and 5 at most"):
        read(path, NAMES, "test", ReadLimits(file_numbers=5))


def test_texts_that_unpack_to_too_much_are_refused(tmp_path: Path) -> None:
    path = as_parquet(tmp_path / "log.parquet", time=TIME, speed=["1", "2", "3" * 1000])
    with pytest.raises(BadInput, match=r"unpacks to \d+ MB in the columns speed, time, and 0 MB at most"):
        read_parquet(path, NAMES, "test", ReadLimits(file_bytes=1000))


def varint(number: int, length: int = 0) -> bytes:
    """As Thrift's compact protocol writes an i64, drawn out to `length` bytes."""
    rest, found = 2 * number, bytearray()
    while rest or not found or len(found) < length:
        found.append(rest & 0x7F | 0x80)
        rest >>= 7
    found[-1] &= 0x7F
    return bytes(found)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux bounds the memory of a process")
def test_a_directory_that_lies_about_its_size_is_found_out_in_little_memory(tmp_path: Path) -> None:
    """A text of 100 MB in some kB, of which the file says that it has 50 bytes."""
    import resource

    path = tmp_path / "liar.parquet"
    table = pa.table({"time": [0.0, 1.0], "speed": ["1" * 100_000_000, "2"]})
    parquet.write_table(table, path, compression="zstd", use_dictionary=False, write_statistics=False)
    group = parquet.ParquetFile(path).metadata.row_group(0)
    content = path.read_bytes()
    for size in (group.column(1).total_uncompressed_size, group.total_byte_size):
        content = content.replace(varint(size), varint(50, len(varint(size))))
    path.write_bytes(content)
    assert parquet.ParquetFile(path).metadata.row_group(0).column(1).total_uncompressed_size == 50
    before = resource.getrlimit(resource.RLIMIT_AS), pa.default_memory_pool().backend_name
    with pytest.raises(BadInput, match=r"liar\.parquet takes more memory than .* call for; export it again"):
        read_parquet(path, NAMES, "test", ReadLimits(memory=60_000_000))
    with pytest.raises(BadInput, match=r"load: .*liar\.parquet takes more memory than .* call for; export it again"):
        read_parquet_log(path, ReadLimits(memory=60_000_000))
    assert (resource.getrlimit(resource.RLIMIT_AS), pa.default_memory_pool().backend_name) == before
    assert read_parquet(as_parquet(path, time=TIME, speed=SPEED), NAMES, "test").values.shape == (3, 2)


def test_logs_of_a_data_set_are_counted_together(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    as_parquet(tmp_path / "log.parquet", command=[1, 2, 3], other=[1, 2, 3], time=TIME, speed=SPEED)
    text = 'file = "log.parquet"\ncolumns = ["time", "command", "speed"]\n[signals.other]\nrole = "input"\nunit = "V"\n'
    text += '[[records]]\nkind = "other"\nfile = "log.parquet"\ncolumns = ["time", "other", "speed"]'
    monkeypatch.setattr("pysim.io.dataset.LIMITS", ReadLimits(dataset_numbers=18))
    assert len(read_dataset(described(tmp_path, text)).records) == 2
    monkeypatch.setattr("pysim.io.dataset.LIMITS", ReadLimits(dataset_numbers=17))
    with pytest.raises(BadInput, match=r"line 17: with this log the data set holds 18 numbers, and 17"):
        read_dataset(tmp_path)


def test_rows_keep_their_order_and_number_from_batch_to_batch(tmp_path: Path) -> None:
    rows = np.arange(1000)
    moments = np.datetime64(START) + rows.astype("timedelta64[s]")
    columns = {
        "a": rows / 8,
        "b": pa.array([f"{k % 7}" for k in rows]),
        "c": moments,
        "d": pa.array(rows.tolist(), pa.decimal128(9)),
    }
    path = as_parquet(tmp_path / "log.parquet", **columns)
    found = read_parquet(path, ("c", "a", "d", "b"), "test", ReadLimits(batch_rows=64))
    np.testing.assert_array_equal(found.values, np.column_stack([rows, rows / 8, rows, rows % 7]))
    assert found.seconds == {"c"}
    path = as_parquet(tmp_path / "log.parquet", a=np.where(rows == 700, np.nan, rows))
    with pytest.raises(BadInput, match="row 701: a is empty or not a number"):
        read_parquet(path, ("a",), "test", ReadLimits(batch_rows=64))


def test_a_column_of_lists_holds_no_numbers(tmp_path: Path) -> None:
    path = as_parquet(tmp_path / "log.parquet", time=TIME, speed=[[1.0], [2.0], [3.0]])
    with pytest.raises(BadInput, match=r"speed holds list.* and no numbers; write one number a row"):
        read_parquet(path, NAMES, "test")
