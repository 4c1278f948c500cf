"""What has been found so far, read from the project's folder: the same numbers that the command line writes."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from pysim.app.jobs import ANSWER, DONE, RECORDS, Job, Work, read_job
from pysim.app.project import Project
from pysim.io import StageFile, read_stages
from pysim.types import BadInput

STEPS = ("prior", "refit")
_KEYS = ("verdict", "reason", "added", "ranking", "confusable", "error", "missing", "next_test", "notes", "files")


@dataclass(frozen=True)
class Answer:
    """One finished piece of work.

    Args:
        job: that made it.
        folder: where its files are.
        data: what `--json` wrote.
        stages: every record beside every model.
    """

    job: Job
    folder: Path
    data: Mapping[str, Any]
    stages: StageFile

    @property
    def added(self) -> tuple[str, ...]:
        """Effects that its last model has."""
        return tuple(one["effect"] for one in self.data["added"])

    @property
    def asked(self) -> tuple[str, ...]:
        """Effects of the model that it asks about."""
        return self.added if self.job.work.kind == "diagnose" else self.job.work.effects

    def stage(self, step: str) -> Mapping[str, Any] | None:
        """The model at a step, beside every record."""
        return next((stage for stage in self.stages.about if stage["step"] == step), None)

    @property
    def base(self) -> Mapping[str, Any]:
        """The refitted model, or as it is where nothing was refitted."""
        return self.stage("refit") or self.stages.about[0]

    @property
    def last(self) -> Mapping[str, Any]:
        """The model with all that was added; the law of Locate was not."""
        return self.base if self.job.work.kind == "locate" else self.stages.about[-1]


@lru_cache(maxsize=32)
def _read(folder: Path, _modified: int) -> tuple[Mapping[str, Any], StageFile]:
    data = json.loads((folder / ANSWER).read_text(encoding="utf-8"))
    missing = [key for key in _KEYS if key not in data]
    if missing:
        raise BadInput(f"{folder / ANSWER} has no {', '.join(missing)}; run it again")
    return data, read_stages(folder / RECORDS)


@dataclass(frozen=True)
class Answers:
    """All finished results of a project as it is now, the newest first.

    Args:
        unreadable: work that was done, as by an earlier version, and whose result cannot be read.
    """

    all: tuple[Answer, ...]
    unreadable: tuple[Work, ...] = ()

    @classmethod
    def of(cls, project: Project) -> Answers:
        """Read from its folder."""
        now, deleted = project.fingerprint(), project.settings().deleted
        found, unreadable = [], []
        for folder in sorted((project.folder / "results").glob("*")):
            job = None if folder.name in deleted else read_job(folder)
            if job is None or job.state != DONE or job.fingerprint != now:
                continue
            try:
                found.append(Answer(job, folder, *_read(folder, (folder / ANSWER).stat().st_mtime_ns)))
            except (OSError, ValueError, TypeError, BadInput):
                unreadable.append(job.work)
        return cls(tuple(sorted(found, key=lambda answer: -(answer.job.ended or 0.0))), tuple(unreadable))

    def with_effects(self, added: tuple[str, ...]) -> Answer | None:
        """The result whose model has just these effects; without any, whatever has the refitted model."""
        if added:
            return self.branches.get(added)
        exact = [one for one in self.all if not one.added and one.stages.about]
        exact.sort(key=lambda one: one.job.work.kind != "diagnose")  # it may have added a law that it learned
        return next(iter(exact), next((one for one in self.all if one.stage("refit")), None))

    @property
    def branches(self) -> dict[tuple[str, ...], Answer]:
        """Effects of a model -> the newest result that ends with it; those of fewer effects first."""
        whole = (one for one in reversed(self.all) if one.stages.about and one.job.work.kind != "locate")
        own = {one.added: one for one in whole if one.added}
        return dict(sorted(own.items(), key=lambda item: (len(item[0]), item[0])))

    def newest(self, key: str, asked: tuple[str, ...] = ()) -> Answer | None:
        """The newest result that has something under a key of its data, such as "ranking"; one of the model with some
        effects where there is one."""
        found = [one for one in self.all if one.data[key]]
        return next((one for one in found if one.asked == asked), next(iter(found), None))

    @property
    def verdict(self) -> Answer | None:
        """The whole diagnosis, where it was run."""
        return next((one for one in self.all if one.job.work.name == "diagnose"), None)


def history(answer: Answer, added: tuple[str, ...]) -> list[Mapping[str, Any]]:
    """Steps of the error up to what is in the model now: effects, and a law that was learned and added with them."""
    shown = {*STEPS, *added} | ({answer.last["step"]} if added == answer.added else set())
    return [step for step in answer.data["error"] if step["step"] in shown]


def current(answer: Answer, added: tuple[str, ...]) -> Mapping[str, Any]:
    """The model as it is now, beside every record."""
    return answer.stage(history(answer, added)[-1]["step"]) or answer.base
