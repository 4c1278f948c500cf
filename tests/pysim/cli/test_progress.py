from pathlib import Path

import pytest

from pysim.cli._progress import ProgressBar, announce_compilation
from pysim.simulate import is_compiled
from pysim.simulate.native import compiled


def test_compilation_is_announced_where_there_is_no_machine_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(compiled, "cache_folder", lambda purpose: tmp_path / purpose)
    announce_compilation()
    assert "once on this machine" in capsys.readouterr().err
    folder = tmp_path / "native" / compiled._source_key() / "loop"  # where Numba keeps an index per function
    folder.mkdir(parents=True)
    (folder / "integrate.nbi").touch()
    assert is_compiled()
    announce_compilation()
    assert capsys.readouterr().err == ""


def test_bar_leaves_its_last_state_where_there_is_no_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with ProgressBar("runs") as progress:
        for done in range(4):
            progress(done, 3)
    error = capsys.readouterr().err
    assert error.startswith("runs             [##############################] 3/3")
    assert error.count("\n") == 1
