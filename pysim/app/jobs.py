"""Work that the worker does: followed by what it writes, stopped when the user asks."""

from __future__ import annotations

import contextlib
import hashlib
import json
import time
from collections.abc import Sequence
from concurrent.futures import Future
from dataclasses import asdict, dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any

from pysim.app.disk import remove
from pysim.app.processes import Started, last_words
from pysim.app.project import VALUES, Project
from pysim.app.worker import TASKS, Ended, Worker
from pysim.io import write_file
from pysim.types import BadInput

RUNNING, DONE, STOPPED, FAILED = "running", "done", "stopped", "failed"
_JOB = "job.json"
ANSWER, RECORDS, EVENTS, OUTPUT = "answer.json", "records.npz", "events.jsonl", "output.txt"
CURVES = "curves.json"  # one log beside the best point so far
QUICK = 1.0  # s; drawing a search that takes less would only hold it up
REPORT = "report"  # folder of what can be taken away, and of the checkpoint
_PATIENCE = 3.0  # s between asking a process that somebody else has begun to end, and ending it


@dataclass(frozen=True)
class Work:
    """What is to be run.

    Args:
        name: of the result's folder.
        title: for people.
        words: of the command line that does the same, behind `pysim`.
        effects: that the model has when it is done, as far as that was asked for.
    """

    name: str
    title: str
    words: tuple[str, ...]
    effects: tuple[str, ...] = ()

    @property
    def kind(self) -> str:
        """compare, locate, rank, diagnose or add."""
        return "add" if self.name.startswith("add-") else self.name

    @property
    def libraries(self) -> tuple[str, ...]:
        """That it is run with."""
        return tuple(one for word, one in pairwise(self.words) if word == "--library")


@dataclass(frozen=True)
class Job:
    """Where a piece of work stands.

    Args:
        state: RUNNING, DONE, STOPPED or FAILED.
        begun, ended: s since 1970; ended is None while it runs.
        fingerprint: of what it was run on.
        stage: what it is doing, in a few words.
        trials: points of its search: `names`, `error` and `values`.
        curves: one log beside the best point, as `followed_overlay` takes it; None before there is one.
        message: why it failed.
        process: that does it; None where it has ended.
    """

    work: Work
    state: str
    begun: float
    ended: float | None
    fingerprint: str
    stage: str = ""
    trials: tuple[dict[str, Any], ...] = ()
    curves: dict[str, Any] | None = None
    message: str = ""
    process: Started | None = None

    @property
    def lives(self) -> bool:
        """Whether its process still runs, whoever has started it."""
        return self.process is not None and self.process.lives

    @property
    def best(self) -> dict[str, Any] | None:
        """The best point of the model without anything added; None where none was tried."""
        return min((one for one in self.trials if not one["names"]), key=lambda one: one["error"], default=None)

    @property
    def seconds(self) -> float:
        """That it has taken so far."""
        return (self.ended or time.time()) - self.begun


def works(project: Project) -> dict[str, Work]:
    """What can be run on a project as it is, by its name; `BadInput` where it has no model or no data yet."""
    settings = project.settings()
    if not settings.model:
        raise BadInput("no model yet; name one on the page Data")
    if not project.description.is_file():
        raise BadInput("no data set yet; drop one on the page Data")
    more = [word for library in project.libraries for word in ("--library", library)]
    more += ["--free", ",".join(settings.free)] if settings.free else []
    more += [word for name, (low, high) in settings.ranges.items() for word in ("--bounds", f"{name}={low!r}:{high!r}")]
    more += ["--parameters", VALUES] if project.values() else []
    behind = ["data", "--model", settings.model, *more]
    there = [word for name in settings.added for word in ("--with", name)]
    return {
        "compare": _work("compare", "Compare and refit", [*behind, "--refit"]),
        "locate": replace(_work("locate", "Locate what is missing", [*behind, *there]), effects=settings.added),
        "rank": _work("diagnose", "Rank the candidates", [*behind, "--max-effects", "0"], "rank"),
        "diagnose": _work("diagnose", "Find what is missing", behind),
    }


def adding(project: Project, effects: Sequence[str]) -> Work:
    """The work that refits the model with some effects."""
    base = works(project)["diagnose"].words[1:]
    own = base[: base.index("--json")]
    safe = "+".join("".join(c if c.isalnum() or c in "._-" else "_" for c in name) for name in effects)
    chain = hashlib.sha256(repr(tuple(effects)).encode()).hexdigest()[:8]  # the names alone may be cut, or look alike
    title = f"Add {effects[-1]}"
    words = [*own, *(word for name in effects for word in ("--effects", name))]
    return replace(_work("add", title, words, f"add-{safe[:80]}-{chain}"), effects=tuple(effects))


def _work(command: str, title: str, words: Sequence[str], name: str = "") -> Work:
    """With all results in a folder of its own, the report and the model in one within it that is the answer's alone."""
    folder = f"results/{name or command}"
    files = ["--json", f"{folder}/{ANSWER}", "--records", f"{folder}/{RECORDS}", "--events", f"{folder}/{EVENTS}"]
    return Work(name or command, title, (command, *words, *files, "--output", f"{folder}/{REPORT}"))


def read_job(folder: Path) -> Job | None:
    """Where the work of a folder stands, as it was written last; None where none was begun."""
    try:
        head = json.loads((folder / _JOB).read_text(encoding="utf-8"))
        own = head["work"]
        work = Work(own["name"], own["title"], tuple(own["words"]), tuple(own["effects"]))
        job = Job(work, head["state"], head["begun"], head["ended"], head["fingerprint"], message=head["message"])
        process = head.get("process")
        job = replace(job, process=process and Started(int(process["pid"]), float(process["began"])))
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return _with_events(job, folder)


def _write_job(job: Job, folder: Path) -> None:
    """But for what its events say."""
    head = {key: one for key, one in asdict(job).items() if key not in ("stage", "trials", "curves")}
    write_file(folder / _JOB, json.dumps(head, indent=1) + "\n")


def _with_events(job: Job, folder: Path) -> Job:
    """With what its events say."""
    lines: list[dict[str, Any]] = []
    with contextlib.suppress(OSError):
        for line in (folder / EVENTS).read_text(encoding="utf-8").splitlines():
            with contextlib.suppress(ValueError):  # the last line may be half written
                lines.append(json.loads(line))
    if not lines:
        return job
    with contextlib.suppress(OSError, ValueError):
        job = replace(job, curves=json.loads((folder / CURVES).read_text(encoding="utf-8")))
    return replace(job, stage=lines[-1]["stage"], trials=tuple(one["trial"] for one in lines if one.get("trial")))


@dataclass
class Runner:
    """Lets the worker do one piece of work at a time.

    Args:
        project: whose.
        limit: s after which work is stopped.
        tasks: of the worker.
    """

    project: Project
    limit: float = 3600.0
    tasks: str = TASKS
    worker: Worker = field(init=False, repr=False)
    _answer: Future[Any] | None = field(default=None, repr=False)
    _job: Job | None = None
    _stopped: bool = False
    _seen: tuple[float, int] = (0.0, 0)

    def __post_init__(self) -> None:
        self.worker = Worker(self.project.folder, self.tasks)

    @property
    def running(self) -> Job | None:
        """The job that runs, with its events; None where none does."""
        return self._job if self._answer is not None else None

    def start(self, work: Work) -> Future[Any]:
        """Begin.

        Returns:
            that is done when the work has ended, however it did.
        Raises:
            BadInput: something runs already, here or in the folder of the result, or another program has a file of it.
        """
        if self.running is not None:
            raise BadInput(f"{self.running.work.title} is running; wait for it, or stop it first")
        folder, now = self.project.results(work.name), self.project.fingerprint()
        before = read_job(folder)
        if before is not None and before.process is not None and before.lives:
            raise BadInput(f"{folder} is being written by process {before.process.pid}; wait for it, or end it first")
        if before is not None and (before.fingerprint != now or before.state == DONE):
            remove(folder, self.project.uploads)  # of other data or another model, or to be done anew
        folder.mkdir(parents=True, exist_ok=True)
        for name in (EVENTS, CURVES):
            (folder / name).unlink(missing_ok=True)
        job = Job(work, RUNNING, time.time(), None, now, stage="starting", process=self.worker.warm())
        _write_job(job, folder)
        self._answer, self._job, self._stopped = self.worker.ask("step", work), job, False
        return self._answer

    def stop(self) -> None:
        """End the worker; what it has found stays in its checkpoint."""
        if self._answer is not None:
            self._stopped = True
            self.worker.end()

    def poll(self) -> bool:
        """See how far it is; whether anything is new."""
        if self._answer is None or self._job is None:
            return False
        folder = self.project.results(self._job.work.name)
        if not self._stopped and self._job.seconds > self.limit:
            self._job = replace(self._job, message=f"it took longer than {self.limit:g} s; run it on the command line")
            self.stop()
        if self._answer.done():
            self._end(self._answer.exception(), folder)
            self.worker.warm()
            return True
        with contextlib.suppress(OSError):
            stat = (folder / EVENTS).stat()
            if (stat.st_mtime, stat.st_size) != self._seen:
                self._seen = (stat.st_mtime, stat.st_size)
                self._job = _with_events(self._job, folder)
                return True
        return False

    def close(self) -> None:
        """End the worker, and write what that ended."""
        self.stop()
        self.worker.end()
        if self._answer is not None and self._job is not None:
            self._end(self._answer.exception(_PATIENCE), self.project.results(self._job.work.name))

    def _end(self, error: BaseException | None, folder: Path) -> None:
        assert self._job is not None
        self._answer, job = None, _with_events(self._job, folder)
        state, message = (DONE, "") if error is None else (FAILED, job.message or str(error))
        if error is not None and self._stopped and not job.message:
            state, message = STOPPED, ""
        elif isinstance(error, Ended) and not job.message:
            message = last_words(folder / OUTPUT)
        self._job = replace(job, state=state, ended=time.time(), message=message, process=None)
        _write_job(self._job, folder)


def settle(project: Project) -> None:
    """End what a server that is gone has left running; it counts as stopped, and can go on.

    Only for whoever has the project to itself: the running job of another server would be ended too.

    Raises:
        BadInput: a process that cannot be ended, as one of another user.
    """
    for path in (project.folder / "results").glob(f"*/{_JOB}"):
        job = read_job(path.parent)
        if job is None or job.state != RUNNING:
            continue
        ended = time.time() if job.lives else path.stat().st_mtime
        if job.process is not None and not job.process.end(_PATIENCE):
            raise BadInput(
                f"{path.parent} is being written by process {job.process.pid}, which a server that is gone has left "
                "and which cannot be ended from here; end it, then start again"
            )
        _write_job(replace(job, state=STOPPED, ended=ended, process=None), path.parent)
