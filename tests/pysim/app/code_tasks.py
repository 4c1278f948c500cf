"""Tasks of a worker that are a few lines of Python, in place of what the page asks for."""

import json
import time
from pathlib import Path
from typing import Any

from pysim.app.jobs import OUTPUT, Work
from pysim.app.project import Project
from pysim.app.worker import said_in
from pysim.types import BadInput

CODE = "tests.pysim.app.code_tasks:Code"
TOLD: dict[str, Any] = {"structure": None, "parameters": [], "slots": [], "effects": []}


class Code:
    """Work is its last word; a model is what its name says."""

    def __init__(self, folder: Path) -> None:
        self._project, self.kept = Project(folder), 0

    def step(self, work: Work) -> None:
        """Run its code in the folder of the project."""
        with said_in(self._project.results(work.name) / OUTPUT):
            exec(work.words[-1], {"BadInput": BadInput})

    def model(self) -> dict[str, Any]:
        """Of that name, at once or after a while."""
        name = self._project.settings().model
        if name == "Bad":
            raise BadInput("no such class; name another")
        if name == "Slow":
            time.sleep(60)
        return {"name": name, **TOLD}

    def count(self) -> int:
        """How often it was asked."""
        self.kept += 1
        return self.kept

    def run(self, code: str) -> Any:
        """What an expression is."""
        exec(code, space := {"BadInput": BadInput, "json": json})
        return space.get("value")


class Idle:
    """Work that does nothing: what a job finds is written by the test."""

    def __init__(self, _: Path) -> None: ...

    def step(self, _: Work) -> None:
        """Wait to be ended."""
        time.sleep(600)
