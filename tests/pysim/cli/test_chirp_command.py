"""`pysim chirp` on single logs and data sets."""

import json
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
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


def write(path: Path, record) -> None:
    rows = np.column_stack([record.data.time, record.data.values])
    np.savetxt(path, rows, fmt="%.5f", delimiter="\t", header="t\tu\ty", comments="")


@pytest.fixture
def bench(tmp_path: Path) -> Path:
    """A chirp and one stepped sine as text files."""
    folder = tmp_path / "bench"
    folder.mkdir()
    write(folder / "chirp.txt", chirp_log(1.0, noise=0.05))
    write(folder / "5Hz.txt", sine_log(5.0))
    (folder / "dataset.toml").write_text(HEAD)
    return folder


def test_a_data_set_gives_table_numbers_and_report(bench: Path, tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    assert main(["chirp", str(bench), "--json", str(tmp_path / "c.json"), "--output", str(tmp_path / "report")]) == 0
    (one,) = json.loads((tmp_path / "c.json").read_text())["chirps"]
    mean = {key: np.array(value) for key, value in one["mean"].items()}
    truth = 20 * np.log10(np.abs(response(mean["frequency_hz"])))
    inside = (mean["frequency_hz"] > 2) & (mean["frequency_hz"] < 20)
    assert (np.abs(mean["magnitude_db"] - truth) < 4.5 * mean["magnitude_db_deviation"] + 0.03)[inside].all()
    assert (one["offset"], one["rate_hz_per_s"]) == (pytest.approx(50.0, abs=1e-4), pytest.approx(1.0, rel=1e-6))
    row = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("       8 "))
    assert float(row.split()[1]) == pytest.approx(20 * np.log10(abs(response(np.array(8.0)))), abs=0.05)
    assert (tmp_path / "report" / "chirp.png").read_bytes().startswith(b"\x89PNG")
    assert "chirp.txt: tops, bottoms" in (tmp_path / "report" / "report.html").read_text()


def test_a_single_log_needs_its_columns(bench: Path, capsys: pytest.CaptureFixture) -> None:
    log = str(bench / "chirp.txt")
    assert main(["chirp", log]) == 2
    assert "--columns time,command,response" in capsys.readouterr().err
    assert main(["chirp", log, "--columns", "time,u,y"]) == 0
    assert "chirp.txt: y to u around 50 %" in capsys.readouterr().out
    assert main(["chirp", log, "--columns", "time,u,y", "--units", "%"]) == 2
    assert main(["chirp", str(bench / "none.txt"), "--columns", "time,u,y"]) == 2
    assert main(["chirp", str(bench), "--signal", "z"]) == 2
    capsys.readouterr()
    for option, words in (("--columns", "time,u,y"), ("--units", "bar,bar")):
        assert main(["chirp", str(bench), option, words]) == 2
        assert f"{option}: {bench} is a data set" in capsys.readouterr().err
