"""Measurements as a user holds them: loaded as they come, made ready by steps that can be seen, and looked at."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from pysim.identify.data_check import DataCheck, check_dataset, with_one_cause
from pysim.io.counted import counted
from pysim.io.dataset import Described, read_described
from pysim.io.file_names import same_file
from pysim.io.load import is_frame, load_logs
from pysim.io.load.load import Names
from pysim.io.load.table import Doubt
from pysim.io.prepare import (
    Delay,
    Detrend,
    DropOutliers,
    Exclude,
    FillGaps,
    Flip,
    HoldOut,
    LowPass,
    Rename,
    Resample,
    Scaled,
    Split,
    Step,
    Trim,
    call,
    logs_called,
    prepared,
    refuse_missing_samples,
    renamed_logs,
    short_name,
)
from pysim.io.write_dataset import write_dataset
from pysim.nouns.data_check import Check, other_quantities
from pysim.nouns.model import Model
from pysim.nouns.table import Shown, Table, pandas
from pysim.types import UNITS, BadInput, Dataset, MeasuredRecord, Record, conversion
from pysim.types.kinds import mapping_of, names_of, number_of, path_of, whole_number_of
from pysim.types.record_kind import Command


@dataclass(frozen=True, repr=False)
class Data(Shown):
    """Logs and tables of responses, and the steps that made them ready. Every method gives a new one; files stay.

    Args:
        raw: as it was taken, in SI units or %; an empty cell is not-a-number.
        now: after the steps.
        history: the steps, in order.
        logged: signal -> unit in which it was logged.
        units: the same after the steps, for people to read.
        remarks: log -> what was guessed or left out when it was loaded.
    """

    raw: Dataset
    now: Dataset
    history: tuple[Step, ...]
    logged: Mapping[str, str]
    units: Mapping[str, str]
    remarks: Mapping[str, tuple[str, ...]]

    @classmethod
    def of(cls, described: Described) -> Data:
        """A data set as its folder has it, after the steps of its preparation."""
        return cls(described.raw, described.raw, (), described.units, described.units, {}).after(*described.steps)

    @property
    def dataset(self) -> Dataset:
        """What is fitted and compared: SI units or %. An output is not-a-number where it was not measured.

        Raises:
            BadInput: an input lacks samples, with the line that fills them.
        """
        refuse_missing_samples(self.now)
        return self.now

    @property
    def names(self) -> tuple[str, ...]:
        """Of all logs and tables."""
        return tuple(short_name(self.now, record) for record in self.now.records)

    def __getitem__(self, name: str) -> MeasuredRecord:
        """The log of that name; also the only one of a use: data["test"].

        Raises:
            BadInput: there is none, or there are several.
        """
        try:
            found = logs_called(self.now, name)
        except BadInput:
            found = tuple(record for record in self.now.records if record.use == name)
            if not found:
                raise
        if len(found) > 1:
            parts = ", ".join(short_name(self.now, record) for record in found)
            raise BadInput(f"{name!r} is several logs; name one of {parts}")
        return replace(found[0], holds=self._holds("name"))

    def __len__(self) -> int:
        return len(self.now.records)

    def after(self, *steps: Step) -> Data:
        """The same after more steps, such as those of a finding of `check`.

        Raises:
            BadInput: a step cannot be done, with the cure.
        """
        now = prepared(self.now, steps)
        units = dict(self.units)
        for step in steps:
            if isinstance(step, Rename):
                units = {step.names.get(name, name): unit for name, unit in units.items()}
            if isinstance(step, Scaled) and step.unit and not step.logs:
                units[step.signal] = step.unit
        return replace(self, now=now, history=(*self.history, *steps), units=units)

    def trim(self, start: float | None = None, stop: float | None = None, *, logs: Iterable[str] = ()) -> Data:
        """Leave out what is ahead of `start` s and behind `stop` s on the clock of each log, or of those named."""
        return self.after(Trim(_number(start, "start"), _number(stop, "stop"), names_of(logs, "logs")))

    def exclude(self, log: str, start: float | None = None, stop: float | None = None) -> Data:
        """Leave out the stretch from `start` to `stop` s of a log, which becomes two; without them, all of it."""
        return self.after(Exclude(log, _number(start, "start"), _number(stop, "stop")))

    def fill_gaps(self, longest: float, *signals: str, shortest: int = 10) -> Data:
        """Fill missing samples of inputs up to `longest` s by straight lines; cut logs where more is missing.

        Args:
            signals: outputs that are filled as well, for a filter. Others are not compared where a sample is missing.
            shortest: samples; pieces of fewer are left out.
        """
        least = whole_number_of(shortest, "shortest")
        return self.after(FillGaps(_finite(longest, "longest"), names_of(signals, "signals"), least))

    def drop_outliers(self, sigmas: float = 8.0, *signals: str) -> Data:
        """Take out samples that are so many standard deviations off their neighbours; inputs get straight lines."""
        return self.after(DropOutliers(_finite(sigmas, "sigmas"), names_of(signals, "signals")))

    def resample(self, hz: float) -> Data:
        """Sample evenly at another rate, with a filter ahead of a lower one."""
        return self.after(Resample(_finite(hz, "hz")))

    def lowpass(self, hz: float, *signals: str) -> Data:
        """Take off what is faster than `hz`, without phase; of all signals where none is named."""
        return self.after(LowPass(_finite(hz, "hz"), names_of(signals, "signals")))

    def detrend(self, *signals: str, order: int = 0) -> Data:
        """Take the mean (order 0) or the line (1) off signals, log by log; off all where none is named."""
        return self.after(Detrend(names_of(signals, "signals"), whole_number_of(order, "order")))

    def delay(self, signal: str, seconds: float) -> Data:
        """Let a signal come later by so many s; a negative number lets it come earlier, as where its sensor lags."""
        return self.after(Delay(signal, _finite(seconds, "seconds")))

    def flip(self, *signals: str, logs: Iterable[str] = ()) -> Data:
        """Turn the sign of signals, in all logs or in those named."""
        return self.after(Flip(names_of(signals, "signals"), names_of(logs, "logs")))

    def scale(
        self,
        signal: str,
        factor: float = 1.0,
        offset: float = 0.0,
        unit: str = "",
        *,
        of: str = "",
        logs: Iterable[str] = (),
    ) -> Data:
        """Multiply a signal in the unit it was logged in, and add an offset; the result is in `unit`, else in the same.

        Args:
            of: the unit in which its values count, where not that of the log.
            logs: names of those to scale it in, where it keeps its unit; all where there are none.

        Raises:
            BadInput: no such signal or log, or a unit that is not known.
        """
        of, names = of or self.units.get(signal, ""), names_of(logs, "logs")
        numbers = _finite(factor, "factor"), _finite(offset, "offset")
        return self.after(Scaled(signal, *numbers, unit or of, of, names))

    def rename(self, names: Mapping[str, str] | None = None, **more: str) -> Data:
        """Give signals other names, old="new"; two may swap theirs."""
        return self.after(Rename({**mapping_of(names, "names"), **more}))

    def hold_out(self, *names: str) -> Data:
        """Keep logs to report the error on: nothing is fitted to them, and nothing is chosen with them."""
        return self.after(HoldOut(names_of(names, "names")))

    def split(self, share: float) -> Data:
        """Cut each log in two, and hold out the second part; the first has that share of its samples."""
        return self.after(Split(number_of(share, "share")))

    def check(self, model: Any = None) -> Check:
        """What should be looked at before anything is fitted, each with the line that cures it.

        Args:
            model: what answers to the inputs: a model with `.simulate(log)`, the run of the only log, or runs by the
                names of logs. A log that it is given lacks no sample of an input; an output is NaN where it was not
                measured. With a model, signs, units and columns are looked at too; of a `pysim.model` also whether it
                has what is measured, and whether its inputs are driven.
        """
        return Check(with_one_cause(*self._checked(model), lambda step: self.after(step)._checked(model)))

    def _checked(self, model: Any) -> tuple[DataCheck, dict[str, Record]]:
        """The check, and the model's answers to the logs."""
        own = isinstance(model, Model)
        wrong = other_quantities(self.now, model.compiled) if own else ()
        answers = {} if wrong else self._answers(model)
        found = check_dataset(self.now, answers, *((model.compiled, tuple(model.values)) if own else ()))
        return replace(found, beside_model=(*wrong, *found.beside_model)), answers

    def _answers(self, model: Any) -> dict[str, Record]:
        """Source of a log -> the model's answer to it."""
        logs = [record for record in self.now.logs() if not record.held_out] or list(self.now.logs())
        if model is None:
            return {}
        if isinstance(model, Model):  # from its own start, as states estimated from a wrong column are wrong too
            inputs = set(model.inputs["name"])
            able = [one for one in map(self._for_model, logs) if inputs & {*one.data.names}]  # type: ignore[union-attr]
            return {one.source: model.simulate(one, initial={}).record for one in able}
        if hasattr(model, "simulate"):
            return {record.source: _record(model.simulate(self._for_model(record))) for record in logs}
        if isinstance(model, Mapping):
            return {self[name].source: _record(run) for name, run in model.items()}
        if len(logs) != 1:
            names = ", ".join(short_name(self.now, record) for record in logs)
            raise BadInput(f"one run for {len(logs)} logs; give a dict of runs by their names: {names}")
        return {logs[0].source: _record(model)}

    def _for_model(self, record: MeasuredRecord) -> MeasuredRecord:
        """A log as a model can be driven by it: its whole rows, its columns called as the model calls them."""
        assert isinstance(record.data, Record)
        names = tuple(self.now.signal(name).variable for name in record.data.names)
        data = replace(record.data.whole_rows(self.now.columns(record, "input")), names=names)
        return replace(record, data=data, holds=self._holds("variable"))

    def _holds(self, called: str) -> dict[str, Command]:
        """Input -> how it runs between samples, where the data set says it."""
        return {getattr(one, called): one.hold for one in self.now.signals if one.hold is not None}

    def plot(self, *, interactive: bool = False) -> Any:
        """Signals over time, a row per log and a column per unit; at most eight logs.

        Args:
            interactive: a Plotly figure in place of Matplotlib's, with a panel per signal.
        """
        from pysim.present.charts import as_plotly
        from pysim.present.data_check.figures import time_logs_figure
        from pysim.present.overlay import lines_chart

        if not interactive:
            return time_logs_figure(self.now)
        logs = zip(self.names, self.now.records, strict=True)
        return as_plotly(lines_chart({name: one.data for name, one in logs if isinstance(one.data, Record)}))

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame over log and time in s, columns "x [mm]" in the units of the logs."""
        frames = {}
        for name, record in zip(self.names, self.now.records, strict=True):
            if isinstance(record.data, Record):
                log = record.data
                columns = {f"{own} [{self._unit(own)}]": self._read(own, log[own]) for own in log.names}
                frames[name] = pandas().DataFrame(columns, index=pandas().Index(log.time, name="time [s]"))
        if not frames:
            raise BadInput("there are no logs over time to make a table of")
        return pandas().concat(frames, names=["log"])

    def save(self, folder: Path | str) -> Path:
        """Write the raw logs as text and a dataset.toml with the steps, which every reader then does again.

        Args:
            folder: a new or empty one. In it, run.dat becomes run.txt; beside run.asc, dat/run.txt and asc/run.txt.
        Returns:
            the path of dataset.toml.
        Raises:
            BadInput: the folder holds something, or cannot be written.
        """
        text = as_text(self.raw)
        called = {old.source: new.source for old, new in zip(self.raw.records, text.records, strict=True)}
        steps = [renamed_logs(step, called) for step in self.history]
        return write_dataset(path_of(folder, "folder"), text, units=self.logged, steps=steps, exact=True)

    def _unit(self, signal: str) -> str:
        """In which people read a signal."""
        own, shown = self.now.signal(signal).unit, self.units.get(signal, "")
        return shown if shown in UNITS and conversion(own, shown) else own

    def _read(self, signal: str, values: Any) -> Any:
        """Numbers in the unit that people read."""
        factor, zero = conversion(self.now.signal(signal).unit, self._unit(signal)) or (1.0, 0.0)
        return factor * np.asarray(values) + zero

    @property
    def _words(self) -> list[str]:
        named = {
            role: ", ".join(f"{s.name} [{self._unit(s.name)}]" for s in self.now.signals if s.role == role)
            for role in ("input", "output")
        }
        lines = [f"{counted(len(self.now.records), 'log')}: inputs {named['input']}; outputs {named['output']}"]
        steps = ", ".join(call(step) for step in self.history)
        return [_short(line, 300) for line in (*lines, *([f"prepared: {steps}"] if steps else []))]

    @property
    def table(self) -> Table:
        """Name, use, samples, seconds and warnings of each log."""
        rows: list[tuple[str, ...]] = []
        for name, record in zip(self.names, self.now.records, strict=True):
            if isinstance(record.data, Record):
                size, span = record.data.time.size, f"{record.data.time[-1] - record.data.time[0]:.4g}"
                empty = int(np.count_nonzero(~np.isfinite(record.data.values)))
            else:
                size, span, empty = record.data.frequency.size, "-", 0
            cells = [counted(empty, "empty cell")] if empty else []
            doubts = [s for s in self.remarks.get(record.source, ()) if isinstance(s, Doubt)]
            rows.append((name, record.use, str(size), span, "; ".join([*cells, *doubts])))
        return Table.of(("log", "use", "samples", "seconds", "warnings"), rows, key="log")


def load(
    source: Any,
    *,
    inputs: Names | None = None,
    outputs: Names | None = None,
    time: str | None = None,
    units: Mapping[str, str] | None = None,
    noise: Mapping[str, float] | None = None,
    variables: Mapping[str, str] | None = None,
    hold: Mapping[str, str] | None = None,
) -> Data:
    """Read logs as they come, or a data set that describes itself.

    Args:
        source: a path, a pattern, a folder, a table in memory (pandas, polars, Arrow, xarray, a dict of arrays), a list
            of any, or a dict of these by name. Of a folder with a dataset.toml all else is known.
        inputs, outputs: names of the signals as the headings have them, ahead of their units; a dict gives other names
            to them: signal -> heading.
        time: heading of the clock; without it, that is looked for.
        units: signal (or heading) -> unit, where no heading tells one.
        noise: signal -> standard deviation of its noise, in its unit.
        variables: signal -> variable of the model, where that is called otherwise.
        hold: input -> how it runs between samples, "zero", "linear" or "spline".
    Raises:
        BadInput: what cannot be read, is not there, or must be asked for, with its place and the cure.
    """
    columns: dict[str, Any] = {
        what: own if isinstance(own, Mapping | None) else names_of(own, what)
        for what, own in (("inputs", inputs), ("outputs", outputs))
    }
    named = {"units": units, "noise": noise, "variables": variables, "hold": hold}
    given: dict[str, Any] = {"time": time, **{what: mapping_of(own, what) for what, own in named.items()}}
    given["noise"] = {name: number_of(sd, "noise") for name, sd in given["noise"].items()}
    if _describes_itself(source):
        extra = [name for name, value in {**columns, **given}.items() if value]
        if extra:
            raise BadInput(f"{source} has a dataset.toml that says what its logs are; leave out {', '.join(extra)}")
        return Data.of(read_described(source))
    found = load_logs(source, **columns, **given)
    return Data(found.dataset, found.dataset, (), found.units, found.units, found.remarks)


def as_text(dataset: Dataset) -> Dataset:
    """The same with names for files of text; those that would have one name stand in folders, as dat/run.txt does."""
    names = [PurePosixPath(source) for source in dict.fromkeys(record.source for record in dataset.records)]
    texts = {name: name if name.suffix.lower() in (".txt", ".csv") else name.with_suffix(".txt") for name in names}
    count = Counter(same_file(text.as_posix()) for text in texts.values())
    taken = {*count}
    for name, text in texts.items():
        if text != name and count[same_file(text.as_posix())] > 1:
            while same_file(text.as_posix()) in taken:
                text = text.parent / (name.suffix[1:] or "log") / text.name
            texts[name] = text
            taken.add(same_file(text.as_posix()))
    records = (replace(record, source=texts[PurePosixPath(record.source)].as_posix()) for record in dataset.records)
    return replace(dataset, records=tuple(records))


def _describes_itself(source: Any) -> bool:
    if is_frame(source) or not isinstance(source, str | Path):
        return False
    path = Path(source)
    return path.suffix == ".toml" or (path / "dataset.toml").is_file()


def _record(run: Any) -> Record:
    """The columns of a run, or of what holds one."""
    found = run if isinstance(run, Record) else getattr(run, "record", None)
    if not isinstance(found, Record):
        raise BadInput(f"a {type(run).__name__} is no run of a model; simulate the model on the log")
    return found


def _number(value: float | None, argument: str) -> float | None:
    return None if value is None else _finite(value, argument)


def _finite(value: float, argument: str) -> float:
    number = number_of(value, argument)
    if not math.isfinite(number):
        raise BadInput(f"{argument}: {number:g} is not finite; give a number", argument=argument)
    return number


def _short(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most - 3]}..."
