"""A diagnosis, or one of its steps, as a command shows it: text for a terminal, JSON with its sentences, and files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path, PurePath, PurePosixPath

from pysim.identify.greybox import step_warnings
from pysim.io import shown_value
from pysim.io.load.sources import seen_from_shared
from pysim.present.diagnosis.law_words import ABSORBED, formula_text, law_kind
from pysim.present.diagnosis.words import (
    LEFT_OUT,
    QUESTIONS,
    UNIT,
    called,
    candidates_shown,
    errors,
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
    verdict_words,
)
from pysim.present.notes import listed, sentences, words
from pysim.present.plain_text import with_interval, wrapped
from pysim.types import Dataset, Diagnosis, LearnedLaw, answer_data
from pysim.types.answer import PRIOR

_ROWS = 6  # candidates and laws that are listed
_KNOTS = 5  # of a curve that are listed


@dataclass(frozen=True)
class Diagnosed:
    """What was found, and what leads the page.

    Args:
        dataset: of which the records are; None where only the answer is at hand.
        title: model and data, for the line below the heading.
        question: the heading.
        answer: a sentence or two; the verdict where empty.
        files: what lies beside the page, name -> path relative to it, or to the JSON file once all is placed.
    """

    found: Diagnosis
    dataset: Dataset | None = None
    title: str = ""
    question: str = "Which effect is missing?"
    answer: str = ""
    files: Mapping[str, str] = field(default_factory=dict)


def whole(result: Diagnosis | Diagnosed) -> Diagnosed:
    """An answer with its question."""
    if isinstance(result, Diagnosed):
        return result
    names = [result.conditions[key] for key in ("model", "data set") if key in result.conditions]
    return Diagnosed(result, title=", ".join(names))


def answered(
    step: str, found: Diagnosis, dataset: Dataset, model: str, files: Mapping[str, str] | None = None
) -> Diagnosed:
    """What a step of the diagnosis found, as the answer to what that step asks.

    Args:
        step: of QUESTIONS; any other asks for what is missing, and the verdict answers it.
        model: its name.
    """
    question, answer = QUESTIONS.get(step, ("Which effect is missing?", lambda _: ""))
    return Diagnosed(found, dataset, f"{model} against {dataset.name}", question, answer(found), files or {})


def text(result: Diagnosed) -> str:
    """The answer, then sizes, error by step, fit by signal, candidates, laws, what is open, and notes."""
    found = result.found
    verdict = [f"Verdict: {verdict_words(found)}", *wrapped(verdict_sentence(found), "  ", "  ")]
    head = "\n".join(wrapped(result.answer) if result.answer else verdict)
    parts = (_effects, _history, _signals, _candidates, _detectable, _laws, _open)
    return "\n\n".join([head, *filter(None, ("\n".join(part(found)) for part in parts))])


def data(result: Diagnosed) -> dict[str, object]:
    """The answer, with its verdict, notes and doubts in words too; every number is finite or None."""
    found = result.found
    notes = [{"code": one.code.value, "values": dict(one.values), "text": words(one)} for one in found.notes]
    warnings = {one.step: sentences(step_warnings(one)) for one in found.history if one.step != PRIOR}
    shown = {"reason": verdict_sentence(found), "notes": notes, "warnings": warnings}
    if found.next_test is not None:
        shown["next_test_about"] = next_test_sentence(found.next_test)
    return {**answer_data(found, result.files), **shown}


def files(result: Diagnosed) -> dict[str, str]:
    """The plan of the next test, where there is one."""
    plan = result.found.next_test.plan if result.found.next_test is not None else ""
    return {"next_test.toml": plan} if plan else {}


def placed(result: Diagnosed, written: Mapping[str, Path], home: Path) -> Diagnosed:
    """The same with all files of its report, relative to another folder.

    Args:
        written: of the report, as `write_report` gives them.
        home: the folder of the JSON file.
    """
    folder = written["report"].parent
    paths = {"report": written["report"], **{name: folder / one for name, one in result.files.items()}}
    for name in files(result):
        paths["plan"] = folder / name
    paths |= {f"picture {name}": path for name, path in written.items() if path.suffix == ".png"}
    return replace(result, files=relative_files(paths, home))


def relative_files(files: Mapping[str, Path], folder: Path) -> dict[str, str]:
    """Paths relative to a folder, with slashes."""
    return {name: seen_from(folder.resolve(), path.resolve()) for name, path in files.items()}


def seen_from(folder: PurePath, path: PurePath) -> str:
    """A file's path from a folder, with slashes; whole where no folder holds both, as on two drives of Windows."""
    up, down = map(PurePosixPath, seen_from_shared([folder, path]))
    return PurePosixPath(*(".." for _ in up.parts), down).as_posix() if down.parts else path.as_posix()


def _effects(diagnosis: Diagnosis) -> Iterator[str]:
    if diagnosis.effects:
        yield "Effects, what costs most to leave out first"
    for one in diagnosis.effects:
        yield f"  {found_name(one)}{'' if one.share is None else f'  {LEFT_OUT} {share_text(one.share)} of the misfit'}"
        for name, size, ends, unit in sizes(one):
            value, low, high = with_interval(size, ends, 4)
            yield f"    {name} = {value}{'' if unit == '1' else f' {unit}'}, 95 % from {low} to {high}"


def _history(diagnosis: Diagnosis) -> Iterator[str]:
    if diagnosis.history:
        yield f"Residual by step, in {UNIT} (1: noise alone)"
    for step in diagnosis.history:
        numbers = "".join(f"  {use} {size_text(value):>7}" for use, value in errors(step).items())
        yield f"  {step_name(step.step):<20}{numbers}  {limits_words(step)}".rstrip()


def _signals(diagnosis: Diagnosis) -> Iterator[str]:
    rows = signal_rows(diagnosis.history[-1].records) if diagnosis.history else []
    if rows:
        yield f"Signals of the model {last_name(diagnosis)}"
    for name, use, residual, percent, rms, unit in rows:
        fit = "" if math.isnan(percent) else f"  fit {percent:.1f} %"
        yield f"  {name:<20}  {use:<8}  {size_text(residual):>7} x noise{fit}  rms {shown_value(rms, unit, '.3g')}"


def _candidates(diagnosis: Diagnosis) -> Iterator[str]:
    rows = candidates_shown(diagnosis)
    rows = [*[r for r in rows if len(r.effects) == 1][:_ROWS], *[r for r in rows if len(r.effects) > 1][:_ROWS]]
    names = [called(*row.effects) for row in rows]
    width = max([24, *map(len, names)])
    if names:
        yield f"{'Candidates, added':<{width + 2}}  explains  gain less penalty (nats)"
    for name, row in zip(names, rows, strict=True):
        yield f"  {name:<{width}}  {100 * row.explained:6.1f} %  {row.score:10.4g}{'  estimated' * (not row.refitted)}"


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
        formula = f"  {formula_text(law.formula, str(law.factor), law.unit)}".rstrip()
        yield f"  {law.slot}: {law_kind(law)} over {law.argument}, {share_text(law.share)} of the misfit{formula}"
    for law in diagnosis.likeliest:
        yield from _curve(law)


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
        yield from wrapped(f"These data cannot tell apart: {listed([*map(called, group)])}.", "", "  ")
    if diagnosis.next_test is not None:
        yield from wrapped(f"Next test: {next_test_sentence(diagnosis.next_test)}", "", "  ")
    for text in sentences(diagnosis.notes):
        yield from wrapped(f"Note: {text}", "", "  ")
