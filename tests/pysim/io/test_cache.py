import sys
import tempfile
from pathlib import Path

import pytest

from pysim.io import cache_folder


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="the variable is that of Linux")
def test_users_choice_is_kept(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = cache_folder("purpose")
    assert folder.is_dir()
    assert folder.is_relative_to(tmp_path)
    assert folder.name == "purpose"
    assert list(folder.iterdir()) == []


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="the variable is that of Linux")
def test_home_that_cannot_hold_it_is_replaced(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert cache_folder("purpose").is_relative_to(Path(tempfile.gettempdir()))
