"""`pysim bench`: a data set with its truth beside it, never inside."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.io import read_dataset
from tests.pysim.bench.plans import PLAN
from tests.pysim.simulate.fixture_fmus import OSCILLATOR, build


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> str:
    return str(build(OSCILLATOR, 2, tmp_path_factory.mktemp("fmu")))


@pytest.fixture
def words(fmu: str, tmp_path: Path) -> list[str]:
    (tmp_path / "plan.toml").write_text(PLAN, encoding="utf-8")
    return ["bench", fmu, "--plan", str(tmp_path / "plan.toml"), "--set", "D=0.2", "--seed", "6"]


def test_writes_data_set_truth_and_clean_signals(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder, truth, clean = tmp_path / "new" / "set", tmp_path / "truth.json", tmp_path / "clean"
    told = ["--truth", str(truth), "--clean", str(clean), "--effect", "friction.viscous", "--strength", "D=0.2"]
    assert main([*words, "-o", str(folder), *told]) == 0
    data, true = read_dataset(folder), read_dataset(clean)
    assert len(data.records) == len(true.records) == 9
    assert capsys.readouterr().out.startswith("oscillator: 9 logs, ")
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
    ("more", "message"),
    [
        (["--truth", "{set}/truth.json"], "--truth .*inside the data set"),
        (["--truth", "{set}/../set/sub/truth.json"], "--truth .*inside the data set"),
        (["--clean", "{set}/clean"], "--clean .*inside the data set"),
        (["--truth", "{set}2/t.json", "--clean", "{set}2"], "--truth .*inside the folder of --clean"),
        (["--clean", "{set}/.."], "--clean .*the data set would be inside it"),
        (["--truth", "{set}.txt"], "the suffix chooses the form"),
        (["--strength", "F"], "--strength F: write NAME=VALUE"),
        (["--strength", "F=nan"], "--strength F=nan: write NAME=VALUE with a finite number in SI units"),
        (["--strength", "=3"], "--strength =3: write NAME=VALUE"),
        (["--set", "E=1"], "has no variable 'E'"),
        (["--plan", "none"], "one of bench-01, thesis.*cannot read none"),
    ],
)
def test_wrong_use_writes_nothing(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], more: list[str], message: str
) -> None:
    folder = tmp_path / "set"
    assert main([*words, "-o", str(folder), *(word.format(set=folder) for word in more)]) == 2
    assert np.all([path.name in ("plan.toml",) for path in tmp_path.iterdir()])
    assert re.search(message, capsys.readouterr().err)


def test_a_place_that_cannot_be_written_is_refused_before_the_first_run(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "plan.toml" / "set"
    assert main([*words, "-o", str(folder)]) == 2
    told = capsys.readouterr()
    assert f"--output {folder.parent}: cannot write there" in told.err
    assert "tests" not in told.out + told.err


def test_an_old_folder_is_not_mixed_with_new_logs(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*words, "-o", str(tmp_path)]) == 2
    assert "something is there already; choose a new folder" in capsys.readouterr().err


def test_a_run_that_stops_is_a_no(words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*words, "--set", "w=1e200", "-o", str(tmp_path / "set")]) == 1
    assert "stopped early" in capsys.readouterr().err
    assert not (tmp_path / "set").exists()
