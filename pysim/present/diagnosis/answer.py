"""A diagnosis as text for a terminal, and as JSON with its sentences."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Mapping

from pysim.io import shown_value
from pysim.present.diagnosis.law_words import ABSORBED, law_kind
from pysim.present.diagnosis.words import (
    UNIT,
    candidates_shown,
    limits_words,
    next_test_sentence,
    share_text,
    signal_rows,
    size_text,
    sizes,
    step_name,
    verdict_sentence,
)
from pysim.present.notes import listed, words
from pysim.types import Diagnosis, LearnedLaw, answer_data

_WIDTH = 100
_ROWS = 6  # candidates and laws that are listed
_KNOTS = 5  # of a curve that are listed


def diagnosis_data(diagnosis: Diagnosis, files: Mapping[str, str] | None = None) -> dict[str, object]:
    """What `--json` writes: the answer, with the verdict and each note in words too.

    Args:
        files: what was written besides, name -> path relative to the JSON file.
    """
    notes = [{"code": one.code.value, "values": dict(one.values), "text": words(one)} for one in diagnosis.notes]
    return {**answer_data(diagnosis, files), "reason": verdict_sentence(diagnosis), "notes": notes}


def diagnosis_text(diagnosis: Diagnosis, answer: str = "") -> str:
    """The answer, then the evidence.

    Args:
        answer: a sentence or two; the verdict where empty.
    """
    verdict = [f"Verdict: {diagnosis.verdict}", *_wrapped(verdict_sentence(diagnosis), "  ")]
    head = textwrap.wrap(answer, _WIDTH) if answer else verdict
    return "\n".join([*head, "", evidence_text(diagnosis)])


def _wrapped(text: str, indent: str = "") -> list[str]:
    return textwrap.wrap(text, _WIDTH, initial_indent=indent, subsequent_indent="  ")


def evidence_text(diagnosis: Diagnosis) -> str:
    """Sizes, error by step, fit by signal, candidates, laws, ties with the test that would settle them, and notes."""
    parts = [_effects, _history, _signals, _candidates, _detectable, _laws, _open]
    return "\n\n".join("\n".join(lines) for lines in (list(part(diagnosis)) for part in parts) if lines)


def _effects(diagnosis: Diagnosis) -> Iterator[str]:
    if diagnosis.effects:
        yield "Effects, what costs most to leave out first"
    for one in diagnosis.effects:
        share = "" if one.share is None else f"  {share_text(one.share)} of the misfit"
        yield f"  {one.effect.name}{'' if one.effect.class_name else f' at {one.place}'}{share}"
        for name, value, (low, high), unit in sizes(one):
            yield f"    {name} = {value:.4g}{'' if unit == '1' else f' {unit}'}, 95 % from {low:.4g} to {high:.4g}"


def _history(diagnosis: Diagnosis) -> Iterator[str]:
    if diagnosis.history:
        yield f"Residual by step, in {UNIT} (1: noise alone)"
    for step in diagnosis.history:
        values = (("fitted", step.fit), ("held out", step.validate), ("unseen", step.test))
        numbers = "".join(f"  {what} {size_text(value):>7}" for what, value in values if value is not None)
        yield f"  {step_name(step.step):<20}{numbers}  {limits_words(step)}"


def _signals(diagnosis: Diagnosis) -> Iterator[str]:
    rows = signal_rows(diagnosis.history[-1]) if diagnosis.history else []
    if rows:
        yield f"Signals, {step_name(diagnosis.history[-1].step).removeprefix('+ ')}"
    for name, use, residual, percent, rms, unit in rows:
        fit = "" if math.isnan(percent) else f"  fit {percent:.1f} %"
        yield f"  {name:<20}  {use:<8}  {size_text(residual):>7} x noise{fit}  rms {shown_value(rms, unit, '.3g')}"


def _candidates(diagnosis: Diagnosis) -> Iterator[str]:
    rows = candidates_shown(diagnosis)
    rows = [*[r for r in rows if len(r.effects) == 1][:_ROWS], *[r for r in rows if len(r.effects) > 1][:_ROWS]]
    names = [" + ".join(row.effects) for row in rows]
    width = max([24, *map(len, names)])
    if names:
        yield f"{'Candidates':<{width + 2}}  explains  gain less penalty (nats)"
    for name, row in zip(names, rows, strict=True):
        how = "" if row.refitted else "  screened only"
        yield f"  {name:<{width}}  {100 * row.explained:6.1f} %  {row.score:10.4g}{how}"


def _detectable(diagnosis: Diagnosis) -> Iterator[str]:
    """What an answer that names nothing, or not all, could have missed."""
    if diagnosis.detectable:
        yield "These logs would have shown, about from this size on"
    for one in diagnosis.detectable:
        sizes = [f"{name} = {shown_value(size, one.units[name], '.3g')}" for name, size in one.sizes.items()]
        yield f"  {one.effect}: {', '.join(sizes)}"


def _laws(diagnosis: Diagnosis) -> Iterator[str]:
    if not diagnosis.laws:
        return
    yield "Laws learned from the data"
    for law in diagnosis.laws[:_ROWS]:
        formula = f"  {law.formula}" if law.formula else ""
        yield f"  {law.slot}: {law_kind(law)} over {law.argument}, {share_text(law.share)} of the misfit{formula}"
    yield from _curve(diagnosis.laws[0])


def _curve(law: LearnedLaw) -> Iterator[str]:
    """Some of its knots with their intervals."""
    if law.knots.size < 2:
        return
    low, high = law.band
    yield f"  {law_kind(law).capitalize()} at {law.slot}, 95 % intervals"
    for i in sorted({round(k * (law.knots.size - 1) / (_KNOTS - 1)) for k in range(_KNOTS)}):
        at = shown_value(law.knots[i], law.argument_unit, ".3g")
        values = [shown_value(v + 0.0, law.unit, ".3g") for v in (law.coefficients[i], low[i], high[i])]
        yield f"    {law.argument} = {at}: {values[0]} ({values[1]} to {values[2]})"
    if law.absorbed.size:
        yield f"    {ABSORBED}"


def _open(diagnosis: Diagnosis) -> Iterator[str]:
    for group in diagnosis.ties:
        yield from _wrapped(f"These data cannot tell apart: {listed(group)}.")
    if diagnosis.next_test is not None:
        yield from _wrapped(f"Next test: {next_test_sentence(diagnosis.next_test)}")
    for note in diagnosis.notes:
        yield from _wrapped(f"Note: {words(note)}")
