"""`pysim chirp` on single logs and data sets."""

import json
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.present.report import MARKER
from pysim.types import MeasuredRecord, Record
from tests.pysim.cli.ran import refused
from tests.pysim.identify.chirp.chirps import log as chirp_log
from tests.pysim.identify.chirp.chirps import response
from tests.pysim.identify.frf.systems import log as sine_log

HEAD = """[dataset]
name = "small"

[signals.u]
role = "input"
unit = "%"

[signals.y]
role = "output"
unit = "%"
noise = 0.05

[[records]]
file = "chirp.txt"
columns = ["time", "u", "y"]
kind = "chirp"
offset = 50.0
amplitude = 10.0
use = "fit"

[[records]]
file = "5Hz.txt"
columns = ["time", "u", "y"]
kind = "frequency-response"
offset = 50.0
amplitude = 10.0
frequency = 5.0
use = "fit"
"""


def write(path: Path, record: MeasuredRecord) -> None:
    assert isinstance(record.data, Record)
    rows = np.column_stack([record.data.time, record.data.values])
    np.savetxt(path, rows, fmt="%.5f", delimiter="\t", header="t\tu\ty", comments="")


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A chirp and one stepped sine as text files."""
    folder = tmp_path_factory.mktemp("bench")
    write(folder / "chirp.txt", chirp_log(1.0, noise=0.05))
    write(folder / "5Hz.txt", sine_log(5.0))
    (folder / "dataset.toml").write_text(HEAD)
    return folder


def test_a_data_set_gives_table_numbers_and_report(bench: Path, tmp_path: Path) -> None:
    assert main(["chirp", str(bench), "--json", str(tmp_path / "c.json"), "--output", str(tmp_path / "report")]) == 0
    (one,) = json.loads((tmp_path / "c.json").read_text())["chirps"]
    mean = {key: np.array(value) for key, value in one["mean"].items()}
    truth = 20 * np.log10(np.abs(response(mean["frequency_hz"])))
    inside = (mean["frequency_hz"] > 2) & (mean["frequency_hz"] < 20)
    assert (np.abs(mean["magnitude_db"] - truth) < 4.5 * mean["magnitude_db_deviation"] + 0.03)[inside].all()
    assert (one["offset"], one["rate_hz_per_s"]) == (pytest.approx(50.0, abs=1e-4), pytest.approx(1.0, rel=1e-6))
    assert {path.name for path in (tmp_path / "report").iterdir()} == {"chirp.png", "chirp.svg", "report.html", MARKER}


def test_a_single_log_needs_its_columns(bench: Path, tmp_path: Path) -> None:
    words = ["chirp", str(bench / "chirp.txt"), "--columns", "time,u,y", "--json", str(tmp_path / "c.json")]
    assert main(words) == 0
    (one,) = json.loads((tmp_path / "c.json").read_text())["chirps"]
    assert one["offset"] == pytest.approx(50.0, abs=1e-4)


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["{}/chirp.txt"], ["chirp.txt", "--columns time,command,response"]),
        (["{}/chirp.txt", "--columns", "time,u,y", "--units", "%"], ["units"]),
        (["{}/none.txt", "--columns", "time,u,y"], ["none.txt"]),
        (["{}", "--signal", "z"], ["z"]),
        (["{}", "--columns", "time,u,y"], ["--columns", "leave it out"]),
        (["{}", "--units", "bar,bar"], ["--units", "leave it out"]),
    ],
)
def test_mistakes_are_one_line(
    bench: Path, words: list[str], named: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    refused(["chirp", *(word.format(bench) for word in words)], capsys, *named)
