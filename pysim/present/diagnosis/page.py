"""A diagnosis as a self-contained page: the verdict and the falling error first, then the evidence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pysim.identify.accuracy import FREQUENCY_CRITERIA, TIME_CRITERIA
from pysim.present.diagnosis.words import (
    chance_text,
    limits_words,
    next_test_sentence,
    remark,
    share_text,
    sizes,
    verdict_sentence,
)
from pysim.present.notes import direction_words, listed, words
from pysim.present.page import cell, commands, heading, items, page, paragraph, picture, statement, table
from pysim.types import AddedEffect, Candidate, Diagnosis, Estimate, LedgerStep, Missing, Stage

# Section of the page -> SVG by caption.
Pictures = Mapping[str, Mapping[str, bytes]]

_CRITERIA = (*FREQUENCY_CRITERIA, *TIME_CRITERIA)
_WORST = 15  # places listed


def diagnosis_page(
    diagnosis: Diagnosis,
    *,
    title: str,
    pictures: Pictures,
    redo: str,
    files: Mapping[str, str] | None = None,
    question: str = "Which effect is missing?",
    answer: str = "",
) -> str:
    """Verdict, error ledger, what was added, records, where it fails, ranking, parameters, next test, conditions.

    Args:
        title: model and data, for the line below the heading.
        pictures: by section: "ledger", "records", "where", "missing", "ranking", "parameters".
        redo: the command line that makes it again.
        files: what was written besides, name -> path relative to the page.
        question, answer: the heading, and what leads the page; the verdict where empty.
    """
    parts = [statement(answer or verdict_sentence(diagnosis)), *_drawn(pictures, "ledger")]
    parts += _added(diagnosis.added)
    parts += _section("Measured and simulated", _drawn(pictures, "records"))
    parts += _section(f"Where the {_base(diagnosis)} fails", [*_drawn(pictures, "where"), _where(diagnosis)])
    if diagnosis.missing:
        parts += _section("What is missing, and where", [*_drawn(pictures, "missing"), _missing(diagnosis.missing)])
    if diagnosis.ranking:
        parts += _section("Candidates", [*_drawn(pictures, "ranking"), *_ranking(diagnosis)])
    parts += _section("Parameters before and after", [*_drawn(pictures, "parameters"), *_parameters(diagnosis)])
    if diagnosis.next_test is not None:
        test = diagnosis.next_test
        told = paragraph(next_test_sentence(test))
        parts += _section("The next test", [told, *([commands(test.plan)] if test.plan else [])])
    parts += _section("The error, step by step", [_ledger(diagnosis.error)])
    if diagnosis.notes:
        parts += _section("What to bear in mind", [items(map(words, diagnosis.notes))])
    conditions = {**diagnosis.conditions, **{f"time for {k}": f"{v:.1f} s" for k, v in diagnosis.seconds.items()}}
    lines = [f"{name}: {text}" for name, text in conditions.items()]
    if files:
        lines.append("files beside this page: " + ", ".join(files.values()))
    parts += _section("Conditions", [items(lines), paragraph(_METHOD)])
    parts += _section("Do it again", [commands(redo)])
    return page(question, title, parts)


_METHOD = (
    "Residuals are measured minus simulated, in standard deviations of the noise: where nothing but noise is left "
    "their root mean square is 1. A candidate's gain is the fall of the sum of squares once everything is refitted "
    "with it; its penalty is the logarithm of the number of residuals for each of its parameters. Intervals are to "
    "first order, widened by the residual where the model does not fit to the noise. Records held out had no part in "
    "any fit."
)


def _base(diagnosis: Diagnosis) -> str:
    return "refitted model" if any(stage.step == "refit" for stage in diagnosis.stages) else "model as it is"


def _section(title: str, parts: Sequence[str]) -> list[str]:
    """With its heading; nothing where there is nothing to show."""
    shown = [part for part in parts if part]
    return [heading(title), *shown] if shown else []


def _drawn(pictures: Pictures, section: str) -> list[str]:
    return [picture(svg, caption) for caption, svg in pictures.get(section, {}).items()]


def _added(added: Sequence[AddedEffect]) -> list[str]:
    if not added:
        return []
    parts = [heading("What was added" if len(added) > 1 else f"What was added: {added[0].effect.name}")]
    rows = []
    for one in added:
        effect = one.effect
        parts.append(paragraph(f"{effect.description}. Class {effect.class_name}, in the slot {effect.slot}."))
        parts += [commands(effect.law)] if effect.law else []
        for name, value, (low, high), unit in sizes(one):
            texts = (f"{value:.5g}", f"{low:.5g}", f"{high:.5g}")
            rows.append([cell(effect.name, "words"), cell(name), *(cell(t) for t in texts), cell(unit)])
    head = ["effect", "parameter", "value", "95 % from", "to", "unit"]
    return [*parts, table("Sizes that the measurements give", head, rows)]


def _where(diagnosis: Diagnosis) -> str:
    last = _last(diagnosis)
    after = {(f.record, f.signal, f.region): f.error for f in last.where} if last else {}
    rows = []
    for f in diagnosis.where[:_WORST]:
        end = after.get((f.record, f.signal, f.region))
        kind = "beyond" if f.error > 1.5 else ""
        numbers = [cell(f"{f.error:.2f}", kind), *([cell("" if end is None else f"{end:.2f}")] if last else [])]
        rows.append([*(cell(text, "words") for text in (f.record, f.signal, f.region)), *numbers])
    head = ["record", "signal", "region", "before" if last else "error", *(["at the end"] if last else [])]
    return table("Root-mean-square residual over noise, the worst places first", head, rows) if rows else ""


def _missing(missing: Sequence[Missing]) -> str:
    rows = [
        [cell(m.slot), cell(share_text(m.share)), cell(m.depends_on), cell(m.formula or "none found", "words")]
        for m in missing
    ]
    head = ["place", "of the misfit", "depends on", "formula"]
    return table("The best term at each place, estimated without naming an effect", head, rows)


def _ranking(diagnosis: Diagnosis) -> list[str]:
    texts = [f"Indistinguishable with these data: {', '.join(group)}." for group in diagnosis.confusable]
    several = len({row.round for row in diagnosis.ranking}) > 1
    rows = [[*([cell(f"{row.round}")] if several else []), *_candidate(row)] for row in diagnosis.ranking]
    head = [
        *(["round"] if several else []),
        "effect",
        "gain less penalty",
        "of the misfit",
        "by chance",
        "how",
        "sizes there",
    ]
    return [*(paragraph(text, note=True) for text in texts), table("Every candidate that was considered", head, rows)]


def _candidate(row: Candidate) -> list[str]:
    sizes_there = ", ".join(f"{name} {value:.4g}" for name, value in row.parameters.items())
    how = "refitted" if row.refitted else "screened only"
    texts = (f"{row.score:,.1f}", share_text(row.explained), chance_text(row.p_value))
    return [cell(row.effect, "words"), *(cell(t) for t in texts), cell(how), cell(sizes_there, "words")]


def _parameters(diagnosis: Diagnosis) -> list[str]:
    base = next((s for s in diagnosis.stages if s.step == "refit"), None)
    last = _last(diagnosis)
    if base is None:
        return []
    moves = {} if last is None else last.moves_from(base)
    bent = [name for name, move in moves.items() if move is not None and move > 1]
    pushed = f"Without the effect, the fit had pushed {listed(bent)} to wrong values." if bent else ""
    ends = {} if last is None else {e.name: e for e in last.estimates}
    held = {next(iter(d.exponents)) for d in (base if last is None else last).undetermined}
    rows = [_parameter(e, ends.pop(e.name, None), moves.get(e.name), e.name in held) for e in base.estimates]
    head = ["parameter", "unit", "as it is", "refitted", "95 % from", "to"]
    head += ["at the end", "95 % from", "to", "moved by", ""] if last else [""]
    scale = [direction_words(d) for d in (base if last is None else last).undetermined]
    if last is not None and scale:
        scale.append("Moves are counted once both are brought to the same value of the parameter that is held.")
    caption = "Fitted parameters; moves in half widths of the interval at the end"
    return [paragraph(pushed) if pushed else "", table(caption, head, rows), *(paragraph(text) for text in scale)]


def _parameter(before: Estimate, after: Estimate | None, move: float | None, held: bool) -> list[str]:
    told = [cell(before.name), cell(before.unit), cell(f"{before.start:.5g}")]
    told += [cell(f"{v:.5g}") for v in (before.value, *before.interval)]
    if after is not None:
        told += [cell(f"{v:.5g}") for v in (after.value, *after.interval)]
        moved = "" if move is None else f"{move:.1f}"
        told.append(cell(moved, "beyond" if move is not None and move > 1 else ""))
    return [*told, cell(remark(after or before, held=held), "words")]


def _ledger(steps: Sequence[LedgerStep]) -> str:
    shown = [c for c in _CRITERIA if any(c.symbol in step.criteria for step in steps)]
    rows = []
    for step in steps:
        numbers = [cell("" if v is None else f"{v:.3f}") for v in (step.fit, step.validate)]
        for criterion in shown:
            value = step.criteria.get(criterion.symbol)
            kind = "" if value is None or value <= criterion.limit else "beyond"
            numbers.append(cell("" if value is None else f"{value:.3g}", kind))
        kind = "" if not (step.criteria or step.not_simulated) else "pass" if step.passes else "fail"
        verdict = cell(limits_words(step), kind)
        rows.append([cell(step.step, "words"), *numbers, cell(f"{step.cost:.6g}"), verdict])
    head = ["step", "fitted", "held out", *(f"{c.name} ({c.unit}, limit {c.limit:g})" for c in shown)]
    caption = "Residual over noise; worst value of each criterion of thesis Tables 1.3 and 1.4; sum of squares"
    return table(caption, [*head, "sum", "limits"], rows)


def _last(diagnosis: Diagnosis) -> Stage | None:
    """The model at the end, where anything was added."""
    return diagnosis.stages[-1] if diagnosis.added and diagnosis.stages else None
