"""Logs whose names alone say what they are."""

from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_thesis_folder
from pysim.types import BadInput, MeasuredSignal

COMMAND = MeasuredSignal("cmd", "input", "bar", "command", "p_ref")
OUTPUT = MeasuredSignal("angle", "output", "%", "angle", "angle", noise=0.1)
SIGNALS = (COMMAND, OUTPUT)


def sine(path: Path, frequency: float, *, offset: float = 25.0, amplitude: float = 10.0, rate: float = 100.0) -> None:
    """Two periods and a half of a command with the noise of a logger, and an answer of half its size."""
    path.parent.mkdir(parents=True, exist_ok=True)
    time = 2.0 + np.arange(int(2.5 * rate / frequency)) / rate
    wave = amplitude * np.sin(2 * np.pi * frequency * time + 1.0)
    noise = np.random.default_rng(3).normal(0, 1e-3 * amplitude, time.size)
    np.savetxt(path, np.column_stack([time, offset + wave + noise, 0.5 * wave]), header="t cmd angle", comments="")


def test_folders_tell_the_operating_point_and_files_the_frequency(tmp_path: Path) -> None:
    for folder, offset, amplitude in (("O+25_A10", 25, 10), ("O-50_A2.5", -50, 2.5)):
        for name, frequency in (("10Hz.txt", 10), ("0.5Hz.txt", 0.5), ("2,5 Hz.txt", 2.5)):
            sine(tmp_path / folder / name, frequency, offset=offset, amplitude=amplitude)
    data = read_thesis_folder(tmp_path, SIGNALS)
    assert [record.source for record in data.records[:3]] == [
        f"O+25_A10/{name}" for name in ("0.5Hz.txt", "2,5 Hz.txt", "10Hz.txt")
    ]
    told = [(record.offset, record.amplitude, record.frequency) for record in data.records]
    assert told[:3] == [(25e5, 10e5, f) for f in (0.5, 2.5, 10.0)]  # bar in the names
    assert told[3:] == [(-50e5, 2.5e5, f) for f in (0.5, 2.5, 10.0)]
    assert {(record.kind, record.use) for record in data.records} == {("frequency-response", "fit")}
    assert (data.signal("cmd").unit, data.signal("cmd").variable, data.name) == ("Pa", "p_ref", tmp_path.name)
    log = data.records[0].data
    assert (log.names, log.units) == (("cmd", "angle"), ("Pa", "%"))
    np.testing.assert_allclose(log["cmd"][:3], 1e5 * np.loadtxt(tmp_path / "O+25_A10/0.5Hz.txt", skiprows=1)[:3, 1])


@pytest.mark.parametrize(
    ("name", "frequency"),
    [
        ("0.1.txt", 0.1),
        ("12.csv", 12),
        ("f_4Hz_b.log", 4),
        ("10hz.dat", 10),
        ("run3_5_Hz.txt", 5),
        ("O+7_A2_8Hz.txt", 8),
    ],
)
def test_frequencies_in_names(tmp_path: Path, name: str, frequency: float) -> None:
    sine(tmp_path / name, frequency, offset=7.0, amplitude=2.0)
    record = read_thesis_folder(tmp_path, SIGNALS).records[0]
    assert record.frequency == frequency
    assert (record.offset, record.amplitude) == (7e5, 2e5)


def test_what_the_names_do_not_tell_is_read_off_the_command(tmp_path: Path) -> None:
    for frequency, offset, amplitude in ((1, -30.0, 7.5), (7, -30.0, 7.5)):
        sine(tmp_path / f"{frequency}Hz.txt", frequency, offset=offset, amplitude=amplitude)
    told = [(record.offset, record.amplitude) for record in read_thesis_folder(tmp_path, SIGNALS).records]
    assert told == [(-30e5, 7.5e5)] * 2  # the noise of the logs is rounded away


def test_the_name_of_the_folder_itself_counts(tmp_path: Path) -> None:
    sine(tmp_path / "O+25_A10" / "1Hz.txt", 1.0, offset=24.0)
    assert read_thesis_folder(tmp_path / "O+25_A10", SIGNALS).records[0].offset == 25e5


def test_other_files_are_left_out_and_named(tmp_path: Path) -> None:
    sine(tmp_path / "1Hz.txt", 1.0)
    (tmp_path / "remarks.txt").write_text("oil at 40 degrees")
    (tmp_path / "1Hz.png").write_bytes(b"")
    assert read_thesis_folder(tmp_path, SIGNALS).description.endswith("left out: remarks.txt")


@pytest.mark.parametrize(
    ("signals", "words"),
    [
        ((COMMAND,), 'needs one with the role "input"'),
        ((OUTPUT, OUTPUT), "give each another name"),
        ((COMMAND, MeasuredSignal("x", "output", "percent", "", "x")), "signal x: unit = 'percent' is not known"),
    ],
)
def test_refuses_signals_that_make_no_sense(tmp_path: Path, signals: tuple[MeasuredSignal, ...], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        read_thesis_folder(tmp_path, signals)


def test_two_logs_of_one_frequency_are_refused(tmp_path: Path) -> None:
    sine(tmp_path / "a" / "1Hz.txt", 1.0)
    sine(tmp_path / "b" / "1Hz.txt", 1.0)
    assert len(read_thesis_folder(tmp_path, SIGNALS).records) == 2
    sine(tmp_path / "b" / "copy of 1.0Hz.txt", 1.0)
    with pytest.raises(BadInput, match=r"copy of 1\.0Hz\.txt: 1Hz\.txt beside it is of 1 Hz too"):
        read_thesis_folder(tmp_path, SIGNALS)


def test_two_logs_of_one_point_are_refused_with_another_point_between_them(tmp_path: Path) -> None:
    for name, offset in (("a_O+25_A10_1Hz", 25), ("b_O+30_A10_1Hz", 30), ("c_O+25_A10_1Hz", 25)):
        sine(tmp_path / f"{name}.txt", 1.0, offset=offset)
    with pytest.raises(BadInput, match=r"c_O\+25_A10_1Hz\.txt: a_O\+25_A10_1Hz\.txt beside it is of 1 Hz too"):
        read_thesis_folder(tmp_path, SIGNALS)


def test_refuses_faulty_folders_and_logs(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="is no folder that can be read"):
        read_thesis_folder(tmp_path / "none", SIGNALS)
    with pytest.raises(BadInput, match="holds no log with a frequency in its name"):
        read_thesis_folder(tmp_path, SIGNALS)
    sine(tmp_path / "60Hz.txt", 10.0)
    with pytest.raises(BadInput, match=r"60Hz\.txt: frequency = 60 Hz is not below half the sampling rate .* 100 Hz"):
        read_thesis_folder(tmp_path, SIGNALS)
    (tmp_path / "60Hz.txt").rename(tmp_path / "3Hz.txt")
    with pytest.raises(BadInput, match=r"3Hz\.txt: cmd is no sine of 3 Hz"):
        read_thesis_folder(tmp_path, SIGNALS)
    (tmp_path / "3Hz.txt").write_text("0 1 2\n1 2\n")
    with pytest.raises(BadInput, match=r"3Hz\.txt, line 2: 2 columns where 3 belong \(time, cmd, angle\)"):
        read_thesis_folder(tmp_path, SIGNALS)
    (tmp_path / "3Hz.txt").rename(tmp_path / "0Hz.txt")
    with pytest.raises(BadInput, match=r"0Hz\.txt: frequency and amplitude in its name must be positive"):
        read_thesis_folder(tmp_path, SIGNALS)
