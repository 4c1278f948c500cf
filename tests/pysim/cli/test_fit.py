import json
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import fmu_build
from fmu_build.cli import main as build_command
from pysim.cli import fit as fit_command
from pysim.cli import main
from pysim.identify.greybox import Tried
from pysim.io import read_model, write_dataset
from tests.pysim.identify.greybox import measurements as m
from tests.pysim.identify.greybox.conftest import LAG


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("fit")
    (folder / "Lag.mo").write_text(LAG)
    fmu_build.build("Lag", folder / "Lag.fmu", libraries=[folder / "Lag.mo"])
    records = [m.ramp_log(2.0, 0.7, seed=2), *(m.sine_log(2.0, 0.7, f, seed=1) for f in (0.5, 1.0))]
    write_dataset(folder / "data", m.dataset(records))
    return folder


def test_a_fit_writes_numbers_parameters_report_and_log(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["fit", str(place / "data"), "--model", str(place / "Lag.fmu"), "--free", "K,T", "--set", "g=1"]
    code = main([*words, "--json", str(place / "fit.json"), "--output", str(place / "out")])
    assert code == 0
    assert "converged" in capsys.readouterr().out
    data = json.loads((place / "fit.json").read_text())
    assert data["estimates"]["K"]["value"] == pytest.approx(2.0, rel=0.02)
    parameters = tomllib.loads((place / "out" / "parameters.toml").read_text())
    assert parameters == pytest.approx(data["values"])
    assert (place / "out" / "report.html").read_text().count("<img") == 4
    lines = (place / "out" / "log" / "given" / "iterations.jsonl").read_text().splitlines()
    assert json.loads(lines[-1])["outcome"] == "converged"
    assert not list((place / "out" / "log").rglob("state.npz"))  # nothing is left to go on with


def test_a_stopped_fit_goes_on_with_the_same_command(
    place: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """To the same numbers, bit for bit, and without a point that was known; another fit is refused meanwhile."""
    words = ["fit", str(place / "data"), "--model", str(place / "Lag.fmu"), "--free", "K,T", "--set", "g=1"]
    assert main([*words, "--json", str(tmp_path / "whole.json")]) == 0
    out, points = tmp_path / "out", []

    def stop(tried: Tried) -> None:
        points.append((tried.search, tried.tried))
        if len(points) == 2:
            raise KeyboardInterrupt

    monkeypatch.setattr(fit_command, "_say", stop)
    assert main([*words, "--output", str(out)]) == 2
    assert main([*words, "--start", "K=1.5", "--output", str(out)]) == 2
    assert len(points) == 2
    assert main([*words, "--output", str(out), "--json", str(tmp_path / "resumed.json")]) == 0
    assert len(points) == len(set(points))
    whole, resumed = (json.loads((tmp_path / f"{name}.json").read_text()) for name in ("whole", "resumed"))
    assert resumed["values"] == whole["values"]


def test_a_table_without_the_thesis_reference_is_fitted_as_it_is(place: Path, tmp_path: Path) -> None:
    write_dataset(tmp_path / "table", m.dataset([m.table(2.0, 0.7, np.array([0.2, 0.5, 1.0]))]))
    words = ["fit", str(tmp_path / "table"), "--model", str(place / "Lag.fmu"), "--free", "K,T", "--set", "g=1"]
    assert main([*words, "--json", str(tmp_path / "fit.json"), "--output", str(tmp_path / "out")]) == 0
    found = json.loads((tmp_path / "fit.json").read_text())["values"]
    assert (found["K"], found["T"]) == pytest.approx((2.0, 0.7), rel=1e-3)
    assert main([*words, "--reference-hz", "0.1"]) == 2


def test_so_is_one_that_is_refitted_and_compared(place: Path, tmp_path: Path) -> None:
    write_dataset(tmp_path / "table", m.dataset([m.table(2.0, 0.7, np.arange(1, 13) / 10 + 0.1)]))
    words = ["compare", str(tmp_path / "table"), "--model", str(place / "Lag.fmu"), "--refit", "--free", "K,T"]
    words += ["--bounds", "K=0.1:10", "--bounds", "T=0.1:10", "--set", "g=1"]
    words += ["--json", str(tmp_path / "refit.json"), "--output", str(tmp_path / "refit")]
    assert main(words) in (0, 1)
    found = json.loads((tmp_path / "refit.json").read_text())["parameters"]
    assert found["K"]["value"] == pytest.approx(2.0, rel=1e-2)
    assert main([*words, "--reference-hz", "0.5"]) in (0, 1)
    found = json.loads((tmp_path / "refit.json").read_text())["parameters"]
    assert found["T"]["value"] == pytest.approx(0.7, rel=1e-2)
    assert found["K"]["value"] != pytest.approx(2.0, rel=1e-2)  # relative gains say nothing of it


def test_each_operating_point_has_a_picture(place: Path, tmp_path: Path) -> None:
    """Logs of two of them in one folder, and two data sets whose files have the same names."""
    sines = [replace(m.sine_log(2.0, 0.7, f, seed=1), source=f"{f:g}Hz.txt") for f in (0.5, 1.0)]
    other = [replace(sine, source=f"other{sine.source}", amplitude=2 * float(sine.amplitude or 1)) for sine in sines]
    for name in ("one", "two"):
        write_dataset(tmp_path / name, replace(m.dataset([m.ramp_log(2.0, 0.7, seed=2), *sines, *other]), name=name))
    words = ["fit", str(tmp_path / "one"), str(tmp_path / "two"), "--model", str(place / "Lag.fmu")]
    assert main([*words, "--free", "K,T", "--set", "g=1", "--output", str(tmp_path / "out")]) == 0
    page = (tmp_path / "out" / "report.html").read_text()
    assert len(list((tmp_path / "out").glob("sines_*.png"))) == 4
    assert page.count("<img") == 2 + 2 + 4
    assert "Stepped sines, y at w 1, amplitude 2 (one): points measured" in page
    assert "Stepped sines, y at w 1, amplitude 4 (two): points measured" in page


def test_profiles_that_cannot_be_are_refused_before_the_fit(
    place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["fit", str(place / "data"), "--model", str(place / "Lag.fmu"), "--set", "g=1", "--free"]
    assert main([*words, "K,T", "--profile", "K,tau"]) == 2
    assert "--profile tau: not a free parameter; choose of K, T" in capsys.readouterr().err
    assert main([*words, "K", "--profile", "K"]) == 2
    said = capsys.readouterr()
    assert "the only free parameter" in said.err
    assert "cost" not in said.err


def test_an_interval_without_an_end_is_written(place: Path, tmp_path: Path) -> None:
    """Gain and factor are known as a product only."""
    words = ["fit", str(place / "data"), "--model", str(place / "Lag.fmu"), "--free", "K,T,g", "--profile", "g"]
    assert main([*words, "--json", str(tmp_path / "fit.json")]) in (0, 1)
    assert len(json.loads((tmp_path / "fit.json").read_text())["profiles"]["g"]["interval"]) == 2


@pytest.mark.parametrize(
    ("more", "cure"), [([], "--output DIR"), (["--output", "out"], "the same command goes on where it was")]
)
def test_a_stopped_one_says_how_to_go_on(
    place: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    more: list[str],
    cure: str,
) -> None:
    def stop(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("pysim.identify.greybox.fit", stop)
    write_dataset(tmp_path / "table", m.dataset([m.table(2.0, 0.7, np.array([0.1, 0.5, 1.0]))]))
    assert main(["fit", "table", "--model", str(place / "Lag.fmu"), "--free", "K", *more]) != 0
    assert cure in capsys.readouterr().err


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--free", "K", "--set", "T"], "--set T: write NAME=VALUE"),
        (["--free", "K", "--tie", "g=two*K"], "write A=B or A=2.5*B"),
        (["--free", "K", "--bounds", "K=1"], "write NAME=LOW:HIGH"),
        (["--free", "K", "--start", "T=1"], "T has a start or bounds but is not free"),
        (["--free", "K", "--objective", "time", "--optimiser", "gauss-newton"], "sum of squares"),
    ],
)
def test_wrong_words_are_one_line(
    place: Path, capsys: pytest.CaptureFixture[str], more: list[str], message: str
) -> None:
    assert main(["fit", str(place / "data"), "--model", str(place / "Lag.fmu"), *more]) == 2
    assert message in capsys.readouterr().err


def test_an_input_that_never_moves_is_refused(place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    time = np.arange(0, 3, 0.02)
    still = m.log(time, np.full(time.size, 25.0), np.full(time.size, 50.0) + 0.02 * np.sin(9 * time))
    write_dataset(tmp_path / "still", m.dataset([still]))
    words, still = ["--model", str(place / "Lag.fmu"), "--free", "K", "--set", "g=1"], str(tmp_path / "still")
    assert main(["fit", still, *words]) == 2
    said = capsys.readouterr().err
    assert "the input w is constant in every record to fit, so nothing can be told of what moves" in said
    assert main(["fit", still, str(place / "data"), *words]) == 0  # beside one that moves it is welcome


def test_a_fit_begins_where_another_ended(place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Free ones begin there, others are set; what stands in an option goes before."""
    file = tmp_path / "parameters.toml"
    file.write_text("K = 1.9\nT = 0.7\ng = 1.0\n")
    words = ["fit", str(place / "data"), "--model", str(place / "Lag.fmu"), "--free", "K", "--parameters", str(file)]
    assert main([*words, "--json", str(tmp_path / "fit.json"), "--output", str(tmp_path / "out")]) == 0
    found = json.loads((tmp_path / "fit.json").read_text())
    assert found["estimates"]["K"]["start"] == 1.9
    assert (found["values"]["T"], found["values"]["g"]) == (0.7, 1.0)
    assert found["values"]["K"] == pytest.approx(2.0, rel=0.02)
    assert f"--parameters {file}" in (tmp_path / "out" / "report.html").read_text()
    assert main([*words, "--start", "K=1.5", "--set", "T=0.6", "--json", str(tmp_path / "fit.json")]) == 0
    found = json.loads((tmp_path / "fit.json").read_text())
    assert (found["estimates"]["K"]["start"], found["values"]["T"]) == (1.5, 0.6)
    file.write_text("nosuch = 1\n")
    assert main(words) == 2
    assert "has no variable 'nosuch'" in capsys.readouterr().err


def test_a_class_is_fitted_as_its_fmu_is(place: Path, tmp_path: Path) -> None:
    words = ["--free", "K", "--set", "g=1", "--set", "T=0.7"]
    found = []
    for model in (["Lag", "--library", str(place / "Lag.mo")], [str(place / "Lag.fmu")]):
        assert main(["fit", str(place / "data"), "--model", *model, *words, "--json", str(tmp_path / "fit.json")]) == 0
        found.append(json.loads((tmp_path / "fit.json").read_text())["values"])
    assert found[0] == found[1]


def test_parameters_that_are_read_are_not_written_over(
    place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own = tmp_path / "parameters.toml"
    own.write_text("g = 1\n")
    words = ["fit", str(place / "data"), "--model", str(place / "Lag.fmu"), "--free", "K,T"]
    assert main([*words, "--parameters", str(own), "--output", str(tmp_path)]) == 2
    assert "parameters.toml is read, and the new answer would replace it" in capsys.readouterr().err
    assert own.read_text() == "g = 1\n"


def test_what_was_fitted_is_built_into_an_fmu(place: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["fit", str(place / "data"), "--model", str(place / "Lag.fmu"), "--free", "K,T", "--set", "g=1"]
    assert main([*words, "--output", str(tmp_path / "out")]) == 0
    file = tmp_path / "out" / "parameters.toml"
    fitted = tomllib.loads(file.read_text())
    words = ["Lag", "--library", str(place / "Lag.mo"), "-o", str(tmp_path / "Mine.fmu"), "--parameters", str(file)]
    assert build_command([*words, "--set", "T=0.5"]) == 0
    model = read_model(tmp_path / "Mine.fmu")
    assert (model["K"].start, model["T"].start, model["g"].start) == (fitted["K"], 0.5, 1.0)
    file.write_text("[K]\nvalue = true\n")
    capsys.readouterr()
    assert build_command(words) == 2
    assert "K.value = True is no number; write NAME = VALUE" in capsys.readouterr().err
    assert build_command([*words[:-1], str(tmp_path / "none.toml")]) == 2
    assert "none.toml: cannot be read (No such file or directory)" in capsys.readouterr().err
