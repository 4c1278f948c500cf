"""`pysim app`: what it refuses before it serves; the page itself is tried in tests/pysim/app."""

import sys
from pathlib import Path

import pytest

from pysim.cli import main


def test_without_its_extra_it_says_what_to_install(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [name for name in sys.modules if name == "pysim.app" or name.startswith("pysim.app.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "nicegui", None)
    assert main(["app", str(tmp_path / "p")]) == 2
    assert 'the workbench needs nicegui; pip install "hydraulic-test-bench[app]", or' in capsys.readouterr().err
    assert not (tmp_path / "p").exists()


@pytest.mark.parametrize("port", ["99999", "-1", "65536"])
def test_a_port_that_there_is_not_is_refused(port: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("nicegui")
    assert main(["app", str(tmp_path / "p"), f"--port={port}"]) == 2
    assert f"--port {port}: write a number from 0 (any that is free) to 65535" in capsys.readouterr().err
    assert not (tmp_path / "p").exists()


def test_a_folder_of_something_else_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("nicegui")
    (tmp_path / "letter.txt").write_text("dear")
    assert main(["app", str(tmp_path), "--no-browser"]) == 2
    assert "holds files but no project.toml" in capsys.readouterr().err
