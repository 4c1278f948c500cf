"""The answer of a diagnosis as JSON has it: the keys are a contract with other programs, and every number is finite.

`pysim.present.data` adds what is made of words: the reason of the verdict and the text of each note.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from pysim.types.answer import Diagnosis, ErrorStep, Failure, FoundEffect, LearnedLaw, Left, NextTest, Rival
from pysim.types.factor import Factor, Form
from pysim.types.json_number import json_data
from pysim.types.note import NoteCode

Json = dict[str, object]


def answer_data(diagnosis: Diagnosis, files: Mapping[str, str] | None = None) -> Json:
    """The whole answer.

    Args:
        files: what was written besides, name -> path relative to the JSON file.
    """
    chose = any(note.code is NoteCode.USED_TO_CHOOSE for note in diagnosis.notes)
    last = diagnosis.history[-1] if diagnosis.history else None
    answer = {
        "verdict": diagnosis.verdict,
        "complete": diagnosis.all_named,
        "added": [_effect(one) for one in diagnosis.effects],
        "ranking": [_rival(one) for one in diagnosis.rivals],
        "confusable": diagnosis.ties,
        "error": [step_data(step, used_to_choose=chose) for step in diagnosis.history],
        "fit_percent": [_fit_percent(step) for step in diagnosis.history],
        "left": _left(diagnosis.left, last),
        "parameters": {
            e.name: {"value": e.value, "interval": e.interval, "unit": e.unit, "at": e.at} for e in diagnosis.estimates
        },
        "where": [_failure(one) for one in diagnosis.failures],
        "missing": [law_data(law) for law in diagnosis.laws],
        "learned": [_learned(law) for law in diagnosis.learned],
        "detectable": [{"effect": o.effect, "sizes": o.sizes, "unit": o.units} for o in diagnosis.detectable],
        "next_test": _next_test(diagnosis.next_test),
        "notes": [{"code": note.code.value, "values": note.values} for note in diagnosis.notes],
        "conditions": diagnosis.conditions,
        "seconds": diagnosis.seconds,
        "files": files or {},
    }
    return json_data(answer)


def step_data(step: ErrorStep, *, used_to_choose: bool = False) -> Json:
    """One step of the error history.

    Args:
        used_to_choose: whether the logs that were not fitted had a part in choosing between models.
    """
    return json_data(
        {
            "step": step.step,
            "fit": step.fit,
            "validate": step.validate,
            "used_to_choose": used_to_choose,
            "test": step.test,
            "criteria": step.criteria,
            "passes": step.passes,
            "cost": step.cost,
            "not_simulated": step.not_simulated,
        }
    )


def read_step(data: Mapping[str, Any]) -> ErrorStep:
    """The errors of a step that `step_data` wrote; an earlier version knew no logs that nobody looked at."""
    known = {name: data[name] for name in ("step", "fit", "validate", "criteria", "passes")}
    return ErrorStep(**known, test=data.get("test"), cost=data.get("cost", math.nan))


def _fit_percent(step: ErrorStep) -> Json:
    records: dict[str, dict[str, float]] = {}
    for record in step.records:
        records.setdefault(record.source, {}).update(record.fit_percent)
    return {"step": step.step, "records": records}


def _effect(one: FoundEffect) -> Json:
    """An effect's parameters; where people speak of the inverse, that stands beside it."""
    values, intervals, units = dict[str, object](), dict[str, object](), dict[str, object]()
    for parameter, estimate in zip(one.effect.parameters, one.estimates, strict=True):
        values[parameter.name] = estimate.value
        intervals[parameter.name] = estimate.interval
        units[parameter.name] = estimate.unit
        if parameter.inverse:
            low, high = ((1 / v if v else math.inf) for v in estimate.interval)
            values[parameter.inverse] = 1 / estimate.value if estimate.value else math.inf
            intervals[parameter.inverse] = (high, low)
            units[parameter.inverse] = f"1/({estimate.unit})"
    found: Json = {"effect": one.effect.name, "place": one.place, "parameters": values, "intervals": intervals}
    return {**found, "unit": units, "share": one.share}


def _rival(row: Rival) -> Json:
    return {
        "effect": row.effects[-1],
        "beside": row.effects[:-1],
        "round": len(row.effects),
        "score": row.score,
        "p_value": row.p_value,
        "explained": row.explained,
        "refitted": row.refitted,
        "parameters": row.parameters,
    }


def _left(left: Left, last: ErrorStep | None) -> Json:
    most = left.stands_out
    return {
        "rms_over_floor": {"fit": left.fit, "validate": left.validate},
        "share_explained": left.share_explained,
        "t": left.t,
        "tone": left.tone,
        "stands_out": None if most is None else {"record": most.record, "signal": most.signal, "over": most.over},
        "parts": [_failure(one) for one in (last.failures if last else ())],
        "floors": {name: {"sd": f.sd, "source": f.source.value} for name, f in left.floors.items()},
    }


def _failure(one: Failure) -> Json:
    return {"record": one.record, "signal": one.signal, "region": one.region, "error": one.error}


def law_data(law: LearnedLaw) -> Json:
    """A learned law as a table."""
    low, high = law.band
    shape: Json = {"argument": law.knots, "value": law.coefficients}
    shape |= {"low": low, "high": high, "argument_unit": law.argument_unit, "unit": law.unit, "absorbed": law.absorbed}
    return {
        "slot": law.slot,
        "share": law.share,
        "depends_on": law.argument,
        **_factor(law.factor),
        "shape": shape,
        "formula": law.formula,
        "alike": law.alternatives,
        "parameters": law.parameters,
    }


def _factor(factor: Factor) -> Json:
    is_sign = factor.form is Form.SIGN
    return {
        "factor": str(factor),
        "sign_of": factor.variable if is_sign else None,
        "sign_width": factor.number if is_sign else None,
    }


def _learned(law: LearnedLaw) -> Json:
    return {
        "slot": law.slot,
        **_factor(law.factor),
        "argument": law.argument,
        "range": law.reach if law.knots.size else None,
        "knots": law.knots,
        "coefficients": law.coefficients,
        "covariance": law.covariance,
        "formula": law.formula,
        "class": law.modelica,
        "share": law.share,
        "held_out": law.held_out,
        "alternatives": law.alternatives,
    }


def _next_test(test: NextTest | None) -> Json | None:
    if test is None:
        return None
    return {
        "separates": test.separates,
        "gain": test.gain,
        "tests": [vars(one) for one in test.tests],
        "log": test.log,
        "assumed": {name: {"noise": noise, "unit": unit} for name, (noise, unit) in test.assumed.items()},
        "plan": test.plan,
    }
