"""What a data set holds, as text, as JSON and as a page."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

from pysim.identify.data_check import DataCheck, RecordCheck
from pysim.io import counted, shown_point, toml_key
from pysim.io.prepare import call, typed
from pysim.present.data_check.words import assumed_between_samples, cures, not_compared, sentence
from pysim.present.notes import USES
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing

UNTOLD = "-"  # a description or a system that dataset.toml leaves out
_WIDTH = 100
_SHOWN = 20  # warnings in the terminal; all of them stand in JSON and report


def text(check: DataCheck) -> str:
    """Signals, records by kind and operating point, and warnings."""
    dataset = check.dataset
    system = "" if dataset.system == UNTOLD else f" (system {dataset.system})"
    about = "" if dataset.description == UNTOLD else f": {dataset.description}"
    lines = [f"{dataset.name}{system}{about}", "signals"]
    width = max(len(signal.name) for signal in dataset.signals)
    for signal, words in zip(dataset.signals, signals_in_words(check), strict=True):
        _, role, unit, quantity, variable, *rest = words
        told = [quantity] if quantity not in ("", signal.name) else []
        told += [f"{variable} in the model"] if variable != signal.name else []
        lines.append(f"  {signal.name:<{width}}  {', '.join([role, unit, *told, *rest])}")
    for kind, records in _by_kind(check).items():
        lines += [f"{kind}: {len(records)}", *(f"  {line}" for line in _points(records))]
    return "\n".join([*lines, *warnings_in_words(check)])


def warnings_in_words(check: DataCheck) -> list[str]:
    """Every finding, twenty at most, what to type to cure them, and what is assumed of inputs between samples."""
    found = check.findings
    lines = [counted(len(found), "warning") + (":" if found else ", ready to use")]
    for one in found[:_SHOWN]:
        shown = f"{one.source}: {sentence(one)}"
        lines += textwrap.wrap(shown, _WIDTH, initial_indent="  ", subsequent_indent="    ")
    if len(found) > _SHOWN:
        lines.append(f"  and {len(found) - _SHOWN} more")
    steps = cures(found)
    if steps:
        lines.append("to cure, in Python or with `pysim data prepare`:")
        width = max(len(call(step)) for step in steps)
        lines += [f"  data = data.{call(step):<{width}}  # --step {typed(step)}" for step in steps]
    for told in not_compared(check.dataset):
        lines += textwrap.wrap(told, _WIDTH)
    for name, told in assumed_between_samples(check.dataset):
        typed_in = f'load(..., hold={{"{name}": "zero"}}), or hold = "zero" below [signals.{toml_key(name)}]'
        lines += textwrap.wrap(f'{told} Say what it was: {typed_in}; "linear" or "spline" if it was not held.', _WIDTH)
    return lines


def data(check: DataCheck) -> dict[str, Any]:
    """Everything for JSON; SI units or %."""
    dataset = check.dataset
    about = {"name": dataset.name, "description": dataset.description, "system": dataset.system}
    keys = ("name", "role", "unit", "quantity", "variable", "noise", "resolution")
    return {
        **about,
        "units": "SI",
        "signals": [{key: getattr(signal, key) for key in keys} for signal in dataset.signals],
        "records": [_record(record) for record in check.records],
        "warnings": len(check.findings),
        "cures": [typed(step) for step in cures(check.findings)],
    }


def signals_in_words(check: DataCheck) -> list[list[str]]:
    """Name, role, unit, quantity, variable, noise and resolution of every signal, in words."""
    rows = []
    for signal in check.dataset.signals:
        unit = "" if signal.unit == "1" else signal.unit
        noise, step = (
            f"no {what} specified" if value is None else f"{what} {value:.3g} {unit}".rstrip()
            for what, value in (("noise", signal.noise), ("resolution", signal.resolution))
        )
        rows.append([signal.name, signal.role, signal.unit, signal.quantity, signal.variable, noise, step])
    return rows


def _by_kind(check: DataCheck) -> dict[str, list[RecordCheck]]:
    kinds: dict[str, list[RecordCheck]] = {}
    for record in check.records:
        kinds.setdefault(record.kind, []).append(record)
    return kinds


def _points(records: list[RecordCheck]) -> list[str]:
    """A line per operating point of stepped sines, and one per other record."""
    lines = []
    groups: dict[tuple[str, float, float], list[RecordCheck]] = {}
    for record in records:
        if record.frequency is not None:
            groups.setdefault((record.command, record.offset or 0.0, record.amplitude or 0.0), []).append(record)
    several = several_inputs(records)
    for (command, offset, amplitude), members in groups.items():
        frequencies = ", ".join(f"{f:g}" for f in sorted(r.frequency for r in members if r.frequency is not None))
        point = shown_point(offset, amplitude, members[0].unit, command if several else "")
        lines.append(f"{point}: {frequencies} Hz; {_times(members)}")
    lines += [f"{record.source}: {_times([record])}" for record in records if record.frequency is None]
    return [part for line in lines for part in textwrap.wrap(line, _WIDTH, subsequent_indent="    ")]


def several_inputs(records: Sequence[RecordCheck]) -> bool:
    """Whether offsets and amplitudes are not all of the same input."""
    return len({record.command for record in records if record.offset is not None or record.amplitude is not None}) > 1


def _times(records: list[RecordCheck]) -> str:
    """Durations, rates, signals and use of some records."""
    use = ", ".join(dict.fromkeys(USES[record.use] for record in records))
    signals = "; ".join(dict.fromkeys(", ".join(record.signals) for record in records))
    clocks = [record.clock for record in records if record.clock]
    if not clocks:
        return f"{sum(record.rows for record in records)} rows; {signals}; {use}"
    jitter = max(base.jitter for base in clocks)
    uneven = f" (jitter {100 * jitter:.2g} %)" if jitter > 1e-4 else ""
    return (
        f"{_span([base.duration for base in clocks])} s at {_span([base.rate for base in clocks])} Hz{uneven}; "
        f"{signals}; {use}"
    )


def _span(values: list[float]) -> str:
    low, high = (f"{value:.4g}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def _record(record: RecordCheck) -> dict[str, Any]:
    base = record.clock
    keys = ("source", "kind", "use", "rows", "offset", "amplitude", "unit", "frequency")
    about: dict[str, Any] = {key: getattr(record, key) for key in keys}
    about |= {
        "input": record.command,
        "signals": list(record.signals),
        "warnings": [sentence(found) for found in record.findings],
        "clock": None,
    }
    if base is not None:
        gaps = [{"after_s": start, "length_s": length} for start, length in base.gaps]
        about["clock"] = {"start_s": base.start, "duration_s": base.duration, "rate_hz": base.rate}
        about["clock"] |= {"jitter": base.jitter, "gaps": gaps}
    return about


def page(check: DataCheck, drawings: Sequence[Drawing], redo: str) -> str:
    """What stands out, signals, pictures and a row per record."""
    warnings = [f"{found.source}: {sentence(found)}" for found in check.findings]
    found = "One warning." if len(warnings) == 1 else f"{len(warnings)} warnings."
    verdict = found if warnings else "Nothing stands out; the data set is ready to use."
    parts = [heading("Verdict"), paragraph(f"{len(check.records)} records were read. {verdict}", note=bool(warnings))]
    parts.append(items(warnings))
    rows = [
        [cell(words[0], "words"), *(cell(word, "words") for word in words[1:])] for words in signals_in_words(check)
    ]
    head = ["", "role", "unit", "quantity", "model variable", "noise", "resolution"]
    parts += [heading("Signals"), table("In SI units or %", head, rows)]
    parts += [heading("Pictures"), *pictures(drawings)]
    several = several_inputs(check.records)
    head = ["file", "kind", "use", "rows", "duration s", "rate Hz", "jitter %", *(["input"] if several else [])]
    head += ["offset", "amplitude", "Hz", "warnings"]
    body = [_cells(record, several) for record in check.records]
    parts += [heading("Records"), table("Offset and amplitude in the input's SI unit or %", head, body)]
    told = {
        check.dataset.description: check.dataset.description,
        check.dataset.system: f"system {check.dataset.system}",
    }
    about = "; ".join(words for text, words in told.items() if text != UNTOLD)
    return whole_page(f"Data set {check.dataset.name}", f"{about}." if about else "", parts, redo)


def _cells(record: RecordCheck, several: bool) -> list[str]:
    """Cells of the table of records, the input among them where there are several."""
    base = record.clock
    clock = ["-", "-", "-"]
    if base is not None:
        clock = [f"{base.duration:.4g}", f"{base.rate:.4g}", f"{100 * base.jitter:.2g}"]
    told = [record.command or "-"] if several else []
    told += ["-" if v is None else f"{v:g}" for v in (record.offset, record.amplitude, record.frequency)]
    count = len(record.findings)
    words = [record.source, record.kind, USES[record.use], str(record.rows), *clock, *told]
    return [*(cell(word) for word in words), cell(str(count), "beyond" if count else "")]
