"""`pysim signal`: the file holds the signal that was asked for."""

from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.excitation import Chirp, Excitation, LeadIn, LineGrid, Multisine, PiersonMoskowitz, Step, StochasticWave
from pysim.excitation import SteppedSineCommand as Sine
from pysim.io import read_signal

SEA = PiersonMoskowitz(100.0, 1.0)
CASES: list[tuple[str, Excitation]] = [
    ("stepped-sine --offset 50 --amplitude 10 --frequency 5 --periods 7", Sine(50.0, 10.0, 5.0, 7.0)),
    ("chirp --offset -50 --amplitude 10 --sweep 10", Chirp(-50.0, 10.0, 0.1, 30.0, 10.0)),
    ("step --offset 20 --height 10 --length 2 --back --ramp-down 0", Step(20, 10, 2, True, LeadIn(ramp_down=0.0))),
    ("stochastic --height 100 --peak-period 1 --seed 4", StochasticWave(SEA, 30.0, 4)),
    (
        "stochastic --height 100 --peak-period 1 --components 20 --length 10",
        StochasticWave(SEA, 10.0, 0, 20),
    ),
    ("multisine --period 5 --rms 5 --offset 50", Multisine(LineGrid(5.0, 0.1, 30.0), 0, rms=5.0, offset=50.0)),
    (
        "multisine --period 5 --peak 9 --lines odd --low-hz 1 --high-hz 10 --seed 3 --hold 2",
        Multisine(LineGrid(5.0, 1.0, 10.0, "odd"), 3, peak=9.0, lead=LeadIn(hold=2.0)),
    ),
]


@pytest.mark.parametrize(("words", "test"), CASES, ids=[words for words, _ in CASES])
def test_the_file_is_the_signal(words: str, test: Excitation, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    path = tmp_path / "s.csv"
    assert main(["signal", *words.split(), "-o", str(path)]) == 0
    signal = read_signal(path, "test")
    t = np.arange(round(test.duration * 1000) + 1) / 1000
    np.testing.assert_allclose(signal.value(t), test.signal().value(t), atol=1e-8)
    assert signal.starts[-1] == pytest.approx(test.duration, abs=1e-3)
    out = capsys.readouterr().out
    assert f"excitation from {test.onset:g} to {test.end:g} s" in out
    values = test.signal().value(t[(t >= test.onset) & (t < test.end)])
    assert f"to {values.max():.4g} %" in out


def test_output_writes_picture_and_page(tmp_path: Path) -> None:
    words = ["signal", "chirp", "--amplitude", "5", "--sweep", "5", "--unit", "V", "-o", str(tmp_path / "s.csv")]
    assert main([*words, "--output", str(tmp_path / "r")]) == 0
    assert (tmp_path / "s.csv").read_text().startswith("# chirp: amplitude 5.0")
    assert (tmp_path / "r" / "chirp.png").read_bytes().startswith(b"\x89PNG")
    assert "excitation from 2 to 7 s" in (tmp_path / "r" / "report.html").read_text()
    assert "value [V]" in (tmp_path / "s.csv").read_text()


def test_a_step_is_told_and_drawn(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    words = ["signal", "step", "--offset", "20", "--height", "10", "--length", "2", "-o", str(tmp_path / "s.csv")]
    assert main([*words, "--output", str(tmp_path / "r")]) == 0
    out = capsys.readouterr().out
    assert "jumps at 2 s from 20 to 30 %\n" in out
    assert "fastest" not in out
    assert "rms" not in out
    assert {path.name for path in (tmp_path / "r").iterdir()} == {"step.png", "step.svg", "report.html"}
    assert "the excitation proper shaded.<" in (tmp_path / "r" / "report.html").read_text()  # and no spectrum
    assert main([*words, "--back", "--ramp", "0"]) == 0
    assert (
        "jumps at 0.5 s from 0 to 20 %, at 1.5 s from 20 to 30 %, at 3.5 s from 30 to 20 %" in capsys.readouterr().out
    )
    assert main(["signal", "chirp", "--amplitude", "5", "--sweep", "5", "-o", str(tmp_path / "c.csv")]) == 0
    assert "jumps" not in capsys.readouterr().out


def test_without_its_picture_nothing_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise RuntimeError("no picture")

    monkeypatch.setattr("pysim.plot.excitation_figure", fails)
    words = ["signal", "chirp", "--amplitude", "5", "--sweep", "5", "-o", str(tmp_path / "s.csv")]
    assert main([*words, "--output", str(tmp_path / "r")]) == 3
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("chirp --amplitude 0 --sweep 5 -o s.csv", "the amplitude is 0"),
        ("chirp --amplitude 1 --sweep 5 -o s.txt", "write one of .csv"),
        ("chirp --amplitude 1 -o s.csv", "--sweep"),
        ("multisine --period 5 -o s.csv", "one of the arguments --rms --peak"),
        ("stepped-sine --amplitude 1 --frequency 1 --periods inf -o s.csv", "rows; between 2"),
        (
            "chirp --amplitude 1 --sweep 5 --stop-hz 30 --sampling 60 -o s.csv",
            "do not show 30 Hz; give more than twice",
        ),
        ("stochastic --height 1 --peak-period 1 --seed -1 -o s.csv", "the seed is -1"),
    ],
)
def test_wrong_use(
    words: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["signal", *words.split()]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "s.csv").exists()


def test_a_command_of_a_single_row_has_its_facts(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    words = ["signal", "step", "--height", "1", "--length", "0.0004", "-o", str(tmp_path / "s.csv")]
    assert main(words) == 0
    assert "jumps at" in capsys.readouterr().out


def test_the_file_may_be_called_output_as_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    words = ["signal", "step", "--height", "1", "--length", "1"]
    assert main([*words, "-o", "a.csv"]) == main([*words, "--output", "b.csv"]) == 0
    assert (tmp_path / "a.csv").read_text() == (tmp_path / "b.csv").read_text()
    capsys.readouterr()
    assert main([*words, "--output", "folder"]) == 2
    assert "name the file to write, -o FILE.csv" in capsys.readouterr().err
