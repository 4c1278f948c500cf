"""Files that another program has open, as Windows guards them: they can be read, but neither moved nor removed."""

import os
from collections.abc import Iterable
from pathlib import Path

import pytest


def in_use(monkeypatch: pytest.MonkeyPatch, *paths: Path) -> None:
    """From now on neither these can be moved or removed nor a folder that holds one of them."""

    def guarded(act: str, path: Path | str) -> None:
        if any(one == Path(path) or (act != "unlink" and one.is_relative_to(path)) for one in paths):
            raise PermissionError(13, "Access is denied", str(path))

    for act in ("rename", "replace", "unlink", "rmdir"):
        real = getattr(os, act)
        monkeypatch.setattr(
            os, act, lambda path, *more, _a=act, _r=real, **k: (guarded(_a, path), _r(path, *more, **k))
        )


def content(folder: Path) -> dict[str, bytes]:
    """Every file below it."""
    found: Iterable[Path] = folder.rglob("*")
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found if path.is_file()}
