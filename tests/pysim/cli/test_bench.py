"""`pysim bench`: a data set with its truth beside it, never inside."""

import json
from pathlib import Path

import pytest

from pysim.cli import main
from pysim.io import read_dataset
from tests.pysim.bench.plans import PLAN
from tests.pysim.cli.ran import refused
from tests.pysim.simulate.fixture_fmus import OSCILLATOR, build


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> str:
    return str(build(OSCILLATOR, 2, tmp_path_factory.mktemp("fmu")))


@pytest.fixture
def words(fmu: str, tmp_path: Path) -> list[str]:
    (tmp_path / "plan.toml").write_text(PLAN, encoding="utf-8")
    return ["bench", fmu, "--plan", str(tmp_path / "plan.toml"), "--set", "D=0.2", "--seed", "6"]


def test_writes_data_set_truth_and_clean_signals(words: list[str], tmp_path: Path) -> None:
    folder, truth, clean = tmp_path / "new" / "set", tmp_path / "truth.json", tmp_path / "clean"
    told = ["--truth", str(truth), "--clean", str(clean), "--effect", "friction.viscous", "--strength", "D=0.2"]
    assert main([*words, "-o", str(folder), *told]) == 0
    data, true = read_dataset(folder), read_dataset(clean)
    assert len(data.records) == len(true.records) == 9
    for measured, exact in zip(data.records[1:5], true.records[1:5], strict=True):
        error = measured.data["position"] - exact.data["position"]
        assert error.std() == pytest.approx(2e-3, rel=0.2)
    about = json.loads(truth.read_text())
    assert (about["effect"], about["strength"], about["seed"]) == ("friction.viscous", {"D": 0.2}, 6)
    assert about["parameters"].items() >= {"w": 2.0, "D": 0.2}.items()
    assert about["noise"]["position"] == pytest.approx(2e-3)
    names = {path.name for path in folder.rglob("*") if path.is_file()}
    assert "truth" not in " ".join(names)


def test_the_same_seed_gives_the_same_bytes(words: list[str], tmp_path: Path) -> None:
    folders = [tmp_path / "a", tmp_path / "b"]
    for folder in folders:
        assert main([*words, "--output", str(folder)]) == 0
    files = [path.relative_to(folders[0]) for path in folders[0].rglob("*") if path.is_file()]
    assert len(files) == 10
    assert all((folders[0] / path).read_bytes() == (folders[1] / path).read_bytes() for path in files)


@pytest.mark.parametrize(
    ("more", "named"),
    [
        (["--truth", "{set}/truth.json"], ["--truth", "inside the data set", "choose a place outside"]),
        (["--truth", "{set}/../set/sub/truth.json"], ["--truth", "inside the data set", "choose a place outside"]),
        (["--clean", "{set}/clean"], ["--clean", "inside the data set", "choose a place outside"]),
        (["--truth", "{set}2/t.json", "--clean", "{set}2"], ["--truth", "inside the folder of --clean", "beside it"]),
        (["--clean", "{set}/.."], ["--clean", "choose a folder beside it"]),
        (["--truth", "{set}.txt"], ["--truth", "write one of .json"]),
        (["--strength", "F"], ["--strength F", "write NAME=VALUE"]),
        (["--strength", "F=nan"], ["--strength F=nan", "a finite number in SI units"]),
        (["--strength", "=3"], ["--strength =3", "write NAME=VALUE"]),
        (["--set", "E=1"], ["has no variable 'E'"]),
        (["--plan", "none"], ["bench-01, thesis", "cannot read none"]),
    ],
)
def test_wrong_use_writes_nothing(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], more: list[str], named: list[str]
) -> None:
    folder = tmp_path / "set"
    refused([*words, "-o", str(folder), *(word.format(set=folder) for word in more)], capsys, *named)
    assert [path.name for path in tmp_path.iterdir()] == ["plan.toml"]


def test_what_is_refused_later_leaves_no_empty_folder(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    places = {"-o": "a/b/set", "--clean": "c/d/clean", "--truth": "e/truth.json"}
    told = [word for option, place in places.items() for word in (option, str(tmp_path / place))]
    refused([*words[:-1], "-6", *told], capsys, "the seed is -6")
    assert [path.name for path in tmp_path.iterdir()] == ["plan.toml"]


def test_a_place_that_cannot_be_written_or_holds_something_is_refused_before_the_first_run(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    below = tmp_path / "plan.toml" / "set"
    refused([*words, "-o", str(below)], capsys, f"--output {below.parent}", "choose another")
    refused([*words, "-o", str(tmp_path)], capsys, f"--output {tmp_path}", "choose a new folder")


def test_a_run_that_stops_is_a_no(words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*words, "--set", "w=1e200", "-o", str(tmp_path / "set")]) == 1
    assert "stopped early" in capsys.readouterr().err
    assert not (tmp_path / "set").exists()
