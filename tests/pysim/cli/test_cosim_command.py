import json
from pathlib import Path

import pytest

from pysim.cli import main
from tests.pysim.cosim.described import controlled, oscillator
from tests.pysim.simulate.text_models import DISCARDS, text_model


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("cosim")
    controlled(place)
    oscillator(place)
    return place


def test_a_system_is_run_and_reported(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["cosim", str(folder / "controlled.toml"), "--output", str(tmp_path / "out")]
    assert main([*words, "--json", str(tmp_path / "run.json"), "--stop", "12"]) == 0
    printed = capsys.readouterr()
    assert "controlled: 12 s simulated" in printed.out
    assert "1000/1000" in printed.err
    numbers = json.loads((tmp_path / "run.json").read_text())
    assert (numbers["outcome"], numbers["rows"], numbers["end_s"]) == ("done", 1201, 12.0)
    assert {s["name"]: s["end"] for s in numbers["signals"]}["plant.y"] == pytest.approx(3.0, abs=1e-3)
    page = (tmp_path / "out" / "report.html").read_text()
    for text in (
        "PI, sampled every 10 ms",
        "Lag_2.fmu, FMI 2, model exchange: stepped by our solver",
        "controller.u",
        "plant.u",
        "--stop 12",
        "image/svg+xml",
    ):
        assert text in page
    assert (tmp_path / "out" / "record.csv").read_text().count("\n") >= 1201
    assert (tmp_path / "out" / "cosim.png").stat().st_size > 10_000


def test_an_exported_system_is_run(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    package = tmp_path / "oscillator.ssp"
    assert main(["cosim", str(folder / "oscillator.toml"), "--export-ssp", str(package)]) == 0
    assert f"Written: {package}" in capsys.readouterr().out
    assert main(["cosim", str(package), "--stop", "0.1", "--step", "0.002"]) == 0
    assert "spring.x" in capsys.readouterr().out
    before = package.read_bytes()
    assert main(["cosim", str(package), "--export-ssp", str(package)]) == 2
    assert "this is what is read, and would be lost; choose another name" in capsys.readouterr().err
    assert package.read_bytes() == before
    assert main(["cosim", str(folder / "controlled.toml"), "--export-ssp", str(package)]) == 2
    assert "cannot hold controller, which is Python" in capsys.readouterr().err


def test_a_run_that_stops_early_is_told_and_kept(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text_model(DISCARDS, folder)
    (folder / "falling.csv").write_text("time,value\n0,0\n1,-2\n")
    (folder / "fails.toml").write_text(
        '[members.root]\nfmu = "Discards_2.fmu"\n[inputs]\nroot.u = "falling.csv"\n[run]\nstop = 1.0\nstep = 0.01\n'
    )
    assert (
        main(["cosim", str(folder / "fails.toml"), "--output", str(tmp_path), "--json", str(tmp_path / "j.json")]) == 1
    )
    assert "fails stopped:" in (out := capsys.readouterr().out)
    assert "root" in out
    assert json.loads((tmp_path / "j.json").read_text())["end_s"] == pytest.approx(0.5, abs=0.03)
    assert (tmp_path / "report.html").exists()


def test_wrong_use(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["cosim", str(tmp_path / "none.toml")]) == 2
    assert "none.toml" in capsys.readouterr().err
    assert main(["cosim", str(folder / "controlled.toml"), "--step", "0"]) == 2
    assert "--step 0: give a positive number" in capsys.readouterr().err
    assert main(["cosim", str(folder / "controlled.toml"), "--step", "0.008"]) == 2
    assert "controlled.toml: controller: every = 0.01 s is no whole number" in capsys.readouterr().err
    assert main(["cosim", str(folder / "controlled.toml"), "--export-ssp", str(tmp_path / "a.zip")]) == 2
    assert ".ssp" in capsys.readouterr().err
