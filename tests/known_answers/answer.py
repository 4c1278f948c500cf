"""What the product answers to a case, through its front door: `pysim diagnose DATASET --model MODEL --json FILE`."""

from __future__ import annotations

import contextlib
import io
import json
import math
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pysim.cli import main
from tests.known_answers.case import Case
from tests.known_answers.contract import broken


@dataclass(frozen=True)
class Answer:
    """A diagnosis, read from its JSON.

    Args:
        data: the whole of it.
        cpu: s that it took.
        broken: what of it is not as the contract has it.
        before, after: error over noise on logs that are in no data set, of the model as designed and of the one found.
    """

    data: Mapping[str, Any]
    cpu: float
    broken: tuple[str, ...]
    before: float
    after: float

    @property
    def effects(self) -> list[str]:
        """That were added, in order."""
        return [one["effect"] for one in self.data["added"]]

    @property
    def estimates(self) -> dict[str, tuple[float, float, float]]:
        """Value and ends of the interval of every number, by the names of `Case.truth`; nan where there is none."""
        own = {f"{one['place']}.{name}" for one in self.data["added"] for name in one["parameters"]}
        rows = [(name, one["value"], one["interval"]) for name, one in self.data["parameters"].items()]
        rows = [row for row in rows if row[0] not in own]
        for one in self.data["added"]:
            rows += [(f"{one['effect']}.{name}", v, one["intervals"][name]) for name, v in one["parameters"].items()]
        return {name: (_number(value), _number(low), _number(high)) for name, value, (low, high) in rows}

    def share(self, effect: str) -> float | None:
        """Of the avoidable misfit that the effect takes in the base model; None where it was not ranked."""
        rows = [row for row in self.data["ranking"] if row["effect"] == effect]
        return min(rows, key=lambda row: row.get("round", 1))["explained"] if rows else None


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def diagnosed(folder: Path, case: Case) -> dict[str, Any]:
    """Run the command and read what it wrote."""
    answer = folder / "answer.json"
    words = [str(folder / "data"), "--model", case.plant.model, "--library", str(case.plant.library)]
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        status = main(["diagnose", *words, "--json", str(answer)])
    assert status == 0, said.getvalue()
    found: dict[str, Any] = json.loads(answer.read_text(encoding="utf-8"))
    return found


def ask(case: Case) -> Answer:
    """Log the plant, diagnose the logs, and try the model that was found on others; once for each case."""
    if case.name not in _ASKED:
        _ASKED[case.name] = _asked(case)
    return _ASKED[case.name]


_ASKED: dict[str, Answer] = {}


def _asked(case: Case) -> Answer:
    with tempfile.TemporaryDirectory(prefix="known-answer-") as text:
        folder = Path(text)
        case.write(folder / "data")
        begun = time.process_time()
        data = diagnosed(folder, case)
        cpu, wrong = time.process_time() - begun, tuple(broken(data, folder))
    effects = {one["effect"]: one["parameters"] for one in data["added"]}
    own = {name: one["value"] for name, one in data["parameters"].items() if name in case.plant.design}
    return Answer(data, cpu, wrong, case.unseen({}, {}), case.unseen(own, effects))
