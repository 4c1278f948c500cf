"""`pysim frf` on a data set written as a bench writes it."""

import json
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from tests.pysim.identify.frf.systems import log, response, white

F = (0.1, 2.0, 10.0)
HEAD = """[dataset]
name = "small"

[signals.cmd]
role = "input"
unit = "%"

[signals.y]
role = "output"
unit = "%"
noise = 0.1
"""


@pytest.fixture
def bench(tmp_path: Path) -> Path:
    """Three stepped sines as text files with a dataset.toml."""
    folder, toml = tmp_path / "bench", HEAD
    folder.mkdir()
    for f in F:
        data = log(f, noise=white(6000, 0.1, round(10 * f)), periods=max(2.0, 2 * f)).data
        rows = np.column_stack([data.time, data.values])  # type: ignore[union-attr]
        np.savetxt(folder / f"{f:g}Hz.txt", rows, fmt="%.5f", delimiter="\t", header="time\tcmd\ty", comments="")
        toml += f'[[records]]\nfile = "{f:g}Hz.txt"\ncolumns = ["time", "cmd", "y"]\nkind = "frequency-response"\n'
        toml += f'offset = 50.0\namplitude = 10.0\nfrequency = {f}\nuse = "fit"\n'
    (folder / "dataset.toml").write_text(toml)
    return folder


def test_writes_table_numbers_and_report(bench: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["frf", str(bench), "--json", str(tmp_path / "frf.json"), "--output", str(tmp_path / "report")]
    assert main([*words, "--reference-hz", "none"]) == 0
    one = json.loads((tmp_path / "frf.json").read_text())["responses"][0]
    truth = 20 * np.log10(np.abs(response(np.array(F))))
    assert (np.abs(np.array(one["magnitude_db"]) - truth) < 4 * np.array(one["magnitude_db_deviation"])).all()
    assert "10 " in capsys.readouterr().out
    assert "--reference-hz none" in (tmp_path / "report" / "report.html").read_text()
    assert (tmp_path / "report" / "frf.png").read_bytes().startswith(b"\x89PNG")


def test_gains_are_absolute_where_the_thesis_reference_was_not_measured(
    bench: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["frf", str(bench)]) == 0
    assert "Magnitudes are relative to 0.1 Hz." in capsys.readouterr().out
    head, _, *rest = (bench / "dataset.toml").read_text(encoding="utf-8").split("[[records]]")
    (bench / "dataset.toml").write_text("[[records]]".join([head, *rest]), encoding="utf-8")
    assert main(["frf", str(bench)]) == 0
    assert "Magnitudes are absolute." in capsys.readouterr().out


def test_wrong_use(bench: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["frf", str(bench), "--reference-hz", "0.3"]) == 2
    assert "magnitudes relative to 0.3 Hz need that frequency" in capsys.readouterr().err
    assert main(["frf", str(bench), "--settle", "-1"]) == 2
    assert "settle_time is -1; it must be finite and not negative" in capsys.readouterr().err
    assert main(["frf", str(bench), "--signal", "z"]) == 2
    assert "no output 'z'" in capsys.readouterr().err
