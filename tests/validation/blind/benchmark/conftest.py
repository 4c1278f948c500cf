"""A diagnosis that is none, as other processes can import it."""

import importlib
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pytest

NAME = "fake_diagnosis"


@pytest.fixture
def imported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str], ModuleType]]:
    """Makes a module of a text."""

    def module(text: str) -> ModuleType:
        (tmp_path / f"{NAME}.py").write_text(text)
        importlib.invalidate_caches()
        return importlib.import_module(NAME)

    monkeypatch.syspath_prepend(str(tmp_path))
    yield module
    sys.modules.pop(NAME, None)
