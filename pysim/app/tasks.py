"""What the worker does for the page: functions of `pysim.workflow` and `pysim.diagnosis`, on what it keeps."""

from __future__ import annotations

import contextlib
import json
import math
import shutil
import time
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from pysim import workflow
from pysim.app.bare_logs import describe_logs
from pysim.app.followed import Followed
from pysim.app.jobs import ANSWER, CURVES, EVENTS, OUTPUT, QUICK, RECORDS, REPORT, Work, read_job
from pysim.app.project import Project
from pysim.app.worker import said_in
from pysim.diagnosis import Session, Settings, add, compare, diagnose, learn, rank
from pysim.identify.data_check import DataCheck
from pysim.io import in_model_units, read_described, write_file, write_stages
from pysim.nouns.data import Data
from pysim.nouns.example import EXAMPLES, example_folder
from pysim.nouns.model import model as opened_model
from pysim.present import data, write_report
from pysim.present.diagnosis import Diagnosed, answered, files
from pysim.present.model import Inside
from pysim.present.progress import EventFile
from pysim.present.report import CHECKPOINT, PAGE, mark, with_places
from pysim.types import BadInput, Diagnosis, ProgressEvent, SimulationError

_DRAWING = 0.1  # of the time of a search goes into curves at most


class Tasks:
    """Each method answers a question of the page; what was opened and found is kept while the project stays as it is.

    Args:
        folder: of the project.
    """

    def __init__(self, folder: Path) -> None:
        self._project = Project(folder)
        self._of = ""  # the fingerprint of what is kept
        self._parts: workflow.SessionParts | None = None
        self._sessions: dict[Settings | None, Session] = {}
        self._found: dict[str, Diagnosed] = {}
        self._followed: tuple[Any, ...] = ()

    def model(self) -> dict[str, Any]:
        """What the project's model holds, as `pysim model --json` says it, and whether it is the thesis' pump."""
        settings = self._project.settings()
        libraries = [*map(Path, self._project.libraries)]
        model = workflow.model_of(settings.model, libraries)
        known = workflow.inside(model, libraries)
        found = data(Inside(model, known.class_name, known.slots, known.taken, tuple(libraries)))
        return {**found, "is_thesis_pump": known.is_thesis_pump}

    def checked(self) -> DataCheck:
        """What is to be looked at in the logs as they are prepared, beside the model's answers to their inputs."""
        settings, data = self._project.settings(), Data.of(read_described(Path("data"), partly=True))
        return data.check(opened_model(settings.model, library=settings.libraries)).result

    def describe(self, columns: Sequence[Mapping[str, Any]], kind: str) -> None:
        """Make a data set of the logs that nobody has described yet."""
        coming = self._project.uploads / "described"
        shutil.rmtree(coming, ignore_errors=True)
        describe_logs(self._project.data, columns, kind, coming)
        self._project.replace_data(coming)

    def example(self, name: str) -> None:
        """Take the logs, the library and the model of an example into the project."""
        own, coming = EXAMPLES[name], self._project.uploads / "example"
        shutil.rmtree(coming, ignore_errors=True)
        shutil.copytree(example_folder(name), coming / "data")
        self._project.replace_data(coming / "data")
        for library in own.libraries:
            shutil.copy(library, coming)
        self._project.replace_models([coming / library.name for library in own.libraries])
        names = tuple(f"model/{library.name}" for library in own.libraries)
        self._project.use_model(own.model, names)

    def curves(self, number: int, values: Mapping[str, float]) -> dict[str, Any]:
        """A log of the data set beside the model with these values of its parameters."""
        settings = self._project.settings()
        key = (number, settings.model, settings.libraries, self._project.files())
        if not self._followed or self._followed[0] != key:
            model = workflow.model_of(settings.model, [Path(one) for one in settings.libraries])
            dataset = in_model_units(workflow.data_of(Path("data")), model)
            self._followed = (key, Followed.of(model, dataset, number, values))
        return dict(self._followed[1].curves(values))

    def step(self, work: Work) -> None:
        """Do a piece of work, with its numbers in the folder of its result."""
        folder = self._project.results(work.name)
        with said_in(folder / OUTPUT):
            tell = EventFile(folder / EVENTS)
            result = self._result(work, self._drawing(tell, folder / CURVES))
            tell(ProgressEvent("writing files"))
            for name, content in files(result).items():
                write_file(folder / REPORT / name, content)
            beside = [*result.files.values(), *files(result)]
            whole = with_places(result, {"report": folder / REPORT / PAGE}, folder)
            write_stages(folder / RECORDS, result.found.history)
            write_file(folder / ANSWER, json.dumps(data(whole), indent=1, allow_nan=False))
            mark(folder / REPORT, beside)

    def _drawing(self, tell: Callable[[ProgressEvent], None], file: Path) -> Callable[[ProgressEvent], None]:
        """Tells of a search, and draws one log beside each better point of the base model, in a share of its time."""
        best, pause_until, number = math.inf, time.monotonic() + QUICK, self._followed[0][0] if self._followed else 0

        def told(event: ProgressEvent) -> None:
            nonlocal best, pause_until
            one, begun = event.trial, time.monotonic()
            if one is not None and not one.names and one.error < best and begun > pause_until:
                best, self._followed = one.error, ()  # where the log begins depends on the values
                with contextlib.suppress(BadInput, SimulationError):  # a fit may end where no log can be drawn
                    found = self.curves(number, {**self._project.values(), **one.values})
                    plain = {key: np.asarray(value).tolist() for key, value in found.items()}
                    write_file(file, json.dumps({**plain, "error": best}))
                pause_until = time.monotonic() + (time.monotonic() - begun) / _DRAWING
            tell(event)

        return told

    def report(self, name: str) -> None:
        """Draw the report of a result; one that is not kept goes on from its checkpoint, to its end."""
        folder = self._project.results(name)
        job = read_job(folder)
        if job is None:
            raise BadInput(f"{name} has no result; run it again")
        with said_in(folder / OUTPUT):
            kept = self._of == self._project.fingerprint() and name in self._found
            result = self._found[name] if kept else self._result(job.work, lambda event: None)
            written = write_report(folder / REPORT, result, redo=workflow.command_line(job.work.words))
            more = {path.with_suffix(suffix).name for path in written.values() for suffix in (path.suffix, ".svg")}
            names = [one for one in {*result.files.values(), *more} if (folder / REPORT / one).is_file()]
            mark(folder / REPORT, names)

    def _opened(self, work: Work) -> workflow.SessionParts:
        """The project's model and data, opened once while they and the libraries of the work stay as they are."""
        now, settings = self._project.fingerprint(), self._project.settings()
        libraries = tuple(map(Path, work.libraries))
        if self._parts is None or self._of != now or self._parts.libraries != libraries:
            measured = workflow.data_of(Path("data"))
            reference_hz = workflow.reference_of(measured.responses())
            self._parts = workflow.session_parts(
                workflow.model_of(settings.model, libraries), measured, libraries=libraries, free=settings.free,
                bounds=settings.ranges, values=self._project.values(), reference_hz=reference_hz,
            )  # fmt: skip
            self._found = self._found if self._of == now else {}
            self._of, self._sessions = now, {}
        return self._parts

    def _result(self, work: Work, tell: Callable[[ProgressEvent], None]) -> Diagnosed:
        """What a piece of work finds, kept."""
        parts = self._opened(work)
        report = self._project.results(work.name) / REPORT
        report.mkdir(exist_ok=True)
        found = self._function(work, parts)(progress=tell, checkpoint=report / CHECKPOINT)
        found = workflow.whole_answer(found, parts, place="data", command=workflow.command_line(work.words))
        beside = {name: path.name for name, path in workflow.write_extended(found, parts, report).items()}
        self._found[work.name] = answered(work.kind, found, parts.dataset, parts.model_name, beside)
        return self._found[work.name]

    def _function(self, work: Work, parts: workflow.SessionParts) -> Callable[..., Diagnosis]:
        """The function that does a piece of work."""
        settings = Settings(max_effects=0) if work.kind == "rank" else None
        if settings not in self._sessions:
            self._sessions[settings] = workflow.session_of(parts, settings)
        session = self._sessions[settings]
        if work.effects:
            known = {one.name for one in parts.inside.catalogue}  # an error of a sensor is none of them
            step = learn if work.kind == "locate" else add
            return partial(step, session, workflow.effects_of([one for one in work.effects if one in known], parts))
        steps: dict[str, Callable[..., Diagnosis]] = {"compare": compare, "locate": learn, "rank": rank}
        return partial(steps.get(work.kind, diagnose), session)
