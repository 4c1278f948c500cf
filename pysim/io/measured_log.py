"""A log over time as a record in SI units."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from pysim.io.columns import TIME, Columns, names_its_columns, read_columns, refuse_standing_time
from pysim.io.text_fields import LEFT_OUT
from pysim.io.toml_section import Section
from pysim.io.units import Scale
from pysim.types import BadInput, MeasuredRecord, MeasuredSignal, Record, sampling
from pysim.types.dataset import INITIAL, USES
from pysim.types.record_kind import KINDS, STEPPED_SINE

_ROUNDING = 1e-6  # of a sampling rate, even where its times are printed with all digits


def read_log(
    folder: Path,
    section: Section,
    kind: str,
    signals: Mapping[str, MeasuredSignal],
    scales: Mapping[str, Scale],
    second: float = 1.0,
) -> MeasuredRecord:
    """One log.

    Args:
        folder: what its file is relative to.
        section: what dataset.toml says of it.
        kind: of a log over time, see `pysim.types.KINDS`.
        signals: by their names, in the units of the files.
        scales: of their columns.
        second: how many s the unit of its times is.
    Returns:
        with not-a-number for empty cells.
    Raises:
        BadInput: what is wrong, with file, line and remedy.
    """
    source, all_names = section.source(), section.texts("columns", repeatable=LEFT_OUT)
    names = tuple(name for name in all_names if name != LEFT_OUT)
    _check_columns(section, source, names, signals)
    command = _command(section, names, signals)
    use = section.text("use", "fit", among=USES)
    test = _test(section, kind, Scale.of(signals[command].unit if command else "1"))
    clock = _clock(section, source, names)
    columns = read_columns(folder / source, all_names, section.place, clock=clock, missing=True).in_seconds(
        TIME, second
    )
    refuse_standing_time(columns)
    if test[2] is not None:
        refuse_fast_sine(section.place, columns, test[2])
    origin = section.text("origin", f"measured, {source}")
    initial = section.text("initial", among=INITIAL) if "initial" in section.values else None
    data = in_si(columns, scales, origin)
    return MeasuredRecord(
        source, kind, use, data, *test, command=command or "", initial=initial, begin=section.moment("begin")
    )


def in_si(columns: Columns, scales: Mapping[str, Scale], origin: str) -> Record:
    """The columns beside time as a record, each in the SI unit of its signal.

    Args:
        scales: of every column.
    Raises:
        BadInput: a single row.
    """
    if columns.values.shape[0] < 2:
        raise BadInput(f"{columns.place(0)}: the log holds a single row; a record over time needs two or more")
    names = tuple(name for name in columns.names if name != TIME)
    own = [scales[name] for name in names]
    order = [columns.names.index(name) for name in names]
    values = columns.values[:, order]  # a copy
    values *= np.array([scale.gain for scale in own])
    zeros = np.array([scale.zero for scale in own])
    if zeros.any():
        values += zeros
    return Record(columns[TIME], values, names, tuple(scale.unit for scale in own), origin=origin)


def refuse_fast_sine(place: str, columns: Columns, frequency: float) -> None:
    """A sine above half the sampling rate looks like another one, and one at half of it may be sampled at its zeros.

    Args:
        place: what says that it is this frequency, for the message.
        frequency: Hz.
    Raises:
        BadInput: it is not below.
    """
    if columns.values.shape[0] < 2:
        return
    found = sampling(columns[TIME])
    rate = 1 / found.step
    if frequency > 0.5 * rate * (1 - max(_ROUNDING, found.digit / float(np.ptp(columns[TIME])))):
        ms = ', or tell that time is in ms: [dataset] time_unit = "ms"' if frequency <= 500 * rate < 500 else ""
        raise BadInput(
            f"{place}: frequency = {frequency:g} Hz is not below half the sampling rate of {columns.path}, "
            f"{rate:.4g} Hz; correct the frequency, or log faster{ms}"
        )


def _check_columns(
    section: Section, source: str, names: tuple[str, ...], signals: Mapping[str, MeasuredSignal]
) -> None:
    """Time, at least one input and one output, and nothing that has no signal."""
    if TIME not in names:
        cure = "name the column that holds it in s"
        if names_its_columns(Path(source)):
            cure = f'write "{TIME}" for the clock there, and {TIME} = "..." for what the file calls it'
        raise section.error(f'columns names no "{TIME}"; {cure}')
    for name in names:
        if name != TIME and name not in signals:
            raise section.error(
                f"the column {name!r} is no signal; add [signals.{name}] with role and unit, "
                f"or correct the name to one of {', '.join((TIME, *signals))}"
            )
    for role in ("input", "output"):
        if not any(signals[name].role == role for name in names if name != TIME):
            raise section.error(
                f'none of the columns {", ".join(names)} is an {role}; log one too, or give its signal role = "{role}"'
            )


def _clock(section: Section, source: str, names: tuple[str, ...]) -> str:
    """What the file calls its time."""
    clock = section.text(TIME, TIME)
    if TIME in section.values and not names_its_columns(Path(source)):
        raise section.error(
            f"{TIME} = {clock!r} means nothing where columns go by their order, as in {source}; "
            f'remove it, and write "{TIME}" in its place in columns'
        )
    if clock != TIME and clock in names:
        raise section.error(f'columns names {clock!r} beside "{TIME}", which is the same; remove the one or the other')
    return clock


def _command(section: Section, names: tuple[str, ...], signals: Mapping[str, MeasuredSignal]) -> str | None:
    """The input that offset and amplitude speak of; None where the record says nothing of them."""
    inputs = tuple(name for name in names if name != TIME and signals[name].role == "input")
    if "input" in section.values:
        return section.text("input", among=inputs)
    if len(inputs) > 1 and any(key in section.values for key in ("offset", "amplitude")):
        raise section.error(f"offset and amplitude of which input, {' or '.join(inputs)}? Say it: input = ...")
    return inputs[0] if len(inputs) == 1 else None


def _test(section: Section, kind: str, scale: Scale) -> tuple[float | None, float | None, float | None]:
    """Offset and amplitude in SI units or %, and the frequency in Hz, as far as stated."""
    for key in KINDS[kind].needs:
        if key not in section.values:
            raise section.error(f'{key} is missing, and kind = "{kind}" needs it; write {key} = a number')
    if "frequency" in section.values and kind != STEPPED_SINE.name:
        raise section.error(
            f'frequency belongs to kind = "{STEPPED_SINE.name}", and this is "{kind}"; remove it, or correct the kind'
        )
    offset, amplitude = section.optional_number("offset"), section.positive("amplitude")
    offset = None if offset is None else scale.number(offset)
    return offset, None if amplitude is None else scale.gain * amplitude, section.positive("frequency")
