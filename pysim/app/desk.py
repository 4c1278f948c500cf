"""What all tabs share: the project, what runs, and what was read of the data and the model."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from nicegui import run

from pysim.app.answers import Answer, Answers
from pysim.app.disk import remove
from pysim.app.history import CHOICES, History, changed
from pysim.app.jobs import DONE, STOPPED, Job, Runner, Work, adding, read_job, works
from pysim.app.live import news
from pysim.app.project import Project
from pysim.app.records import raw_of
from pysim.app.upload import Batch, Limits
from pysim.app.worker import TASKS, Ended
from pysim.identify.data_check import DataCheck, FindingCode, check_dataset
from pysim.io import read_described, write_file
from pysim.io.prepare import prepared
from pysim.types import BadInput, Dataset, MeasuredRecord, Record
from pysim.workflow import LawPlace, class_name_of, effect_class
from pysim.workflow.own_law import Range

_BUILD_LIMIT = 1200.0  # s: the 900 that fmu_build.pack.compiler grants the first compilation, and more than any takes
_LATE = (
    f"the model was not ready within {_BUILD_LIMIT:g} s; the first one on a machine takes some minutes on Windows, and "
    "what is compiled is kept: use it again, and if that takes as long, try it in a terminal with pysim model"
)


@dataclass(frozen=True)
class Loaded:
    """The data set as it was read.

    Args:
        check: what it holds; None where the description itself is wrong, or is not there.
        refused: file and reason.
        trouble: why there is no check.
        raw: its logs before they were prepared; steps: how many follow.
    """

    check: DataCheck | None
    refused: tuple[tuple[str, str], ...] = ()
    trouble: str = ""
    raw: Dataset | None = None
    steps: int = 0

    @property
    def empty_cells(self) -> bool:
        """Whether a log has cells without a number still."""
        return self.check is not None and any(one.code is FindingCode.EMPTY for one in self.check.findings)


@dataclass
class Desk:
    """One per server. What cannot be done, as while work is running, is a `BadInput` that says why.

    Args:
        take: gives another project, once this server has it to itself.
        doing: what goes on that is no job, in words; "" where nothing does.
        drawing: whether a report is being drawn.
        trouble: why the last of it failed.
        taking: whether a drop is being put into the project.
        draft: what was chosen so far for logs that nobody has described.
        version: changes with everything that a page shows, but for what a running job tells;
        beat: changes with that too.
    """

    project: Project
    runner: Runner
    limits: Limits
    take: Callable[[Path], Project] = Project.at
    doing: str = ""
    drawing: bool = False
    trouble: str = ""
    version: int = 0
    beat: int = 0
    loaded: Loaded | None = None
    model: Mapping[str, Any] | None = None
    model_trouble: str = ""
    model_busy: bool = False
    last: Job | None = None
    batches: dict[str, Batch] = field(default_factory=dict)
    taking: bool = False
    draft: dict[str, Any] = field(default_factory=dict)
    history: History = field(init=False)
    _answers: tuple[int, Answers] | None = None
    _build: int = 0  # number of the newest one
    _reading: int = 0  # the same

    def __post_init__(self) -> None:
        self.history = History(self.project)

    def changed(self) -> None:
        """Something that pages show is other than before."""
        self.history.look()  # now: what is chosen next is another step
        if self.last is not None and self.last.fingerprint != self.project.fingerprint():
            self.last = None  # it was of other choices
        self.version += 1
        self.beat += 1
        news.emit()

    def open(self, folder: Path, *, tasks: str = TASKS) -> None:
        """Show another project from now on, with these tasks of its worker; nothing of it is read yet."""
        if self.runner.running is not None or self.taking or self.doing:
            raise BadInput("wait until the running work has ended, or stop it; then open another project")
        project = self.take(folder)
        self.runner.close()
        fresh = Desk(project, Runner(project, self.runner.limit, tasks), self.limits, self.take)
        kept = {"version": self.version, "beat": self.beat, "_build": self._build + 1, "_reading": self._reading + 1}
        vars(self).update(vars(fresh) | kept)  # what the one before still reads is late
        self.changed()

    async def read(self) -> None:
        """Read data and model."""
        await asyncio.gather(self.read_data(), self.read_model())

    async def example(self, name: str) -> None:
        """Take an example into the project, read it and hold the model beside it; `trouble` says what fails."""
        try:
            await self._do(f"Making the example {name}", "example", name)
        except (BadInput, Ended) as error:
            self.trouble = str(error) or "the example was not made; open it again"
        await self.read()
        if not self.trouble and not self.model_trouble:
            self.start(self.work("compare"))

    async def describe(self, columns: Sequence[Mapping[str, Any]], kind: str) -> None:
        """Make the logs a data set; as they were dropped they are kept as an earlier one."""
        self._free_to_change()
        await self._do("Reading the logs", "describe", columns, kind)
        await self.read_data()

    async def _do(self, words: str, task: str, *given: Any) -> None:
        """Let the worker put other data or models into the project."""
        self.doing, self.trouble = words, ""
        self.changed()
        try:
            await self._ask(task, *given)
        finally:
            self.doing = ""
            self.history.begin_anew()
            self.changed()

    async def _ask(self, task: str, *given: Any) -> Any:
        """What the worker answers."""
        return await asyncio.wrap_future(self.runner.worker.ask(task, *given))

    @property
    def check(self) -> DataCheck | None:
        """What the data set holds; None where there is none that can be read."""
        return self.loaded.check if self.loaded else None

    @property
    def answers(self) -> Answers:
        """Finished results, read once per change."""
        if self._answers is None or self._answers[0] != self.version:
            self._answers = (self.version, found := Answers.of(self.project))
            added = self.project.settings().added
            if found.with_effects(added) if added else found.all:
                self.history.held = self.history.now
        return self._answers[1]

    @property
    def put_aside(self) -> str:
        """What was chosen otherwise since there were results; "" where these hold, or were none."""
        read = self.answers  # which sees whether there are any now
        return changed(self.history.held, self.history.now, CHOICES) if read else ""

    def tick(self) -> None:
        """Look after the running job, and after what was chosen."""
        steps = len(self.history.past)
        self.history.look()
        self.beat += len(self.history.past) != steps
        before = self.runner.running
        self.beat += self.runner.poll()
        if before is not None and self.runner.running is None:
            self.last = read_job(self.project.results(before.work.name))
            self.changed()
            self._ended()
        news.emit()  # a clock goes on, too

    def _ended(self) -> None:
        """A finished diagnosis or addition says what the model has from now on."""
        job = self.last
        if job is None or job.state != DONE:
            return
        answer = next((one for one in self.answers.all if one.job.work.name == job.work.name), None)
        if answer is not None and (job.work.name == "diagnose" or job.work.words[0] == "add"):
            self.project.change(added=answer.added)

    def start(self, work: Work) -> None:
        """Run something."""
        if self.taking:
            raise BadInput("a drop is being taken over; try again in a moment")
        self.last = None
        loop = asyncio.get_running_loop()
        self.runner.start(work).add_done_callback(lambda _: loop.call_soon_threadsafe(self.tick))  # at once
        deleted = self.project.settings().deleted
        if work.name in deleted:  # it is made anew
            self.project.change(deleted=tuple(one for one in deleted if one != work.name))
        self.changed()

    def work(self, command: str) -> Work:
        """What a button starts."""
        return works(self.project)[command]

    def add(self, effect: str) -> None:
        """Try an effect beside those that the model has; one that was tried before is shown at once."""
        added = (*self.project.settings().added, effect)
        if self.answers.with_effects(added) is not None:
            self.project.change(added=added)
            self.changed()
        else:
            self.start(adding(self.project, added))

    async def check_with_model(self) -> None:
        """Look at the logs beside the model's answers: signs, units, and columns that are swapped."""
        self._free_to_change()
        check = await self._ask("checked")
        if self.loaded is not None:
            self.loaded = replace(self.loaded, check=check)
            self.changed()

    async def add_law(self, name: str, place: LawPlace, law: str, ranges: Mapping[str, Range]) -> None:
        """Make a law an effect of the project, and try it beside those that the model has.

        One of that name is changed, and what was found with it as it was is removed, what tried it too.
        """
        self._free_to_change()
        content = effect_class(name, place.slot, law, ranges, place.libraries)
        file = self.project.laws / f"{class_name_of(name)}.mo"
        if file.is_file() and file.read_text(encoding="utf-8") != content:
            self.runner.worker.end()  # it keeps the class
            for job in map(read_job, (self.project.folder / "results").glob("*")):
                if job is not None and (name in job.work.effects or job.work.kind in ("rank", "diagnose")):
                    remove(self.project.results(job.work.name), self.project.uploads)
            self.project.change(added=tuple(one for one in self.project.settings().added if one != name))
            self.history.begin_anew()
        file.parent.mkdir(exist_ok=True)
        write_file(file, content)
        self.model = await self._ask("model")
        self.add(name)

    def change(self, values: Mapping[str, float] | None = None, **settings: Any) -> None:
        """Choose something else, of what results depend on, and other values; the model keeps its effects."""
        self._free_to_change()
        if values is not None:
            settings = {"free": self.fitted, **settings}  # else fits would hold what is set
            self.project.set_values(values)
        self.project.change(**settings)
        self.changed()

    @property
    def fitted(self) -> tuple[str, ...]:
        """What fits change: what was chosen; else all with bounds and a usual size, of the model or of the user."""
        settings, rows = self.project.settings(), (self.model or {}).get("parameters", [])
        whole = (one["name"] for one in rows if None not in (one["min"], one["max"], one["nominal"], one["start"]))
        return settings.free or tuple(dict.fromkeys((*whole, *settings.ranges)))

    def keep(self, found: Mapping[str, float]) -> None:
        """Begin at what a search has found, from now on; what it has fitted is fitted on."""
        self.change({**self.project.values(), **found})

    def raw_of(self, log: MeasuredRecord) -> Record | None:
        """A log before it was prepared; None where that is not known."""
        return None if self.loaded is None or self.loaded.raw is None else raw_of(self.loaded.raw, log)

    async def bring_back(self, earlier: Path | None) -> None:
        """Take a data set that others took the place of, or none; the one that is there now becomes an earlier one."""
        self._free_to_change()
        self.project.replace_data(earlier)
        self.project.change(added=())
        self.history.begin_anew()
        await self.read_data()

    def _free_to_change(self) -> None:
        if self.runner.running is not None or self.taking or self.doing:
            raise BadInput("wait until the running work has ended, or stop it")

    def choose(self, added: tuple[str, ...]) -> None:
        """Show the model with other effects, of which there is a result."""
        self.last = None
        self.project.change(added=added)
        self.changed()

    def delete(self, answer: Answer) -> None:
        """Show a result no more; undo brings it back, for as long as this server runs."""
        self._free_to_change()
        now = self.project.settings()
        added = () if now.added == answer.added else now.added
        self.project.change(deleted=(*now.deleted, answer.folder.name), added=added)
        self.changed()

    def name(self, added: Sequence[str], name: str) -> None:
        """Call the model with some effects otherwise; "" takes its name from it."""
        names = {**self.project.settings().named, "+".join(added): " ".join(name.split())}
        self.project.change(names=tuple(f"{key}={one}" for key, one in names.items() if one))
        self.changed()

    async def turn_back(self, step: Callable[[], None]) -> str:
        """Undo, or redo, what was chosen, a step of the history; what that was, for people."""
        if self.runner.running is not None or self.taking or self.doing:
            return ""
        self.history.look()
        now, before = self.history.now, self.project.settings()
        step()
        told, after = changed(now, self.history.now), self.project.settings()
        self.changed()
        if now[self.project.description.name] != self.history.now[self.project.description.name]:
            await self.read_data()
        if (before.model, before.libraries) != (after.model, after.libraries):
            await self.read_model()
        return told

    def unfinished(self) -> Job | None:
        """The newest job that was stopped and could go on, of the data and the model as they are."""
        now = self.project.fingerprint()
        jobs = [read_job(path.parent) for path in (self.project.folder / "results").glob("*/job.json")]
        open_ = [job for job in jobs if job and job.state == STOPPED and job.fingerprint == now]
        return max(open_, key=lambda job: job.begun, default=None)

    async def read_data(self) -> None:
        """Read the data set again, beside the page; an earlier reading that ends later is not what it is now."""
        self._reading += 1
        reading = self._reading
        loaded = await run.io_bound(load, self.project)
        if self._reading == reading:
            self.loaded = loaded
            self.changed()

    async def read_model(self) -> None:
        """Let the worker build or open the model, and keep what it says of itself; an earlier build ends."""
        self._build += 1
        build, worker = self._build, self.runner.worker
        if self.model_busy:
            worker.end()
        self.model, self.model_trouble = None, ""
        self.model_busy = bool(self.project.settings().model)
        self.changed()
        if not self.model_busy:
            return
        model, trouble = None, ""
        try:
            model = await asyncio.wait_for(asyncio.wrap_future(worker.ask("model")), _BUILD_LIMIT)
        except TimeoutError:
            trouble = _LATE
        except BadInput as error:
            trouble = str(error)
        except Ended:
            trouble = "the process that opens the model broke down; use it again, or try pysim model in a terminal"
        if self._build != build:
            return
        if trouble == _LATE:
            worker.end()
        self.model, self.model_trouble, self.model_busy = model, trouble, False
        self.changed()

    async def draw_report(self, name: str) -> None:
        """Let the worker draw the report of a result."""
        if self.runner.running is not None or self.model_busy:
            raise BadInput("wait until the running work has ended; then open the report again")
        self._draws(True)
        try:
            await self._ask("report", name)
        except Ended as error:
            raise BadInput("the report was not finished; open it again") from error
        finally:
            self._draws(False)

    def _draws(self, now: bool) -> None:
        self.drawing = now
        self.beat += 1
        news.emit()


def load(project: Project) -> Loaded | None:
    """Read the project's data set; None where there is none yet."""
    if not project.description.is_file():
        return Loaded(None) if project.data.is_dir() else None
    try:
        found = read_described(project.data, partly=True)
        short = tuple((file, why.replace(f"{project.data}{os.sep}", "")) for file, why in found.refused)
        return Loaded(check_dataset(prepared(found.raw, found.steps)), short, raw=found.raw, steps=len(found.steps))
    except BadInput as error:
        return Loaded(None, trouble=str(error).replace(f"{project.data}{os.sep}", ""))
