"""`pysim frf` on a data set written as a bench writes it."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.present.report import MARKER
from tests.pysim.cli.ran import refused
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


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three stepped sines as text files with a dataset.toml."""
    folder, toml = tmp_path_factory.mktemp("bench"), HEAD
    for f in F:
        data = log(f, noise=white(6000, 0.1, round(10 * f)), periods=max(2.0, 2 * f)).data
        rows = np.column_stack([data.time, data.values])  # type: ignore[union-attr]
        np.savetxt(folder / f"{f:g}Hz.txt", rows, fmt="%.5f", delimiter="\t", header="time\tcmd\ty", comments="")
        toml += f'[[records]]\nfile = "{f:g}Hz.txt"\ncolumns = ["time", "cmd", "y"]\nkind = "frequency-response"\n'
        toml += f'offset = 50.0\namplitude = 10.0\nfrequency = {f}\nuse = "fit"\n'
    (folder / "dataset.toml").write_text(toml)
    return folder


def test_writes_table_numbers_and_report(bench: Path, tmp_path: Path) -> None:
    words = ["frf", str(bench), "--json", str(tmp_path / "frf.json"), "--output", str(tmp_path / "report")]
    assert main([*words, "--reference-hz", "none"]) == 0
    one = json.loads((tmp_path / "frf.json").read_text())["responses"][0]
    truth = 20 * np.log10(np.abs(response(np.array(F))))
    assert (np.abs(np.array(one["magnitude_db"]) - truth) < 4 * np.array(one["magnitude_db_deviation"])).all()
    assert {path.name for path in (tmp_path / "report").iterdir()} == {"frf.png", "frf.svg", "report.html", MARKER}


def test_gains_are_absolute_where_the_thesis_reference_was_not_measured(bench: Path, tmp_path: Path) -> None:
    own = Path(shutil.copytree(bench, tmp_path / "own"))

    def reference() -> float | None:
        assert main(["frf", str(own), "--json", str(tmp_path / "frf.json")]) == 0
        found: float | None = json.loads((tmp_path / "frf.json").read_text())["reference_hz"]
        return found

    assert reference() == 0.1
    head, _, *rest = (own / "dataset.toml").read_text(encoding="utf-8").split("[[records]]")
    (own / "dataset.toml").write_text("[[records]]".join([head, *rest]), encoding="utf-8")
    assert reference() is None


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--reference-hz", "0.3"], ["0.3 Hz need that frequency"]),
        (["--reference-hz", "low"], ["'low' is no frequency", "write a number in Hz, or none"]),
        (["--settle", "-1"], ["settle_time is -1", "not negative"]),
        (["--signal", "z"], ["no output 'z'"]),
    ],
)
def test_mistakes_are_one_line(
    bench: Path, words: list[str], named: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    refused(["frf", str(bench), *words], capsys, *named)
