"""What a model says of itself: built or opened in a process of its own."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from pysim.app.processes import end, last_words, run_pysim
from pysim.app.project import Project

_LIMIT = 1200.0  # s: the 900 that fmu_build.pack.compiler grants the first compilation, and more than any model takes
_NAP = 0.1  # s
_LATE = (
    "the model was not ready within {limit:g} s; the first one on a machine takes some minutes on Windows, and what is "
    "compiled is kept: use it again, and if that takes as long, try it in a terminal with pysim model"
)


@dataclass(frozen=True)
class Built:
    """A model, or why there is none.

    Args:
        model: what `pysim model` wrote of it; None where it cannot be used.
        sketches: of the laws of the effects that fit.
        trouble: why there is no model.
    """

    model: Mapping[str, Any] | None = None
    sketches: Mapping[str, Mapping[str, Any] | None] = field(default_factory=dict)
    trouble: str = ""


async def build_model(project: Project, wanted: Callable[[], bool], *, limit: float = _LIMIT) -> Built:
    """Build or open the project's model; each build has files of its own, so that two of them cannot meet.

    Args:
        wanted: asked again and again; where it says no, the build is ended and there is no model.
        limit: s after which it is ended too.
    """
    settings = project.settings()
    more = [word for library in settings.libraries for word in ("--library", library)]
    with TemporaryDirectory(prefix="pysim-model-", ignore_cleanup_errors=True) as name:
        path, log = Path(name) / "model.json", Path(name) / "model.txt"
        with log.open("wb") as output:
            process = run_pysim(["model", settings.model, *more, "--json", str(path)], project.folder, output)
        begun = time.monotonic()
        try:
            while process.poll() is None and wanted() and time.monotonic() - begun < limit:
                await asyncio.sleep(_NAP)
            late = process.poll() is None
        finally:  # also where nobody waits for it any more
            end(process, hard=True)
            process.wait()
        if late:
            return Built(trouble=_LATE.format(limit=limit))
        if not path.is_file():
            return Built(trouble=last_words(log))
        model = json.loads(path.read_text(encoding="utf-8"))
    return Built(model, {str(one["name"]): one["sketch"] for one in model["effects"]})
