import json
from pathlib import Path

import pytest

from pysim.cli import main
from pysim.present.report import MARKER
from tests.pysim.cli.ran import refused
from tests.pysim.cosim.described import controlled, oscillator
from tests.pysim.simulate.text_models import DISCARDS, text_model


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("cosim")
    controlled(place)
    oscillator(place)
    return place


def test_a_system_is_run_and_reported(folder: Path, tmp_path: Path) -> None:
    words = ["cosim", str(folder / "controlled.toml"), "--output", str(tmp_path / "out")]
    assert main([*words, "--json", str(tmp_path / "run.json"), "--stop", "12"]) == 0
    numbers = json.loads((tmp_path / "run.json").read_text())
    assert (numbers["outcome"], numbers["rows"], numbers["end_s"]) == ("done", 1201, 12.0)
    assert {s["name"]: s["end"] for s in numbers["signals"]}["plant.y"] == pytest.approx(3.0, abs=1e-3)
    assert (tmp_path / "out" / "record.csv").read_text().count("\n") >= 1201
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {"record.csv", "cosim.png", "cosim.svg", "report.html", MARKER}


def test_an_exported_system_is_run(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    package, numbers = tmp_path / "oscillator.ssp", tmp_path / "run.json"
    assert main(["cosim", str(folder / "oscillator.toml"), "--export-ssp", str(package)]) == 0
    assert main(["cosim", str(package), "--stop", "0.1", "--step", "0.002", "--json", str(numbers)]) == 0
    assert "spring.x" in {signal["name"] for signal in json.loads(numbers.read_text())["signals"]}
    before = package.read_bytes()
    refused(["cosim", str(package), "--export-ssp", str(package)], capsys, "choose another name")
    assert package.read_bytes() == before


def test_a_run_that_stops_early_is_told_and_kept(folder: Path, tmp_path: Path) -> None:
    text_model(DISCARDS, folder)
    (folder / "falling.csv").write_text("time,value\n0,0\n1,-2\n")
    (folder / "fails.toml").write_text(
        '[members.root]\nfmu = "Discards_2.fmu"\n[inputs]\nroot.u = "falling.csv"\n[run]\nstop = 1.0\nstep = 0.01\n'
    )
    assert (
        main(["cosim", str(folder / "fails.toml"), "--output", str(tmp_path), "--json", str(tmp_path / "j.json")]) == 1
    )
    assert json.loads((tmp_path / "j.json").read_text())["end_s"] == pytest.approx(0.5, abs=0.03)
    assert (tmp_path / "report.html").exists()


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["none.toml"], ["none.toml"]),
        (["controlled.toml", "--step", "0"], ["--step: 0", "give a positive number"]),
        (["controlled.toml", "--step", "0.008"], ["controlled.toml", "every = 0.01 s is no whole number"]),
        (["controlled.toml", "--export-ssp", "a.zip"], ["--export-ssp a.zip", ".ssp"]),
        (["controlled.toml", "--export-ssp", "a.ssp"], ["cannot hold controller", "fmus_only=True"]),
    ],
)
def test_mistakes_are_one_line(
    folder: Path, words: list[str], named: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    refused(["cosim", str(folder / words[0]), *words[1:]], capsys, *named)
