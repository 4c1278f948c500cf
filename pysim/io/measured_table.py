"""A measured frequency response that exists as a table."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from pysim.io.response_table import TABLE_COLUMNS, read_response
from pysim.io.text_fields import LEFT_OUT
from pysim.io.toml_section import Section
from pysim.io.units import Scale
from pysim.types import MeasuredRecord, MeasuredSignal, SineTest
from pysim.types.dataset import USES
from pysim.types.record_kind import RESPONSE_TABLE


def read_measured_table(folder: Path, section: Section, signals: Mapping[str, MeasuredSignal]) -> MeasuredRecord:
    """A table; the command's numbers are in the unit of its signal, the gain in those of both.

    Args:
        folder: what its file is relative to.
        section: what dataset.toml says of it.
        signals: by their names, in the units of the files.
    Raises:
        BadInput: what is wrong, with file, line and remedy.
    """
    source = section.source()
    command, output = (_signal_of_role(section, role, tuple(signals.values())) for role in ("input", "output"))
    driven = Scale.of(signals[command].unit)
    swing = section.positive("amplitude") or section.number("amplitude")
    offset, amplitude = driven.number(section.number("offset")), driven.gain * swing
    test = SineTest(offset, amplitude, input=command, output=output)
    use = section.text("use", "fit", among=USES)
    names = section.texts("columns", repeatable=LEFT_OUT)
    if any(name not in names for name in TABLE_COLUMNS):
        raise section.error(f"columns must name {', '.join(TABLE_COLUMNS)}, in the order of the file")
    origin = section.text("origin", f"measured, {source}")
    scale = Scale.of(signals[output].unit).gain / driven.gain
    response = read_response(folder / source, names, test, section.place, scale=scale, origin=origin)
    return MeasuredRecord(source, RESPONSE_TABLE.name, use, response, offset, amplitude, command=command)


def _signal_of_role(section: Section, role: str, signals: tuple[MeasuredSignal, ...]) -> str:
    """The record's own choice, or the only signal of that role."""
    names = tuple(signal.name for signal in signals if signal.role == role)
    if role in section.values:
        return section.text(role, among=names)
    if len(names) != 1:
        raise section.error(
            f'a response needs one {role}, and {len(names)} signals have role = "{role}"; '
            f"give one signal that role, or name it in the record: {role} = ..."
        )
    return names[0]
