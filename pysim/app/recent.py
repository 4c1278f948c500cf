"""Projects that were opened lately on this machine, the last one first."""

from __future__ import annotations

import contextlib
import json
from pathlib import Path

from pysim.io import cache_folder, write_file
from pysim.types import BadInput

_MOST = 8  # projects


def recent() -> list[Path]:
    """Those that are still there."""
    with contextlib.suppress(OSError, ValueError, TypeError, BadInput):
        found = [Path(one) for one in json.loads(_file().read_text(encoding="utf-8"))]
        return [folder for folder in found if (folder / "project.toml").is_file()]
    return []


def remember(folder: Path) -> None:
    """Put a project first; a list that cannot be written is none."""
    others = [str(one) for one in recent() if one != folder]
    with contextlib.suppress(OSError, BadInput):
        write_file(_file(), json.dumps([str(folder), *others][:_MOST]))


def _file() -> Path:
    return cache_folder("workbench") / "recent.json"
