"""`pysim signal`: the file holds the signal that was asked for."""

import html
import shlex
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.excitation import Chirp, Excitation, LeadIn, LineGrid, Multisine, PiersonMoskowitz, Step, StochasticWave
from pysim.excitation import SteppedSineCommand as Sine
from pysim.io import read_signal
from pysim.present.report import MARKER
from tests.pysim.cli.ran import refused

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
def test_the_file_is_the_signal(words: str, test: Excitation, tmp_path: Path) -> None:
    path = tmp_path / "s.csv"
    assert main(["signal", *words.split(), "-o", str(path)]) == 0
    signal = read_signal(path, "test")
    t = np.arange(round(test.duration * 1000) + 1) / 1000
    np.testing.assert_allclose(signal.value(t), test.signal().value(t), atol=1e-8)
    assert signal.starts[-1] == pytest.approx(test.duration, abs=1e-3)


@pytest.mark.parametrize(
    ("words", "stem"),
    [("chirp --amplitude 5 --sweep 5 --unit V", "chirp"), ("step --offset 20 --height 10 --length 2", "step")],
)
def test_output_writes_picture_and_page(words: str, stem: str, tmp_path: Path) -> None:
    files = ["-o", str(tmp_path / "s.csv"), "--output", str(tmp_path / "r")]
    assert main(["signal", *words.split(), *files]) == 0
    assert {path.name for path in (tmp_path / "r").iterdir()} == {f"{stem}.png", f"{stem}.svg", "report.html", MARKER}
    assert f"value [{'V' if stem == 'chirp' else '%'}]" in (tmp_path / "s.csv").read_text()


@pytest.mark.parametrize(
    "words",
    [
        "step --offset=-1e-7 --height -2 --length 1 --back --ramp-down 0 --rest 0",
        "multisine --period 5 --peak 9 --lines odd --seed 3 --unit 'mm of oil'",
    ],
)
def test_file_and_page_hold_the_line_that_makes_them_again(words: str, tmp_path: Path) -> None:
    file, page = tmp_path / "my signals" / "s.csv", tmp_path / "r" / "report.html"
    assert main(["signal", *shlex.split(words), "-o", str(file), "--output", str(page.parent)]) == 0
    held, line = file.read_bytes(), file.read_text().splitlines()[0].removeprefix("# ")
    assert html.escape(line) in page.read_text()
    file.unlink()
    again = shlex.split(line)
    assert main(again[again.index("signal") :]) == 0
    assert file.read_bytes() == held


def test_without_its_picture_nothing_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise RuntimeError("no picture")

    monkeypatch.setattr("pysim.present.excitation.excitation_figure", fails)
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
    refused(["signal", *words.split()], capsys, message)
    assert not (tmp_path / "s.csv").exists()


def test_the_file_may_be_called_output_as_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    monkeypatch.chdir(tmp_path)
    words = ["signal", "step", "--height", "1", "--length", "1"]
    assert main([*words, "-o", "a.csv"]) == main([*words, "--output", "b.csv"]) == 0
    first, second = (read_signal(tmp_path / name, "test") for name in ("a.csv", "b.csv"))
    np.testing.assert_array_equal(first.starts, second.starts)
    np.testing.assert_array_equal(first.cubics, second.cubics)
    refused([*words, "--output", "folder"], capsys, "name the file to write, -o FILE.csv")
