"""`pysim validate`: what is run, printed, written and kept."""

from pathlib import Path

import pytest

from pysim.cli import main
from pysim.cli.commands import validate
from tests.validation import made_up
from validation.results import read_results


@pytest.fixture(autouse=True)
def _cases(monkeypatch: pytest.MonkeyPatch) -> None:
    made_up.use(monkeypatch)


@pytest.mark.parametrize(
    ("words", "code"),
    [(["good"], 0), (["bad"], 1), (["nan"], 1), (["broken"], 1), (["bad", "good"], 1), ([], 1), (["--quick"], 0)],
)
def test_exit_code(words: list[str], code: int) -> None:
    assert main(["validate", *words]) == code


@pytest.mark.parametrize("words", [[], ["--list"], ["good", "--record"]])
def test_an_installed_package_says_that_a_clone_is_needed(
    words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(validate, "find_spec", lambda name: None)
    assert main(["validate", *words]) == 2
    said = capsys.readouterr()
    assert (said.out, said.err.count("\n")) == ("", 1)
    assert "are not installed with the package; clone the project and type `python3 run.py validate`" in said.err


@pytest.mark.parametrize("words", [["none"], ["--nonsense"]])
def test_wrong_use(words: list[str]) -> None:
    assert main(["validate", *words]) == 2


def test_list_runs_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["validate", "--list"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == list(made_up.CASES)


def test_what_is_written(tmp_path: Path) -> None:
    out, numbers = tmp_path / "out", tmp_path / "numbers.jsonl"
    numbers.write_text("old\n")
    assert main(["validate", "good", "bad", "--output", str(out), "--json", str(numbers)]) == 1
    assert [result.case for result in read_results(numbers)] == ["good", "bad"]
    assert {path.name for path in out.iterdir()} == {
        "report.html", "summary.md", "good-1.png", "bad-1.png",
    }  # fmt: skip
    assert "a picture" in (out / "report.html").read_text(encoding="utf-8")


@pytest.mark.skipif(not Path("/dev/null").is_char_device(), reason="a device of POSIX systems")
def test_a_device_is_written_to_and_stays(tmp_path: Path) -> None:
    device = tmp_path / "numbers.json"
    device.symlink_to("/dev/null")
    assert main(["validate", "good", "--json", str(device)]) == 0
    assert device.is_char_device()


def test_record(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "validation").mkdir()
    monkeypatch.setattr(validate, "_CLONE", tmp_path)
    for module in ("fmu_build.version", "validation.suite"):
        monkeypatch.setattr(f"{module}.this_commit", lambda: "0123456789ab")
    for _ in range(2):
        assert main(["validate", "good", "--record"]) == 0
    assert len(read_results(tmp_path / "validation" / "recorded.jsonl")) == 1
    written = (tmp_path / "validation" / "RESULTS.md").read_text(encoding="utf-8")
    assert "| 1 of 4 | 1 | 0 | 1 |  |" in written
    assert "| [good](good/README.md) | about good | 1 | 0 | 1 |  |" in written


def test_a_run_of_all_cases_goes_on_where_it_was_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "validation").mkdir()
    monkeypatch.setattr(validate, "_CLONE", tmp_path)
    commit = ["0123456789ab"]
    for module in ("fmu_build.version", "validation.suite"):
        monkeypatch.setattr(f"{module}.this_commit", lambda: commit[0])
    out = tmp_path / "runs.json"

    def ran() -> int:
        main(["validate", "--quick", "--record", "--json", str(out)])
        return len(read_results(out))

    assert main(["validate", "good", "--record"]) == 0
    first = ran()
    assert ran() == 0
    commit[0] = "ba9876543210"
    assert ran() == first + 1


@pytest.mark.parametrize("commit", ["", "0123456789ab-dirty"])
def test_nothing_is_recorded_that_no_commit_stands_for(
    commit: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(validate, "_CLONE", tmp_path)
    monkeypatch.setattr("fmu_build.version.this_commit", lambda: commit)
    assert main(["validate", "good", "--record"]) == 2
    assert "commit first, then record" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
