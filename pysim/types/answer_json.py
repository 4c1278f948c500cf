"""The answer of a diagnosis as JSON has it: the keys are a contract with other programs, and every number is finite.

`pysim.present.data` adds what is made of words: the reason of the verdict and the text of each note.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from pysim.types.answer import Detectable, Diagnosis, ErrorStep, Failure, FoundEffect, LearnedLaw, Left, NextTest, Rival
from pysim.types.fit import Estimate
from pysim.types.json_number import json_number
from pysim.types.note import NoteCode

Json = dict[str, object]


def answer_data(diagnosis: Diagnosis, files: Mapping[str, str] | None = None) -> Json:
    """The whole answer.

    Args:
        files: what was written besides, name -> path relative to the JSON file.
    """
    chose = any(note.code is NoteCode.USED_TO_CHOOSE for note in diagnosis.notes)
    last = diagnosis.history[-1] if diagnosis.history else None
    return {
        "verdict": diagnosis.verdict,
        "complete": diagnosis.complete,
        "added": [_effect(one) for one in diagnosis.effects],
        "ranking": [_rival(one) for one in diagnosis.rivals],
        "confusable": [list(group) for group in diagnosis.ties],
        "error": [step_data(step, used_to_choose=chose) for step in diagnosis.history],
        "fit_percent": [_fit_percent(step) for step in diagnosis.history],
        "left": _left(diagnosis.left, last),
        "parameters": {e.name: _estimate(e) for e in diagnosis.estimates},
        "where": [_failure(one) for one in diagnosis.failures],
        "missing": [_missing(law) for law in diagnosis.laws],
        "learned": [_learned(law) for law in diagnosis.learned],
        "detectable": [_detectable(one) for one in diagnosis.detectable],
        "next_test": _next_test(diagnosis.next_test),
        "notes": [{"code": note.code.value, "values": dict(note.values)} for note in diagnosis.notes],
        "conditions": dict(diagnosis.conditions),
        "seconds": {name: json_number(value) for name, value in diagnosis.seconds.items()},
        "files": dict(files or {}),
    }


def step_data(step: ErrorStep, *, used_to_choose: bool = False) -> Json:
    """One step of the error history.

    Args:
        used_to_choose: whether the logs that were not fitted had a part in choosing between models.
    """
    return {
        "step": step.step,
        "fit": json_number(step.fit),
        "validate": json_number(step.validate),
        "used_to_choose": used_to_choose,
        "test": json_number(step.test),
        "criteria": {name: json_number(value) for name, value in step.criteria.items()},
        "passes": step.passes,
        "cost": json_number(step.cost),
        "not_simulated": step.not_simulated,
    }


def _detectable(one: Detectable) -> Json:
    return {
        "effect": one.effect,
        "sizes": {name: json_number(size) for name, size in one.sizes.items()},
        "unit": dict(one.units),
    }


def _numbers(values: np.ndarray | tuple[float, float]) -> list[float | None]:
    return [json_number(float(value)) for value in values]


def _fit_percent(step: ErrorStep) -> Json:
    records: dict[str, dict[str, float | None]] = {}
    for record in step.records:
        own = records.setdefault(record.source, {})
        own |= {name: json_number(value) for name, value in record.fit_percent.items()}
    return {"step": step.step, "records": records}


def _effect(one: FoundEffect) -> Json:
    """An effect's parameters; where people speak of the inverse, that stands beside it."""
    values, intervals, units = dict[str, object](), dict[str, object](), dict[str, object]()
    for parameter, estimate in zip(one.effect.parameters, one.estimates, strict=True):
        values[parameter.name] = json_number(estimate.value)
        intervals[parameter.name] = _numbers(estimate.interval)
        units[parameter.name] = estimate.unit
        if parameter.inverse:
            low, high = ((1 / v if v else math.inf) for v in estimate.interval)
            values[parameter.inverse] = json_number(1 / estimate.value if estimate.value else math.inf)
            intervals[parameter.inverse] = _numbers((high, low))
            units[parameter.inverse] = f"1/({estimate.unit})"
    found: Json = {"effect": one.effect.name, "place": one.place, "parameters": values, "intervals": intervals}
    return {**found, "unit": units, "share": json_number(one.share), "held_out": json_number(one.held_out)}


def _rival(row: Rival) -> Json:
    return {
        "effect": row.effects[-1],
        "beside": list(row.effects[:-1]),
        "round": len(row.effects),
        "score": json_number(row.score),
        "p_value": json_number(row.p_value),
        "explained": json_number(row.explained),
        "refitted": row.refitted,
        "parameters": {name: json_number(value) for name, value in row.parameters.items()},
    }


def _left(left: Left, last: ErrorStep | None) -> Json:
    return {
        "rms_over_floor": {"fit": json_number(left.fit), "validate": json_number(left.validate)},
        "share_explained": json_number(left.share_explained),
        "t": json_number(left.t),
        "parts": [_failure(one) for one in (last.failures if last else ())],
        "floors": {name: {"sd": json_number(f.sd), "source": f.source.value} for name, f in left.floors.items()},
    }


def _failure(one: Failure) -> Json:
    return {"record": one.record, "signal": one.signal, "region": one.region, "error": json_number(one.error)}


def _missing(law: LearnedLaw) -> Json:
    """A learned law as a table."""
    low, high = law.band
    shape: Json = {"argument": _numbers(law.knots), "value": _numbers(law.coefficients)}
    shape |= {"low": _numbers(low), "high": _numbers(high), "argument_unit": law.argument_unit, "unit": law.unit}
    return {
        "slot": law.slot,
        "share": json_number(law.share),
        "depends_on": law.argument,
        "factor": law.factor,
        "shape": shape,
        "formula": law.formula,
        "alike": list(law.alternatives),
        "parameters": {name: json_number(value) for name, value in law.parameters.items()},
    }


def _learned(law: LearnedLaw) -> Json:
    return {
        "slot": law.slot,
        "factor": law.factor,
        "argument": law.argument,
        "range": _numbers(law.knots[[0, -1]]) if law.knots.size else None,
        "knots": _numbers(law.knots),
        "coefficients": _numbers(law.coefficients),
        "covariance": [_numbers(row) for row in law.covariance],
        "formula": law.formula,
        "class": law.modelica,
        "share": json_number(law.share),
        "held_out": [json_number(value) for value in law.held_out],
        "alternatives": list(law.alternatives),
    }


def _next_test(test: NextTest | None) -> Json | None:
    if test is None:
        return None
    return {"separates": list(test.separates), "gain": json_number(test.gain), "about": test.about, "plan": test.plan}


def _estimate(e: Estimate) -> Json:
    return {"value": json_number(e.value), "interval": _numbers(e.interval), "unit": e.unit, "at": e.at}
