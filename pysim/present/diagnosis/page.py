"""A diagnosis as a self-contained page: the verdict and the falling error first, then the evidence."""

from __future__ import annotations

import math
from collections.abc import Sequence

from pysim.io import shown_value
from pysim.present.criteria import CRITERIA
from pysim.present.diagnosis.answer import Diagnosed, files
from pysim.present.diagnosis.law_words import formula_text, law_kind, law_sentence
from pysim.present.diagnosis.words import (
    BEYOND,
    LEFT_OUT,
    called,
    candidates_shown,
    chance_text,
    found_name,
    last_name,
    limits_words,
    next_test_sentence,
    share_text,
    signal_rows,
    size_text,
    sizes,
    step_name,
    verdict_sentence,
)
from pysim.present.notes import USES, direction_words, estimate_words, listed, sentences
from pysim.present.page import cell, commands, heading, items, paragraph, pictures, statement, table
from pysim.present.page import page as whole_page
from pysim.present.plain_text import with_interval
from pysim.present.render import Drawing
from pysim.types import Diagnosis, ErrorStep, Estimate, FoundEffect
from pysim.types.answer import REFIT

_WORST = 15  # places listed
_METHOD = (
    "Residuals are measured minus simulated, in standard deviations of the noise: where nothing but noise is left "
    "their root mean square is 1. The fit in percent is 100 where the model is the log, and 0 where it is no better "
    "than the log's mean. A candidate's gain is the rise of the log likelihood in nats once everything is refitted "
    "with it, less a penalty for its parameters. Logs used to choose had no part in any fit. "
    "Held-out logs had no part in the choice either."
)


def page(result: Diagnosed, drawings: Sequence[Drawing], redo: str) -> str:
    """The verdict and the error, what was added or learned, then the evidence and the conditions."""
    diagnosis = result.found

    def section(name: str, title: str, *more: str) -> list[str]:
        """Pictures and what stands below them; nothing where there is nothing to show."""
        drawn = pictures(one for one in drawings if name and one.section == name)
        shown = [part for part in (*drawn, *more) if part]
        return [*([heading(title)] if title else []), *shown] if shown else []

    refitted = diagnosis.base is not None and diagnosis.base.step == REFIT
    test, history = diagnosis.next_test, diagnosis.history
    parts = [statement(result.answer or verdict_sentence(diagnosis)), *section("error", "", _history(history))]
    parts += _effects(diagnosis.effects)
    parts += section("learned", "What the data say of the missing law", *_laws(diagnosis))
    parts += section("records", "Measured and simulated", _signals(diagnosis) if history else "")
    parts += section(
        "where", f"Where the {'refitted model' if refitted else 'model as it is'} fails", _where(diagnosis)
    )
    parts += section("candidates", "Candidates", *_candidates(diagnosis))
    parts += section("parameters", "Parameters before and after", *_parameters(diagnosis))
    if test is not None:
        parts += section(
            "", "The next test", paragraph(next_test_sentence(test)), commands(test.plan) if test.plan else ""
        )
    if diagnosis.notes:
        parts += section("", "What to bear in mind", items(sentences(diagnosis.notes)))
    conditions = {**diagnosis.conditions, **{f"time for {k}": f"{v:.1f} s" for k, v in diagnosis.seconds.items()}}
    lines = [f"{name}: {text}" for name, text in conditions.items()]
    beside = [*result.files.values(), *files(result)]
    lines += [f"files beside this page: {', '.join(beside)}"] if beside else []
    parts += section("", "Conditions", items(lines), paragraph(_METHOD))
    return whole_page(result.question, result.title, parts, redo)


def _effects(effects: Sequence[FoundEffect]) -> list[str]:
    if not effects:
        return []
    parts = [heading("What was added" if len(effects) > 1 else f"What was added: {found_name(effects[0])}")]
    rows = []
    for one in effects:
        effect = one.effect
        if effect.class_name:
            place = f"Class {effect.class_name}, in the slot {effect.slot}."
            parts.append(paragraph(". ".join(filter(None, [effect.description, place]))))
        parts += [commands(effect.law)] if effect.law else []
        for name, value, ends, unit in sizes(one):
            texts = with_interval(value, ends)
            rows.append([found_name(one), name, *texts, unit, "" if one.share is None else share_text(one.share)])
    head = ["effect", "parameter", "value", "95 % from", "to", "unit", f"{LEFT_OUT}, of the misfit"]
    return [*parts, table("Sizes that the measurements give", head, rows, words=[0])]


def _laws(diagnosis: Diagnosis) -> list[str]:
    if not diagnosis.laws:
        return []
    rows = []
    for one in diagnosis.laws:
        formula = formula_text(one.formula, str(one.factor), one.unit) or "none found"
        rows.append([one.slot, law_kind(one), one.argument, share_text(one.share), formula])
    head = ["place", "what", "depends on", "of the misfit", "formula"]
    classes = [law.modelica for law in diagnosis.likeliest if law.modelica]
    said = map(paragraph, map(law_sentence, diagnosis.likeliest))
    return [*said, table("The best law at each place", head, rows, words=[1, 4]), *map(commands, classes)]


def _signals(diagnosis: Diagnosis) -> str:
    rows = [
        [name, use, cell(size_text(residual), "beyond" if residual > BEYOND else ""),
         "" if math.isnan(percent) else f"{percent:.1f}", shown_value(rms, unit, ".3g")]
        for name, use, residual, percent, rms, unit in signal_rows(diagnosis.history[-1].records)
    ]  # fmt: skip
    head = ["signal", "logs", "residual over noise", "fit (%)", "rms residual"]
    return table(f"Signals of the model {last_name(diagnosis)}", head, rows, words=[0]) if rows else ""


def _where(diagnosis: Diagnosis) -> str:
    last = diagnosis.last
    after = {(f.record, f.signal, f.region): f.error for f in last.failures} if last else {}
    rows = []
    for f in diagnosis.failures[:_WORST]:
        end = after.get((f.record, f.signal, f.region))
        at_the_end = ["" if end is None else size_text(end)] if last else []
        rows.append(
            [f.record, f.signal, f.region, cell(size_text(f.error), "beyond" * (f.error > BEYOND)), *at_the_end]
        )
    head = ["record", "signal", "region", "before" if last else "residual", *(["at the end"] if last else [])]
    return table("Residual over noise, the worst places first", head, rows, words=range(3)) if rows else ""


def _candidates(diagnosis: Diagnosis) -> list[str]:
    if not diagnosis.rivals:
        return []
    texts = [f"These data cannot tell apart: {listed([*map(called, group)])}." for group in diagnosis.ties]
    share = "adding the last explains, of the misfit"
    head = ["effects", share, "gain less penalty (nats)", "by chance", "how", "sizes there"]
    rows = []
    for row in candidates_shown(diagnosis):
        sizes_there = ", ".join(f"{name} {value:.4g}" for name, value in row.parameters.items())
        numbers = (share_text(row.explained), f"{row.score:,.1f}", chance_text(row.p_value))
        rows.append([called(*row.effects), *numbers, "refitted" if row.refitted else "estimated", sizes_there])
    caption = "Candidates beside the base model, and what improves a model with effects"
    return [*(paragraph(text, note=True) for text in texts), table(caption, head, rows, words=[0, 5])]


def _parameters(diagnosis: Diagnosis) -> list[str]:
    base, last = diagnosis.base, diagnosis.last
    if base is None or base.step != REFIT:
        return []
    moves = {} if last is None else last.moves_from(base)
    biased = [name for name, move in moves.items() if move is not None and move > 1]
    wrong = f"Without what was added, the fit was wrong about {listed(biased)}." if biased else ""
    ends = {} if last is None else {e.name: e for e in last.estimates}
    open_ = (base if last is None else last).undetermined
    held = {next(iter(d.exponents)) for d in open_}
    rows = [_parameter(e, ends.get(e.name), moves.get(e.name), e.name in held) for e in base.estimates]
    head = ["parameter", "unit", "as it is", "refitted", "95 % from", "to"]
    head += ["at the end", "95 % from", "to", "moved by", ""] if last else [""]
    shown = table("Fitted parameters; moves in half widths of their 95 % intervals", head, rows, words=[len(head) - 1])
    return [paragraph(wrong) if wrong else "", shown, *(paragraph(direction_words(d)) for d in open_)]


def _parameter(before: Estimate, after: Estimate | None, move: float | None, held: bool) -> list[str]:
    cells = [before.name, before.unit, f"{before.start:.5g}", *with_interval(before.value, before.interval)]
    if after is not None:
        cells += with_interval(after.value, after.interval)
        cells.append(cell("" if move is None else f"{move:.1f}", "beyond" if move is not None and move > 1 else ""))
    return [*cells, estimate_words(after or before, held=held)]


def _history(steps: Sequence[ErrorStep]) -> str:
    shown = [c for c in CRITERIA.values() if any(c.symbol in step.criteria for step in steps)]
    unseen, judged = any(step.test is not None for step in steps), any(map(limits_words, steps))
    rows = []
    for step in steps:
        values = (step.fit, step.validate, *((step.test,) if unseen else ()))
        numbers = ["" if v is None else size_text(v) for v in values]
        for criterion in shown:
            value = step.criteria.get(criterion.symbol)
            kind = "" if value is None or value <= criterion.limit else "beyond"
            numbers.append(cell("" if value is None else f"{value:.3g}", kind))
        verdict = cell(limits_words(step), "pass" if step.passes else "fail")
        rows.append([step_name(step.step), *numbers, *([verdict] if judged else [])])
    head = ["model", *[*USES.values()][: 3 if unseen else 2]]
    head += [f"{c.name} ({c.unit}, limit {c.limit:g})" for c in shown]
    caption = f"Residual over noise (1: noise alone){'; worst value of each criterion' if shown else ''}"
    return table(caption, [*head, *["limits"] * judged], rows, words=[0]) if rows else ""
