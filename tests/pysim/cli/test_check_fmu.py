"""`pysim check-fmu`: exit codes, and what it leaves behind."""

import json
import zipfile
from pathlib import Path

import pytest

from pysim.cli import main
from tests.planted import planted


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("planted")


def test_what_is_doubtful_fails_only_where_it_is_to(place: Path, tmp_path: Path) -> None:
    fmu, out, numbers = planted("IDLE_GAIN", place), tmp_path / "out", tmp_path / "numbers.json"
    assert main(["check-fmu", str(fmu), "--output", str(out), "--json", str(numbers)]) == 0
    (found,) = json.loads(numbers.read_text())
    assert found["model"] == "Mass"
    assert [path.name for path in out.iterdir()] == ["report.html"]
    assert main(["check-fmu", str(fmu), "--strict"]) == 1


def test_what_fails_is_exit_1(place: Path) -> None:
    assert main(["check-fmu", str(planted("OTHER_START", place))]) == 1


def test_what_cannot_be_checked_is_exit_2(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    foreign = place / "amiga.fmu"
    with zipfile.ZipFile(planted("IDLE_GAIN", place)) as archive, zipfile.ZipFile(foreign, "w") as other:
        other.writestr("modelDescription.xml", archive.read("modelDescription.xml"))
        other.writestr("binaries/amiga/planted.library", "")
    for words, named in (([], "FILE.fmu"), (["none.fmu"], "none.fmu"), ([str(foreign)], "no binary for")):
        assert main(["check-fmu", *words]) == 2
        assert named in capsys.readouterr().err
