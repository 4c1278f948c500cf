"""The line that starts a program of ours."""

import shlex
import sys
from pathlib import Path

import pytest

import pysim
from pysim.workflow import command_line


def test_the_line_to_redo_is_quoted_and_starts_where_it_works(monkeypatch: pytest.MonkeyPatch) -> None:
    root = Path(pysim.__file__).parents[1]
    monkeypatch.setattr(sys, "prefix", "/usr")
    assert command_line(["demo", "--output", "my results"]) == "pysim demo --output 'my results'"
    assert command_line(["A.B"], program="fmu-build") == "fmu-build A.B"
    monkeypatch.setattr(sys, "prefix", str(root / ".venv"))
    monkeypatch.chdir(root)
    assert command_line(["demo"]) == "python3 run.py pysim demo"
    assert command_line(["A.B"], program="fmu-build") == "python3 run.py fmu-build A.B"
    monkeypatch.chdir(root / "tests")
    assert shlex.split(command_line(["demo"])) == ["python3", str(root / "run.py"), "pysim", "demo"]
    assert command_line(["demo"], root) == "python3 run.py pysim demo"  # typed there, wherever this process is
    monkeypatch.chdir(root)
    assert shlex.split(command_line(["demo"], root / "tests"))[1] == str(root / "run.py")


def test_the_line_to_redo_is_quoted_as_windows_wants_it(monkeypatch: pytest.MonkeyPatch) -> None:
    root = Path(pysim.__file__).parents[1]
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr(sys, "prefix", "/usr")
    assert command_line(["demo", "--output", "my results"]) == 'pysim demo --output "my results"'
    monkeypatch.setattr(sys, "prefix", str(root / ".venv"))
    monkeypatch.chdir(root)
    assert command_line(["demo"]) == "py run.py pysim demo"
