"""What the diagnosis answers to each machine: asked through the command, kept by the commit that answered."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fmu_build.version import this_commit
from pysim.io import write_dataset, write_file
from validation.known_answers.machines import MACHINES

TODAY = Path(__file__).parent / "today.json"
_ROOT = Path(__file__).parents[2]


def answer(name: str) -> Mapping[str, Any]:
    """The answer of this code, `cpu` s with it: from the last run where that has come so far, so that one goes on.

    Raises:
        RuntimeError: the diagnosis ended without a verdict.
    """
    found = kept(name)
    if found is None:
        found, path = _asked(name), _path(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        write_file(path, json.dumps(found, indent=1) + "\n")
    return found


def kept(name: str) -> Mapping[str, Any] | None:
    """The answer that this code has given, None where it has given none yet."""
    path = _path(name)
    found: dict[str, Any] | None = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None
    return found


def _path(name: str) -> Path:
    return _ROOT / "results" / "known-answers" / this_commit() / f"{name}.json"


def _asked(name: str) -> dict[str, Any]:
    """What the command answers that a user types, in a process of its own."""
    machine = MACHINES[name]
    with tempfile.TemporaryDirectory(prefix="known-answers-") as text:
        folder, before = Path(text), _children()
        write_dataset(folder / "data", machine.dataset())
        words = ["diagnose", str(folder / "data"), "--model", machine.model, "--json", str(folder / "answer.json")]
        done = subprocess.run([sys.executable, "-m", "pysim", *words], cwd=_ROOT, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{name}: {done.stderr.splitlines()[-1]}")
        found: dict[str, Any] = json.loads((folder / "answer.json").read_text(encoding="utf-8"))
    return {**found, "cpu": _children() - before}


def _children() -> float:
    """Processor time of the processes that have ended, s."""
    times = os.times()
    return times.children_user + times.children_system
