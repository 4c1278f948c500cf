"""How an answer is judged, and a whole case with a diagnosis that knows the truth."""

import json
from dataclasses import asdict, replace

import numpy as np
import pytest

from pysim.diagnosis import Session
from pysim.effects.learned import curve_basis
from pysim.types import Effect, EffectParameter, Estimate
from pysim.types.answer import Diagnosis, ErrorStep, LearnedLaw, Left
from pysim.types.factor import Factor, Form
from validation.blind.plant import BOUNDS
from validation.learned import answer as judge
from validation.learned.answer import Answer, answer, band, read_answer
from validation.learned.cases import CASES, LearnedCase
from validation.learned.figures import page, shares

V = Factor(Form.VARIABLE, "v")
NAMED = {case.name: case for case in CASES}


def law(case: LearnedCase, factor: Factor, argument: str, slot: str = "pistonForce", sd: float = 100.0) -> LearnedLaw:
    """The true curve, each value off by a tenth of its standard deviation."""
    knots = np.linspace(-21e-3, 21e-3, 15)
    assert case.kind.curve is not None
    z = np.linspace(-21e-3, 21e-3, 500)
    values = np.linalg.pinv(curve_basis(z, knots)) @ case.kind.curve(z, case.laws()[0], case.parameters()) + 0.1 * sd
    return LearnedLaw(slot, factor, argument, knots, values, sd**2 * np.eye(15), 0.9, "m", "N.s/m")


def test_places_and_variables() -> None:
    case = NAMED["damping.position-large-1"]
    right = law(case, V, "pistonForce.x")
    assert judge._right(case, [right], []) == (True, True, True)
    assert judge._right(case, [law(case, V, "alpha_x")], []) == (True, True, False)
    assert judge._right(case, [law(case, Factor(Form.VARIABLE, "x"), "v")], []) == (True, True, True)
    assert judge._right(case, [right, replace(right, slot="supply")], []) == (False, False, True)
    assert judge._right(case, [], []) == (False, False, False)
    size = EffectParameter("F", "N", 0.0, 5.0, 1.0, 0.0, 0.0)
    near, far = (Effect(slot, slot, "Lib.Class", (size,)) for slot in ("pistonForce", "supply"))
    assert judge._right(case, [], [near]) == (False, True, False)
    assert judge._right(case, [right], [near, far]) == (False, False, True)
    two = NAMED["two-large-2"]
    opening = replace(right, slot="spoolOpening", factor=Factor(), argument="spoolOpening.s")
    assert judge._right(two, [opening, right], []) == (True, True, True)
    assert judge._right(two, [right], []) == (False, False, False)
    assert judge._right(NAMED["friction.dahl-large-1"], [right], []) == (True, True, None)
    assert judge._right(NAMED["cushion.unreached-large-1"], [], []) == (True, True, None)
    assert judge._right(NAMED["cushion.unreached-large-1"], [right], []) == (False, False, None)


def test_the_band_is_asked_of_the_right_curve_alone() -> None:
    case = NAMED["damping.position-large-1"]
    right = law(case, V, "x", sd=500.0)
    assert band(case, right) == 1.0
    assert band(case, replace(right, factor=Factor(), argument="v")) is None
    assert band(case, replace(right, slot="supply")) is None
    off = replace(right, coefficients=right.coefficients + 3000.0)
    assert band(case, off) == 0.0
    assert band(case, replace(off, absorbed=np.ones((15, 1)))) == 1.0
    ends = np.isin(np.arange(15), [0, 14])
    wrong = replace(right, coefficients=right.coefficients + 3000.0 * ends)
    assert 0.5 < band(case, wrong) < 1.0
    assert band(case, replace(wrong, reach=(wrong.knots[1], wrong.knots[-2]))) == 1.0


def test_the_band_is_asked_in_the_scale_of_the_models_piston() -> None:
    """A piston of 1.25 times the area moves 1.25 times less far with 1.25 times the force: the same angle."""
    case = NAMED["damping.position-large-1"]
    right = law(case, V, "x", sd=60.0)
    area = {"A_p": 1.25 * case.parameters().A_p}
    values, spread = 1.25**2 * right.coefficients, 1.25**4 * right.covariance
    reach = (right.reach[0] / 1.25, right.reach[1] / 1.25)
    scaled = replace(
        right, knots=right.knots / 1.25, coefficients=values, covariance=spread, parameters=area, reach=reach
    )
    assert band(case, scaled) == pytest.approx(band(case, right), abs=0.02)
    assert band(case, replace(scaled, parameters={})) < 0.8
    assert band(case, replace(right, parameters=area)) < 0.8


@pytest.mark.parametrize(
    ("change", "missed"),
    [
        ({}, 0),
        ({"place": False}, 1),
        ({"after": 1.2}, 1),
        ({"before": 0.1, "after": 0.3}, 1),
        ({"before": 0.02, "after": 0.05}, 0),
        ({"after": None}, 2),
        ({"band": 0.8}, 1),
        ({"trouble": "ended", "after": 0.1}, 1),
    ],
)
def test_what_is_wanted_of_the_table(change: dict[str, float], missed: int) -> None:
    good = [Answer(case.name, place=True, before=3.0, after=0.2, band=1.0) for case in CASES]
    changed = [replace(one, **change) if NAMED[one.case].kind.visible else one for one in good]  # type: ignore[arg-type]
    assert sum(share.beyond > 0 for share in shares(changed)) == missed


def test_a_line_is_read_back() -> None:
    one = Answer("two-large-1", ("a: h(b)",), ("x",), before=2.0)
    assert read_answer(json.loads(json.dumps(asdict(one)))) == one
    assert read_answer({"case": "two-large-1", "trouble": "the process ended with -9"}).trouble


def test_every_case_has_a_row_of_as_many_cells_as_the_head() -> None:
    some = [Answer("two-large-1", ("a: h(b)",), ("x",), before=2.0), Answer("valve.notch-small-1", trouble="it ended")]
    head, _, *rows = [line for line in page(some, "Learned laws") if line.startswith("|")]
    assert [row.split(" | ")[0] for row in rows] == ["| `two-large-1`", "| `valve.notch-small-1`"]
    assert {row.count("|") for row in rows} == {head.count("|")}


def knowing(case: LearnedCase, one: LearnedLaw) -> Answer:
    """The answer of a diagnosis that has this law and the true parameters."""
    right = {name: float(getattr(case.parameters(), name)) for name in BOUNDS}

    def ask(session: Session) -> Diagnosis:
        estimates = tuple(
            Estimate(name, "", value, value, -np.inf, np.inf, 0.0, (value, value)) for name, value in right.items()
        )
        step = ErrorStep("refit", None, None, None, {}, False, 0.0, estimates=estimates)
        history = (replace(step, step="model"), step, replace(step, step="the law"))
        return Diagnosis(
            (), False, Left({}, None, None), (), (), history, (), learned=(replace(one, parameters=right),)
        )

    return answer(case, ask)


@pytest.mark.slow
def test_a_diagnosis_that_knows_the_law_is_right() -> None:
    case = NAMED["damping.position-large-1"]
    found = knowing(case, law(case, V, "pistonForce.x", sd=1.0))
    assert (found.place, found.variables, found.trouble) == (True, True, "")
    assert found.before is not None
    assert found.after is not None
    assert found.before > 5
    assert found.after < 0.2


@pytest.mark.slow
def test_the_fmus_of_a_hysteresis_run_as_what_was_fitted() -> None:
    case, play = NAMED["valve.edge_play-large-1"], 0.012
    knots, own = np.linspace(-0.5, 0.5, 5), "spoolOpening"
    lost = LearnedLaw(own, Factor(Form.HYSTERESIS, "s", 2 * play), f"{own}.s", knots, np.full(5, -play), np.eye(5), 0.9,
                      "1", "1")  # fmt: skip
    found = knowing(case, lost)
    assert (found.place, found.trouble) == (True, "")
    assert found.exported is not None
    assert found.exported < 1e-6
    assert found.after is not None
    assert found.before is not None
    assert found.after < 0.5 * found.before
