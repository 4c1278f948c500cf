from pathlib import Path

import numpy as np
import pytest

from pysim.io import read_signal, write_signal
from pysim.types import BadInput, Signal


def test_samples_are_joined_by_straight_lines(tmp_path: Path) -> None:
    (tmp_path / "u.csv").write_text("time [s];u [%]\n0;1,5\n2;2,5\n")
    signal = read_signal(tmp_path / "u.csv", "--input u")
    np.testing.assert_allclose(signal.value(np.array([-1, 0, 1, 2, 3])), [1.5, 1.5, 2.0, 2.5, 2.5])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("time,u\n0,1\n1,2\n\n1,3\n", r"u\.csv, line 5: time 1 s does not increase"),
        ("0,1\n", "holds a single row"),
        ("0,1\n1,x\n", "line 2: 'x' is no number for value"),
        ("0,1\n1,nan\n", "line 2: value is nan"),
        ("t,u,rate\n0,1\n", "2 columns where 3 belong"),
        ("t,u,other\n0,1,2\n1,1,2\n", "3 columns where 2 belong"),
    ],
)
def test_what_is_no_signal_is_refused_with_its_line(tmp_path: Path, text: str, words: str) -> None:
    (tmp_path / "u.csv").write_text(text)
    with pytest.raises(BadInput, match=words):
        read_signal(tmp_path / "u.csv", "--input u")


@pytest.mark.parametrize(
    "heading", ["time value rate", "# time,value,rate", "# made up\n\n#time [s]\tu [V]\trate [V/s]"]
)
def test_a_rate_is_found_under_any_heading(tmp_path: Path, heading: str) -> None:
    rows = " ".join if heading == "time value rate" else ",".join if "," in heading else "\t".join
    lines = [rows(row) for row in (("0", "1", "0"), ("1", "3", "0"))]
    (tmp_path / "u.csv").write_text("\n".join([heading, *lines, ""]))
    signal = read_signal(tmp_path / "u.csv", "--input u")
    np.testing.assert_allclose(signal.value(np.array([0.25, 0.5])), [1 + 2 * (3 / 16 - 2 / 64), 2.0])  # a cubic


def test_what_is_written_comes_back(tmp_path: Path) -> None:
    omega = 2 * np.pi * 20.0
    sine = Signal(np.array([0.0]), np.array([[5.0, 0.0, 0.0, 0.0]]), np.array([[[10.0, 0.3, omega, 0.0]]]))
    write_signal(sine, tmp_path / "u.csv", duration=2.0, unit="%", sampling_hz=500.0, title="a sine\nof 20 Hz")
    lines = (tmp_path / "u.csv").read_text().splitlines()
    assert lines[:2] == ["# a sine", "# of 20 Hz"]
    assert lines[3] == "time [s],value [%],rate [%/s]"
    assert len(lines) == 4 + 1001
    back = read_signal(tmp_path / "u.csv", "test")
    samples = np.arange(1001) / 500.0
    np.testing.assert_allclose(back.value(samples), sine.value(samples), rtol=1e-11)
    np.testing.assert_allclose(back.derivative(samples)[:-1], sine.derivative(samples)[:-1], atol=1e-7)
    assert back.derivative(samples)[-1] == 0.0  # behind the last sample its value holds
    between = np.linspace(0.0, 2.0, 7001)
    worst = np.max(np.abs(back.value(between) - sine.value(between)))
    assert worst == pytest.approx(10 * (omega / 500.0) ** 4 / 384, rel=0.05)  # Hermite's bound, nearly reached


def test_the_last_row_is_not_before_the_end(tmp_path: Path) -> None:
    write_signal(Signal.constant(1.0), tmp_path / "u.csv", duration=1.0004, unit="1", sampling_hz=1000.0)
    assert (tmp_path / "u.csv").read_text().splitlines()[-1].startswith("1.001,")


def test_refuses_what_it_cannot_write(tmp_path: Path) -> None:
    for duration in (0.0, np.inf, 1e9):
        with pytest.raises(BadInput, match="rows; between 2 and"):
            write_signal(Signal.constant(1.0), tmp_path / "u.csv", duration=duration, unit="1")
    with pytest.raises(BadInput, match="cannot write there"):
        write_signal(Signal.constant(1.0), tmp_path / "no" / "u.csv", duration=1.0, unit="1")
