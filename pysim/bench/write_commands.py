"""A plan as files that a real bench plays, and the dataset.toml that its logs are read back by."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from pathlib import Path, PurePosixPath
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pysim.bench.bench_tests import Run
from pysim.bench.plan import Plan
from pysim.io import optional_package, signal_times, write_description, write_file
from pysim.types import BadInput, Dataset, MeasuredRecord, Record

Array = NDArray[np.float64]
Names = tuple[str, ...]

_COMMANDS = "commands"  # folder of what is played, beside the logs
_INDEX = "index.csv"
_HEAD = "file,log,log from [s],log to [s],rate [Hz],samples,offset,scale,unit"
LOG_FORMS = ("tdms", "csv", "txt", "parquet")


def write_commands(
    plan: Plan, folder: Path, *, form: str = "csv", logs: str = "tdms", sampling_hz: float = 1000.0
) -> tuple[Path, ...]:
    """Write a file for every run of a plan, a table of them, and the dataset.toml of the logs to come.

    The logs are to lie beside the commands under the names that the table and dataset.toml give, each cut to the times
    of the table. Their columns are "time" in s and the signals of the plan, in the plan's units; text has them in that
    order below a header.

    Args:
        folder: made here; must be empty or not there.
        form: one of FORMS: "csv" and "tdms" hold time and value of each command; "generator" holds a number between -1
            and 1 a row, which a generator of arbitrary waveforms plays at the table's rate, offset and scale.
        logs: one of LOG_FORMS, the suffix of the logs.
        sampling_hz: rows per second.
    Returns:
        all files, dataset.toml last.
    Raises:
        BadInput: a folder that holds something, an unknown form, a run that so few rows do not show, a package that is
            missing, or a place that cannot be written.
    """
    if form not in FORMS or logs not in LOG_FORMS:
        raise BadInput(
            f"commands as {form!r}, logs as {logs!r}; choose of {', '.join(FORMS)} and {', '.join(LOG_FORMS)}"
        )
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise BadInput(f"{folder}: something is there already; choose a new folder")
    suffix, content = FORMS[form]
    paths = [_checked(run, folder / _COMMANDS, suffix, sampling_hz) for run in plan.runs()]
    index, written = [_HEAD], list[Path]()
    for run, path in zip(plan.runs(), paths, strict=True):
        times = signal_times(path, run.command.duration, sampling_hz)
        names, columns, units = _driven(plan, run, times)
        written.append(_write(path, content(times, columns, names, units)))
        low, high = float(columns[:, 0].min()), float(columns[:, 0].max())
        scale = 0.5 * (high - low) or 1.0
        index.append(
            f"{path.relative_to(folder).as_posix()},{_log_name(run, logs)},{run.log_from:.9g},{run.command.end:.9g},"
            f"{sampling_hz:.9g},{times.size},{0.5 * (low + high):.9g},{scale:.9g},{units[0]}"
        )
    written.append(_write(folder / _COMMANDS / _INDEX, "\n".join(index) + "\n"))
    files_in = {name: unit for name, (unit, _) in plan.units.items()}
    return (*written, write_description(folder, _to_come(plan, logs), files_in))


def _checked(run: Run, folder: Path, suffix: str, sampling_hz: float) -> Path:
    """The file of a run's command, which so many rows per second show."""
    if not sampling_hz > 2 * run.command.highest_hz:
        raise BadInput(f"{run.source}: {sampling_hz:g} rows per second do not show {run.command.highest_hz:.4g} Hz")
    stem = PurePosixPath(run.source).with_suffix("")
    path = folder / stem.with_suffix(f"{stem.suffix}{suffix}")
    signal_times(path, run.command.duration, sampling_hz)
    return path


def _driven(plan: Plan, run: Run, times: Array) -> tuple[Names, Array, Names]:
    """Names, values (n_t, n_u) and units of what a run drives, the test's own input first; in the plan's units."""
    signal = run.command.signal()
    driven = {run.input: signal} | {name: signal.times(ratio) for name, ratio in plan.along(run.input).items()}
    units = {name: plan.units.get(name, (plan.sensor(name).signal.unit, 1.0)) for name in driven}
    columns = [command.value(times) / units[name][1] for name, command in driven.items()]
    return tuple(driven), np.column_stack(columns), tuple(unit for unit, _ in units.values())


def _log_name(run: Run, logs: str) -> str:
    stem = PurePosixPath(run.source).with_suffix("")
    return f"{stem}.{logs}"


def _to_come(plan: Plan, logs: str) -> Dataset:
    """The data set of the logs, whose two rows stand for what will be measured."""
    records = []
    for run in plan.runs():
        names = (run.input, *plan.along(run.input), *run.outputs)
        units = tuple(plan.sensor(name).signal.unit for name in names)
        data = Record(np.array([0.0, 1.0]), np.zeros((2, len(names))), names, units)
        numbers = (run.offset, run.amplitude, run.frequency)
        records.append(MeasuredRecord(_log_name(run, logs), run.kind, run.use, data, *numbers, command=run.input))
    signals = tuple(sensor.signal for sensor in plan.sensors)
    return Dataset(plan.name, plan.description, plan.system, signals, tuple(records))


def _csv(times: Array, columns: Array, names: Names, units: Names) -> str:
    heads = ["time [s]", *(f"{name} [{unit}]" for name, unit in zip(names, units, strict=True))]
    form = ",".join(["%.9g"] * (1 + len(names)))
    return "\n".join([",".join(heads), *(form % row for row in zip(times, *columns.T, strict=True))]) + "\n"


def _tdms(times: Array, columns: Array, names: Names, units: Names) -> bytes:
    """Waveforms: LabVIEW finds rate and unit in the properties of each channel."""
    tdms = optional_package("nptdms", "commands are to be written as TDMS", "npTDMS")
    step = float(times[1] - times[0])
    channels = [
        tdms.ChannelObject(
            "command",
            name,
            np.ascontiguousarray(column),
            {"wf_start_offset": 0.0, "wf_increment": step, "wf_samples": int(times.size), "unit_string": unit},
        )
        for name, column, unit in zip(names, columns.T, units, strict=True)
    ]
    buffer = io.BytesIO()
    with tdms.TdmsWriter(buffer) as writer:
        writer.write_segment(channels)
    return buffer.getvalue()


def _generator(times: Array, columns: Array, names: Names, units: Names) -> str:
    """The test's own input between -1 and 1; offset and scale stand in the table."""
    own = columns[:, 0]
    low, high = float(own.min()), float(own.max())
    scaled = (own - 0.5 * (low + high)) / (0.5 * (high - low) or 1.0)
    return "\n".join(f"{value:.7f}" for value in scaled.tolist()) + "\n"


# Form -> suffix of its files, and what they hold
FORMS: Mapping[str, tuple[str, Callable[[Array, Array, Names, Names], str | bytes]]] = MappingProxyType(
    {"csv": (".csv", _csv), "tdms": (".tdms", _tdms), "generator": (".csv", _generator)}
)


def _write(path: Path, content: str | bytes) -> Path:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_file(path, content)
    except OSError as error:
        raise BadInput(f"{path}: cannot write there ({error.strerror or error}); choose another folder") from error
    return path
