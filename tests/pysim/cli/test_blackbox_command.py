"""`pysim blackbox`: exit codes, refusals, and what it leaves behind."""

import json
import shlex
from pathlib import Path

import pytest

from pysim.cli import main
from pysim.present.report import MARKER
from pysim.thesis import write_dataset
from tests.pysim.cli.ran import refused


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_dataset(tmp_path_factory.mktemp("thesis") / "data")


def test_a_row_of_the_thesis_comes_back(folder: Path, tmp_path: Path) -> None:
    numbers, out = tmp_path / "n.json", tmp_path / "out"
    words = ["blackbox", str(folder), "--poles", "5", "--test=-25/10", "--json", str(numbers), "--output", str(out)]
    assert main(words) == 0
    (one,) = json.loads(numbers.read_text())["responses"]
    assert one["denominator"] == pytest.approx([1, 208, 88674, 12347e3, 1452e6, 69731e6], rel=1e-6)
    assert {p.name for p in out.iterdir()} == {
        "report.html",
        "blackbox_O-25_A10.png",
        "blackbox_O-25_A10.svg",
        MARKER,
    }


def test_the_report_says_how_to_do_it_again(folder: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    words = ["blackbox", str(folder), "--poles", "2", "--zeros", "1", "--dead-time-max", "0.02", "--stable"]
    words += ["--weights", "relative", "--test=25/5", "--test=-25/10", "--output", str(out)]
    assert main(words) == 0
    line = next(x for x in (out / "report.html").read_text().splitlines() if "pysim blackbox" in x)
    again = shlex.split(line[line.index("blackbox") :].replace("</pre>", ""))
    (out / "report.html").unlink()
    assert main(again[: again.index(str(out)) + 1]) == 0
    assert "pysim blackbox" in (out / "report.html").read_text()


def test_pictures_have_names_of_their_own_on_any_system(tmp_path: Path) -> None:
    data, out, outputs = tmp_path / "data", tmp_path / "out", ("p/bar", "P:bar", "y")
    data.mkdir()
    text = '[dataset]\nname = "d"\n[signals.u]\nrole = "input"\nunit = "%"\n'
    text += "".join(f'[signals."{name}"]\nrole = "output"\nunit = "%"\n' for name in outputs)
    for k, name in enumerate((*outputs, "y")):
        (data / f"{k}.csv").write_text("".join(f"{f},{-f},{-10 * f}\n" for f in (0.1, 0.5, 1, 2, 4)))
        text += f'[[records]]\nfile = "{k}.csv"\ncolumns = ["frequency_hz", "magnitude_db", "phase_deg"]\n'
        text += f'kind = "frequency-response-table"\noffset = 25\namplitude = 5\noutput = "{name}"\n'
    (data / "dataset.toml").write_text(text)
    assert main(["blackbox", str(data), "--poles", "1", "--output", str(out)]) == 0
    pictures = {p.name.removeprefix("blackbox_O+25_A5_") for p in out.glob("*.svg")}
    assert pictures == {"p_bar_to_u.svg", "P_bar_to_u_2.svg", "y_to_u.svg", "y_to_u_2.svg"}


def test_orders(folder: Path, tmp_path: Path) -> None:
    words = ["blackbox", str(folder), "--poles", "3", "--orders", "suggest", "--test", "50/20"]
    assert main([*words, "--json", str(tmp_path / "n.json")]) == 0
    (one,) = json.loads((tmp_path / "n.json").read_text())["responses"]
    assert len(one["denominator"]) <= 4


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--poles", "5", "--test", "7/7"], "no test 7/7"),
        (["--poles", "-1"], "structure: "),
        (["--poles", "3", "--zeros", "1", "--orders", "suggest"], "leave them out"),
        (["--poles", "0", "--orders", "suggest"], "nothing to compare"),
        (["--poles", "5", "--weights", "covariance"], "has no covariance"),
        (["--poles", "5", "--test", "x"], "offset/amplitude"),
        ([], "--poles"),
    ],
)
def test_wrong_use(folder: Path, words: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    refused(["blackbox", str(folder), *words], capsys, says)
