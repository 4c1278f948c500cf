"""The page of what a data set holds."""

from __future__ import annotations

from collections.abc import Sequence

from pysim.identify.data_check import DataCheck, RecordCheck
from pysim.present.data_check.answer import UNTOLD, several_inputs, signals_in_words
from pysim.present.data_check.words import sentence
from pysim.present.notes import USES
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing


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
    body = [_row(record, several) for record in check.records]
    parts += [heading("Records"), table("Offset and amplitude in the input's SI unit or %", head, body)]
    told = {
        check.dataset.description: check.dataset.description,
        check.dataset.system: f"system {check.dataset.system}",
    }
    about = "; ".join(words for text, words in told.items() if text != UNTOLD)
    return whole_page(f"Data set {check.dataset.name}", f"{about}." if about else "", parts, redo)


def _row(record: RecordCheck, several: bool) -> list[str]:
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
