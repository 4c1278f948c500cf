"""`pysim check-fmu`: exit codes, and what it leaves behind."""

import json
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from pysim import fmu_check
from pysim.cli import main
from pysim.fmu_check import DOUBTFUL, FAILS, HOLDS, check_fmu
from pysim.present.report import MARKER
from tests.planted import planted
from tests.pysim.cli.ran import refused


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One whose parameter g does nothing, which is doubtful."""
    return planted("IDLE_GAIN", tmp_path_factory.mktemp("planted"))


def test_what_is_found_is_written(fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def some(path: Path, **options: Any) -> fmu_check.FmuReport:
        return check_fmu(path, ("description", "parameters"), **options)

    monkeypatch.setattr(fmu_check, "check_fmu", some)
    out, numbers = tmp_path / "out", tmp_path / "numbers.json"
    assert main(["check-fmu", str(fmu), "--output", str(out), "--json", str(numbers)]) == 0
    (found,) = json.loads(numbers.read_text())
    assert found["model"] == "Mass"
    assert {path.name for path in out.iterdir()} == {"report.html", MARKER}
    assert main(["check-fmu", str(fmu), "--strict"]) == 1


@pytest.mark.parametrize(
    ("verdict", "strict", "code"),
    [(HOLDS, True, 0), (DOUBTFUL, False, 0), (DOUBTFUL, True, 1), (FAILS, False, 1), (FAILS, True, 1)],
)
def test_exit_code(fmu: Path, verdict: str, strict: bool, code: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """One of two FMUs is enough."""
    good = fmu_check.FmuReport(fmu, "Mass", "", "2.0", (fmu_check.CheckResult("a", "b", HOLDS),))
    reports = iter([good, replace(good, results=(*good.results, fmu_check.CheckResult("a", "b", verdict)))])
    monkeypatch.setattr(fmu_check, "check_fmu", lambda path, progress: next(reports))
    assert main(["check-fmu", str(fmu), str(fmu), *(["--strict"] if strict else [])]) == code


def test_what_cannot_be_checked_is_exit_2(fmu: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    foreign = tmp_path / "amiga.fmu"
    with zipfile.ZipFile(fmu) as archive, zipfile.ZipFile(foreign, "w") as other:
        other.writestr("modelDescription.xml", archive.read("modelDescription.xml"))
        other.writestr("binaries/amiga/planted.library", "")
    for words, named in (([], "FILE.fmu"), (["none.fmu"], "none.fmu"), ([str(foreign)], "no binary for")):
        refused(["check-fmu", *words], capsys, named)
