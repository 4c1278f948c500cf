"""A diagnosis as numbers and as text."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence

import numpy as np

from pysim.io import json_number
from pysim.present.diagnosis.words import limits_words, next_test_sentence, verdict_sentence
from pysim.present.notes import words
from pysim.types import Estimate, Note, NoteCode
from pysim.types.diagnosis import AddedEffect, Candidate, Diagnosis, LedgerStep, Missing, NextTest

_WIDTH = 100


def diagnosis_data(diagnosis: Diagnosis, files: Mapping[str, str] | None = None) -> dict[str, object]:
    """What `--json` writes; every number finite or None.

    Args:
        files: what was written besides, name -> path relative to the JSON file.
    """
    return {
        "verdict": diagnosis.verdict,
        "reason": diagnosis.reason,
        "added": [_added(one) for one in diagnosis.added],
        "ranking": [_candidate(row) for row in diagnosis.ranking],
        "confusable": [list(group) for group in diagnosis.confusable],
        "error": [step_data(step) for step in diagnosis.error],
        "parameters": {e.name: _estimate(e) for e in diagnosis.parameters},
        "where": [
            {"record": f.record, "signal": f.signal, "region": f.region, "error": json_number(f.error)}
            for f in diagnosis.where
        ],
        "missing": [_missing(one) for one in diagnosis.missing],
        "next_test": _next_test(diagnosis.next_test),
        "seconds": {name: json_number(value) for name, value in diagnosis.seconds.items()},
        "files": dict(files or {}),
        "notes": [_note(note) for note in diagnosis.notes],
        "conditions": dict(diagnosis.conditions),
        **_completeness(diagnosis),
    }


def _note(note: Note | str) -> dict[str, object]:
    """Code and values for a program, the sentence for a person."""
    if isinstance(note, str):
        return {"code": NoteCode.OTHER.value, "values": {}, "text": note}
    return {"code": note.code.value, "values": dict(note.values), "text": words(note)}


def _completeness(diagnosis: Diagnosis) -> dict[str, object]:
    """Whether anything is left; nothing where that was not judged."""
    if diagnosis.complete is None or diagnosis.left is None:
        return {}
    fit, validate, share, t = map(json_number, diagnosis.left)
    left = {"rms_over_floor": {"fit": fit, "validate": validate}, "share_explained": share, "t": t}
    return {"complete": diagnosis.complete, "left": left, "fit_percent": _fit_percent(diagnosis)}


def _fit_percent(diagnosis: Diagnosis) -> list[dict[str, object]]:
    """NRMSE of every log and signal at each step, in percent: 100 where the model is the log."""
    found: list[dict[str, object]] = []
    for stage in diagnosis.stages:
        rows: dict[str, dict[str, float | None]] = {}
        for record in stage.records:
            for j, name in enumerate(record.measured.names):
                measured = record.measured.values[:, j]
                size = float(np.linalg.norm(measured - measured.mean()))
                away = float(np.linalg.norm(measured - record.simulated.values[:, j]))
                rows.setdefault(record.source, {})[name] = json_number(100 * (1 - away / size) if size else None)
        found.append({"step": stage.step, "records": rows})
    return found


def _interval(interval: tuple[float, float]) -> list[float | None]:
    return [json_number(interval[0]), json_number(interval[1])]


def _added(one: AddedEffect) -> dict[str, object]:
    """An effect's parameters; where people speak of the inverse, that stands beside it."""
    names = [p.name for p in one.effect.parameters]
    found: dict[str, dict[str, object]] = {"parameters": {}, "intervals": {}, "unit": {}}
    for name, estimate in zip(names, one.estimates, strict=True):
        found["parameters"][name] = json_number(estimate.value)
        found["intervals"][name] = _interval(estimate.interval)
        found["unit"][name] = estimate.unit
        inverse = one.effect[name].inverse
        if inverse:
            low, high = ((1 / v if v else math.inf) for v in estimate.interval)
            found["parameters"][inverse] = json_number(1 / estimate.value if estimate.value else math.inf)
            found["intervals"][inverse] = _interval((high, low))
            found["unit"][inverse] = f"1/({estimate.unit})"
    return {"effect": one.effect.name, "place": one.place, **found}


def _candidate(row: Candidate) -> dict[str, object]:
    return {
        "effect": row.effect,
        "round": row.round,
        "score": json_number(row.score),
        "p_value": json_number(row.p_value),
        "explained": json_number(row.explained),
        "refitted": row.refitted,
        "parameters": {name: json_number(value) for name, value in row.parameters.items()},
    }


def _missing(one: Missing) -> dict[str, object]:
    """A missing term, tabulated."""
    columns = ("argument", "value", "low", "high")
    shape: dict[str, object] = {name: [json_number(float(v)) for v in getattr(one.shape, name)] for name in columns}
    shape |= {"argument_unit": one.shape.argument_unit, "unit": one.shape.unit}
    return {
        "slot": one.slot,
        "share": json_number(one.share),
        "depends_on": one.depends_on,
        "shape": shape,
        "formula": one.formula,
        "alike": list(one.alike),
        "parameters": {name: json_number(value) for name, value in one.parameters.items()},
    }


def _next_test(test: NextTest | None) -> dict[str, object] | None:
    if test is None:
        return None
    return {"separates": list(test.separates), "gain": json_number(test.gain), "about": test.about, "plan": test.plan}


def step_data(step: LedgerStep) -> dict[str, object]:
    """One step of the ledger; every number finite or None."""
    return {
        "step": step.step,
        "fit": json_number(step.fit),
        "validate": json_number(step.validate),
        "criteria": {name: json_number(value) for name, value in step.criteria.items()},
        "passes": step.passes,
        "cost": json_number(step.cost),
        "not_simulated": step.not_simulated,
    }


def _estimate(e: Estimate) -> dict[str, object]:
    return {"value": json_number(e.value), "interval": _interval(e.interval), "unit": e.unit, "at": e.at}


def diagnosis_text(diagnosis: Diagnosis) -> str:
    """Verdict, ledger and ranking for a terminal."""
    return "\n".join(
        [f"Verdict: {diagnosis.verdict}", *_wrapped(verdict_sentence(diagnosis)), evidence_text(diagnosis)]
    )


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, _WIDTH, initial_indent="  ", subsequent_indent="  ")


def evidence_text(diagnosis: Diagnosis) -> str:
    """Sizes, ledger, ranking, ties with the test that would part them, and notes for a terminal."""
    lines = [*_effects(diagnosis.added), *([""] if diagnosis.added else []), "Error over noise"]
    for step in diagnosis.error:
        numbers = "".join(
            f"  {what} {value:8.3f}" for what, value in (("fitted", step.fit), ("held out", step.validate)) if value
        )
        lines.append(f"  {step.step:<20}{numbers}  {limits_words(step)}")
    if diagnosis.ranking:
        lines += ["", "Candidates                  gain less penalty explained"]
        for number in sorted({row.round for row in diagnosis.ranking}):
            own = [row for row in diagnosis.ranking if row.round == number][: 6 if number == 1 else 3]
            lines += [f"  round {number}"] if number > 1 else []
            lines += [f"  {row.effect:<24} {row.score:14.5g} {100 * row.explained:9.2f} %" for row in own]
    if diagnosis.missing:
        lines += ["", "Missing at                over                of the misfit"]
        lines += [
            f"  {one.slot:<23} {one.depends_on:<23} {100 * one.share:6.1f} %  {one.formula}".rstrip()
            for one in diagnosis.missing[:6]
        ]
    lines += [f"Indistinguishable with these data: {', '.join(group)}" for group in diagnosis.confusable]
    if diagnosis.next_test is not None:
        lines += textwrap.wrap(f"Next test: {next_test_sentence(diagnosis.next_test)}", _WIDTH, subsequent_indent="  ")
    for note in diagnosis.notes:
        lines += textwrap.wrap(f"Note: {words(note)}", _WIDTH, subsequent_indent="  ")
    return "\n".join(lines)


def _effects(added: Sequence[AddedEffect]) -> list[str]:
    return [
        f"  {one.effect.name}: {name} = {e.value:.5g}{'' if e.unit == '1' else f' {e.unit}'}, "
        f"95 % from {e.interval[0]:.5g} to {e.interval[1]:.5g}"
        for one in added
        for name, e in zip([p.name for p in one.effect.parameters], one.estimates, strict=True)
    ]
