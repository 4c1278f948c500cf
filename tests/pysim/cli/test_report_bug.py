"""What a report of a fault says, and what it must not say."""

import os
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

from fmu_build.version import version
from pysim.cli import main
from pysim.cli.commands import report_bug

SECRET = "j-doe-of-acme"


def test_it_holds_versions_and_system(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report-bug"]) == 0
    said = capsys.readouterr()
    assert said.out.startswith(f"pysim {version()}, from a clone\n")
    assert f"Python: CPython {sys.version.split()[0]}, 64 bit" in said.out
    assert f"numpy {metadata.version('numpy')}" in said.out
    assert "What I expected:" in said.out
    assert "Nothing was sent." in said.err


def test_no_name_of_a_person_a_computer_or_a_folder_is_in_it(tmp_path: Path) -> None:
    home = tmp_path / SECRET
    home.mkdir()
    private = dict.fromkeys(("USER", "USERNAME", "LOGNAME", "HOSTNAME", "COMPUTERNAME"), SECRET)
    private |= {name: str(home) for name in ("HOME", "USERPROFILE", "MODELICAPATH", "HTB_CACHE", "XDG_CACHE_HOME")}
    words = [sys.executable, "-m", "pysim", "report-bug"]
    root = str(Path(__file__).parents[3])
    done = subprocess.run(
        words, cwd=home, env={**os.environ, "PYTHONPATH": root, **private}, capture_output=True, text=True, check=True
    )
    said = done.stdout + done.stderr
    assert "set in the environment: HTB_CACHE, MODELICAPATH" in said
    for unwanted in (SECRET, root, str(Path.home()), os.sep + "site-packages"):
        assert unwanted not in said


def test_packages_are_those_of_every_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    needs = ["numpy>=2.0", "Foo.bar-baz>=1; extra == 'app'", "hydraulic-test-bench[app]; extra == 'all'"]
    monkeypatch.setattr(metadata, "requires", lambda name: needs)
    there, missing = report_bug.packages()
    assert f"numpy {metadata.version('numpy')}" in there
    assert missing == "not installed: foo.bar-baz"


def test_without_metadata_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> list[str]:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "requires", absent)
    assert list(report_bug.packages()) == ["packages: not known, since this program is not installed"]


@pytest.mark.skipif(os.name == "nt", reason="rights of folders as POSIX systems have them")
def test_a_cache_that_cannot_be_used_is_no_reason_to_fail_or_to_name_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    cache = tmp_path / SECRET
    cache.mkdir()
    cache.chmod(0o777)
    monkeypatch.setenv("HTB_CACHE", str(cache))
    assert main(["report-bug"]) == 0
    said = capsys.readouterr()
    assert "solver: cannot be kept" in said.out
    assert SECRET not in said.out + said.err
