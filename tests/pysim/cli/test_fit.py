"""`pysim fit`: what it finds, writes and refuses."""

import json
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_build.cli import main as build_command
from pysim.cli import main
from pysim.identify.greybox import Profile, Tried
from pysim.io import read_model, write_dataset
from pysim.present.progress import Searching
from pysim.present.report import MARKER
from pysim.types import FrequencyResponse
from tests.pysim.cli.ran import Ran, ran, refused
from tests.pysim.identify.greybox import measurements as m


@pytest.fixture
def base(lag: Path) -> list[str]:
    """The command line, but for what is free."""
    return ["fit", str(lag / "data"), "--model", str(lag / "Lag.fmu")]


def test_a_fit_writes_numbers_parameters_report_and_log(fitted: Ran) -> None:
    assert fitted.code == 0
    assert fitted.answer["estimates"]["K"]["value"] == pytest.approx(2.0, rel=0.02)
    assert tomllib.loads((fitted.output / "parameters.toml").read_text()) == pytest.approx(fitted.answer["values"])
    assert (fitted.output / "report.html").read_text().count("<img") == 4
    lines = (fitted.output / "log" / "given" / "iterations.jsonl").read_text().splitlines()
    assert json.loads(lines[-1])["outcome"] == "converged"
    assert not list((fitted.output / "log").rglob("state.npz"))  # nothing is left to go on with
    assert (fitted.output / MARKER).is_file()


def test_a_stopped_fit_goes_on_with_the_same_command(
    fitted: Ran, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """To the same numbers, bit for bit, and without a point that was known; another fit is refused meanwhile."""
    out, points = tmp_path / "out", []

    def stop(_: Searching, tried: Tried) -> None:
        points.append((tried.search, tried.tried))
        if len(points) == 2:
            raise KeyboardInterrupt

    monkeypatch.setattr(Searching, "__call__", stop)
    words = [*fitted.words, "--output", str(out)]
    assert main(words) == 2
    assert "the same command goes on" in capsys.readouterr().err
    refused([*words, "--start", "K=1.2"], capsys, str(out / "log"), "delete this folder")
    assert len(points) == 2
    assert main([*words, "--json", str(tmp_path / "resumed.json")]) == 0
    assert len(points) == len(set(points))
    assert json.loads((tmp_path / "resumed.json").read_text())["values"] == fitted.answer["values"]


def test_the_next_fit_takes_the_place_of_the_last_one(base: list[str], tmp_path: Path) -> None:
    own = tmp_path / "mine.toml"
    own.write_text("K = 1.9\nT = 0.7\ng = 1.0\n")
    words = [*base, "--free", "K", "--parameters", str(own), "--output", str(tmp_path / "out")]
    found = []
    for start in ([], ["--start", "K=1.5", "--set", "T=0.6"]):
        assert main([*words, *start, "--json", str(tmp_path / "fit.json")]) == 0
        found.append(json.loads((tmp_path / "fit.json").read_text()))
    assert [one["estimates"]["K"]["start"] for one in found] == [1.9, 1.5]
    assert [one["values"]["T"] for one in found] == [0.7, 0.6]
    assert found[0]["values"]["K"] == pytest.approx(2.0, rel=0.02)
    assert tomllib.loads((tmp_path / "out" / "parameters.toml").read_text()) == pytest.approx(found[1]["values"])


def test_a_table_without_the_thesis_reference_is_fitted_as_it_is(
    lag: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_dataset(tmp_path / "table", m.dataset([m.table(2.0, 0.7, np.array([0.2, 0.5, 1.0]))]))
    words = ["fit", str(tmp_path / "table"), "--model", str(lag / "Lag.fmu"), "--free", "K,T", "--set", "g=1"]
    assert main([*words, "--json", str(tmp_path / "fit.json")]) == 0
    found = json.loads((tmp_path / "fit.json").read_text())["values"]
    assert (found["K"], found["T"]) == pytest.approx((2.0, 0.7), rel=1e-3)
    refused([*words, "--reference-hz", "0.1"], capsys, "0.1 Hz")


def test_a_table_of_an_output_that_is_left_out_says_nothing(
    lag: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without it every table has 0.1 Hz, to which gains are relative then: the gain of 2 is not the model's 1."""
    one, other = (m.table(2.0, T, np.array(at)) for T, at in ((0.7, [0.1, 0.5, 1.0]), (0.3, [0.2, 0.5, 1.0])))
    assert isinstance(other.data, FrequencyResponse)
    of_z = replace(other, source="z.csv", data=replace(other.data, test=replace(other.data.test, output="z")))
    data = m.dataset([one, of_z])
    z = replace(data.signal("y"), name="z", quantity="z", variable="z")
    write_dataset(tmp_path / "tables", replace(data, signals=(*data.signals, z)))
    words = ["fit", str(tmp_path / "tables"), "--model", str(lag / "Lag.fmu"), "--free", "T", "--set", "K=1"]
    found = ran([*words, "--signal", "y"], tmp_path)
    assert found.answer["values"]["T"] == pytest.approx(0.7, rel=1e-3)
    assert [one["output"] for one in found.answer["responses"]] == ["y"]
    refused([*words, "--signal", "x"], capsys, "measures no output 'x'", "y, z")


def test_so_is_one_that_is_refitted_and_compared(lag: Path, tmp_path: Path) -> None:
    write_dataset(tmp_path / "table", m.dataset([m.table(2.0, 0.7, np.arange(1, 13) / 10 + 0.1)]))
    words = ["compare", str(tmp_path / "table"), "--model", str(lag / "Lag.fmu"), "--refit", "--free", "K,T"]
    words += ["--bounds", "K=0.1:10", "--bounds", "T=0.1:10", "--set", "g=1", "--json", str(tmp_path / "refit.json")]
    assert main(words) in (0, 1)
    found = json.loads((tmp_path / "refit.json").read_text())["parameters"]
    assert (found["K"]["value"], found["T"]["value"]) == pytest.approx((2.0, 0.7), rel=1e-2)


def test_each_operating_point_has_a_picture(lag: Path, tmp_path: Path) -> None:
    """Logs of two of them in one folder, and two data sets whose files have the same names."""
    sines = [replace(m.sine_log(2.0, 0.7, f, seed=1), source=f"{f:g}Hz.txt") for f in (0.5, 1.0)]
    other = [replace(sine, source=f"other{sine.source}", amplitude=2 * float(sine.amplitude or 1)) for sine in sines]
    for name in ("one", "two"):
        write_dataset(tmp_path / name, replace(m.dataset([m.ramp_log(2.0, 0.7, seed=2), *sines, *other]), name=name))
    words = ["fit", str(tmp_path / "one"), str(tmp_path / "two"), "--model", str(lag / "Lag.fmu")]
    assert main([*words, "--free", "K,T", "--set", "g=1", "--output", str(tmp_path / "out")]) == 0
    assert len(list((tmp_path / "out").glob("sines_*.png"))) == 4
    assert (tmp_path / "out" / "report.html").read_text().count("<img") == 2 + 2 + 4


def test_intervals_are_written_one_by_one_also_without_an_end(
    fitted: Ran, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked, numbers = [], tmp_path / "fit.json"

    def profile(_: object, __: object, name: str, **___: object) -> Profile:
        asked.append((name, len(json.loads(numbers.read_text())["profiles"])))
        return Profile(name, np.array([[1.0, 2.0], [3.0, np.inf]]), (0.5, np.inf))

    monkeypatch.setattr("pysim.identify.greybox.profile", profile)
    assert main([*fitted.words, "--profile", "K", "--profile", "T", "--json", str(numbers)]) == 0
    found = json.loads(numbers.read_text())["profiles"]
    assert asked == [("K", 0), ("T", 1)]
    assert found["T"] == {"interval": [0.5, None], "points": [[1.0, 2.0], [3.0, None]]}


def test_an_input_that_never_moves_is_refused_by_itself_and_welcome_beside_one_that_does(
    lag: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    time = np.arange(0, 3, 0.02)
    still = m.log(time, np.full(time.size, 25.0), np.full(time.size, 50.0) + 0.02 * np.sin(9 * time))
    write_dataset(tmp_path / "still", m.dataset([still]))
    words = ["--model", str(lag / "Lag.fmu"), "--free", "K", "--set", "g=1"]
    refused(["fit", str(tmp_path / "still"), *words], capsys, "the input w is constant in every record to fit")
    assert main(["fit", str(tmp_path / "still"), str(lag / "data"), *words]) == 0


def test_a_class_is_fitted_as_its_fmu_is(lag: Path, tmp_path: Path) -> None:
    words = ["--free", "K", "--set", "g=1", "--set", "T=0.7", "--json", str(tmp_path / "fit.json")]
    found = []
    for model in (["Lag", "--library", str(lag / "Lag.mo")], [str(lag / "Lag.fmu")]):
        assert main(["fit", str(lag / "data"), "--model", *model, *words]) == 0
        found.append(json.loads((tmp_path / "fit.json").read_text())["values"])
    assert found[0] == found[1]


def test_without_free_the_fit_frees_what_a_diagnosis_does(base: list[str], tmp_path: Path) -> None:
    words = [*base, "--bounds", "K=0.5:4", "--set", "T=0.7", "--set", "g=1", "--json", str(tmp_path / "fit.json")]
    assert main(words) == 0
    found = json.loads((tmp_path / "fit.json").read_text())["estimates"]
    assert list(found) == ["K"]
    assert (found["K"]["lower"], found["K"]["upper"]) == (0.5, 4.0)


def test_what_was_fitted_is_built_into_an_fmu(
    fitted: Ran, lag: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "parameters.toml"
    file.write_text((fitted.output / "parameters.toml").read_text())
    words = ["Lag", "--library", str(lag / "Lag.mo"), "-o", str(tmp_path / "Mine.fmu"), "--parameters", str(file)]
    assert build_command([*words, "--set", "T=0.5"]) == 0
    model = read_model(tmp_path / "Mine.fmu")
    assert [model[name].start for name in "KTg"] == [fitted.answer["values"]["K"], 0.5, 1.0]
    file.write_text("[K]\nvalue = true\n")
    capsys.readouterr()
    for path, said in ((file, "K.value = True is no number"), (tmp_path / "none.toml", "none.toml")):
        assert build_command([*words[:-1], str(path)]) == 2
        assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("more", "named"),
    [
        (["--set", "K=2", "--set", "T=1"], ["--free"]),
        (["--objektive", "time"], ["did you mean --objective?"]),
        (["--free", "K", "--set", "T"], ["--set T", "write NAME=VALUE"]),
        (["--free", "K", "--tie", "g=two*K"], ["--tie g=two*K", "write A=B or A=2.5*B"]),
        (["--free", "K", "--bounds", "K=1"], ["--bounds K=1", "write NAME=LOW:HIGH"]),
        (["--free", "K", "--start", "T=1"], ["T has a start or bounds", "add it to --free"]),
        (["--free", "K,T", "--profile", "K,tau"], ["--profile tau", "choose of K, T"]),
        (["--free", "K", "--profile", "K"], ["--profile K", "needs no profile"]),
        (
            ["--free", "K", "--objective", "time", "--optimiser", "gauss-newton"],
            ["gauss-newton", "choose the"],
        ),
        (["--free", "K", "--parameters", "{here}/nosuch.toml"], ["nosuch"]),
        (["--free", "K", "--parameters", "{here}/p.toml", "--output", "{here}"], ["p.toml is read", "another folder"]),
        (["--free", "K", "--output", "{here}"], ["--output", "choose a new folder"]),
    ],
)
def test_mistakes_are_one_line_before_the_work(
    base: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], more: list[str], named: list[str]
) -> None:
    (tmp_path / "p.toml").write_text("g = 1\n")
    (tmp_path / "nosuch.toml").write_text("nosuch = 1\n")
    refused([*base, *(word.format(here=tmp_path) for word in more)], capsys, *named)
    assert (tmp_path / "p.toml").read_text() == "g = 1\n"
