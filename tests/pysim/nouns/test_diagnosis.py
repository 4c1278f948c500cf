"""A diagnosis as a user holds it, laws that are learned, and effects from formulas."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import pysim
from pysim.effects import read_catalogue
from pysim.nouns.diagnosis import Diagnosis, _given
from pysim.nouns.fit import Fit
from pysim.nouns.law import Law
from pysim.nouns.model import Model, opened
from pysim.types import BadInput, Dataset, Record
from tests.pysim.nouns.conftest import FRICTION, TRUE


def test_the_effect_is_named_with_its_size(why: Diagnosis) -> None:
    assert why.verdict == "toy.friction"
    (row,) = list(why.effects)
    assert row["95 % from"] < FRICTION < row["to"]
    assert why.steps["fitted"][-1] == pytest.approx(1.0, abs=0.1)
    assert why.steps["used to choose"][1] > 10 * why.steps["used to choose"][-1]
    assert why.candidates["effects"][0] == "toy.friction"


def test_its_model_is_the_base_with_what_was_found(why: Diagnosis, mass: Model) -> None:
    assert why.model.free_names == (*mass.free_names, "force.F_c")
    for name, true in TRUE.items():
        assert why.model.values[name] == pytest.approx(true, rel=0.01)
    assert why.model.values["force.F_c"] == pytest.approx(FRICTION, rel=0.02)


def test_a_fit_that_warned_is_trusted_once_the_effect_is_there(why: Diagnosis, fitted: Fit, data: Dataset) -> None:
    again = pysim.fit(why.model, data)
    assert (fitted.ok, again.ok) == (False, True)
    low, high = again.intervals["force.F_c"]
    assert low < FRICTION < high


def test_of_a_fit_the_model_before_it_is_as_it_is_and_the_search_begins_at_what_was_fitted(
    why: Diagnosis, fitted: Fit, mass: Model, data: Dataset
) -> None:
    (untouched,) = (row["x noise"] for row in pysim.compare(mass, data).table if row["use"] == "fitted")
    assert why.steps["fitted"][0] == pytest.approx(untouched, rel=0.01)
    assert why.steps["fitted"][0] > 1.05 * why.steps["fitted"][1]
    assert [one.start for one in why.found.estimates][:3] == [one.start for one in fitted.found.estimates][:3]
    assert why.parts.begins == fitted.values


def test_it_prints_draws_and_is_reported(why: Diagnosis, tmp_path: Path) -> None:
    assert max(len(repr(why)), len(why._repr_html_())) < 2000
    assert "toy.friction" in repr(why)
    assert why.plot().axes
    assert why.where().table["residual over noise"][0] > 10
    files = why.report(tmp_path / "better")
    assert {"report", "modelica", "fmu", "parameters"} <= set(files)
    assert files["parameters"].suffix == ".toml"
    assert why.sentence.split(".")[0] in files["report"].read_text(encoding="utf-8")


def test_what_cannot_be_asked_is_refused(mass: Model, data: Dataset) -> None:
    with pytest.raises(BadInput, match=r"diagnose\(model, data\)"):
        pysim.diagnose(mass)
    with pytest.raises(BadInput, match="without"):
        pysim.diagnose(mass.with_effects("toy.bias"), data)
    with pytest.raises(BadInput, match="initial: y is no state"):
        pysim.diagnose(mass, data, initial={"y": 0.1})
    with pytest.raises(BadInput, match=r"did you mean toy\.friction"):
        pysim.diagnose(mass, data, effects=["toy.fricton"])


def test_a_diagnosis_begins_at_states_that_were_set_as_a_comparison_does(mass: Model, data: Dataset) -> None:
    for initial, begins in ((None, {}), ("rest", "rest")):
        assert _given(mass.set(x=0.1), data, initial)[2] == mass.set(x=0.1).first_sample(initial) == begins


def test_a_log_may_begin_where_the_user_says(mass: Model, data: Dataset, tmp_path: Path) -> None:
    """A mass with friction that is let go 0.1 m away from rest, as fit and diagnosis are told."""
    plant = mass.with_effects("toy.friction").set(**TRUE, **{"force.F_c": FRICTION, "x": 0.1})
    rng, records = np.random.default_rng(5), []
    for one in data.records:
        assert isinstance(one.data, Record)
        x = plant.simulate(one)["x"] + 1e-3 * rng.standard_normal(one.data.time.size)
        records.append(replace(one, data=replace(one.data, values=np.column_stack([one.data["F"], x]))))
    let_go = replace(data, records=tuple(records))
    begun = pysim.diagnose(mass, let_go, effects=["toy.friction", "toy.bias"], initial={"x": 0.1})
    assert begun.verdict == "toy.friction"
    assert begun.report(tmp_path)["fmu"].is_file()  # where a state began is no parameter of the class
    assert begun.steps["fitted"][-1] == pytest.approx(1.0, abs=0.1)
    for log in let_go.logs():  # the answer's own model begins there too
        assert isinstance(log.data, Record)
        assert np.std(begun.model.simulate(log)["x"] - log.data["x"]) < 1.1e-3


@pytest.fixture(scope="module")
def missing(fitted: Fit) -> Law:
    return pysim.locate(fitted)[0]


def test_what_is_missing_is_located_with_its_shape(missing: Law) -> None:
    """A force with the sign of the speed: as a curve over the speed, or as its sign times a level that stays."""
    assert missing.slot == "force"
    assert missing.argument == "force.v" or str(missing.found.factor) == "sign(v)"
    assert missing.share > 0.95
    if missing.argument == "force.v":  # beside the line that the damping may as well have taken
        shapes = np.column_stack([np.sign(missing.found.knots), missing.found.knots])
        level = np.linalg.lstsq(shapes, missing.found.coefficients, rcond=None)[0][0]
        assert level == pytest.approx(-FRICTION, rel=0.2)
    else:
        assert np.median(np.abs(missing.found.coefficients)) == pytest.approx(FRICTION, rel=0.2)
    assert max(len(repr(missing)), len(missing._repr_html_())) < 2000
    assert missing.plot().axes


def test_a_learned_law_becomes_an_effect_of_the_users(missing: Law, mass: Model, data: Dataset, tmp_path: Path) -> None:
    own = missing.to_effect("my.rubbing")
    assert missing.to_effect("my.rubbing").file == own.file
    (kept,) = read_catalogue(own.save(tmp_path / "own"))
    assert (kept.name, kept.slot, kept.class_name) == ("my.rubbing", "force", "MyRubbing")
    for place in ("MyRubbing.mo", "own/MyRubbing.mo"):  # a file is meant; the second is one
        with pytest.raises(BadInput, match="name the folder"):
            own.save(tmp_path / place)
    with_law = mass.with_effects(own)
    assert with_law.free_names == mass.free_names  # the curve has its values already
    errors = pysim.compare(mass.set(**missing.found.parameters), with_law.set(**missing.found.parameters), data)
    before, after = errors.table["x noise"][0], errors.table["x noise"][2]
    assert after < 0.1 * before


def test_the_formula_of_a_law_becomes_an_effect_too(missing: Law, mass: Model, data: Dataset) -> None:
    """Its amounts and widths are the effect's parameters; fitted to the data it is as good as the curve.

    Fitted, since damping may take what the curve has in proportion to the speed."""
    curve, formula = missing.to_effect("my.rubbing"), missing.to_effect("my.rubbing", formula=True)
    assert formula.file != curve.file
    nearly = replace(missing, found=replace(missing.found, coefficients=1.00001 * missing.found.coefficients))
    assert nearly.to_effect("my.rubbing", formula=True).file != formula.file  # a text of three digits hides it
    assert {one.name[:2] for one in formula.found.parameters} <= {"a_", "w_"}
    models = [mass.with_effects(one).set(**missing.found.parameters).free("m", "d", "k") for one in (curve, formula)]
    beside = [pysim.fit(one, data).model for one in models]
    by_curve, by_formula = pysim.compare(*beside, data).table["x noise"][::2]
    assert by_formula == pytest.approx(by_curve, rel=0.1)
    own = {f"force.{one.name}" for one in formula.found.parameters}
    assert set(mass.with_effects(formula).free_names) == {*mass.free_names, *own}
    level = replace(missing.found, coefficients=0 * missing.found.coefficients)
    with pytest.raises(BadInput, match="no formula"):
        replace(missing, found=level).to_effect("my.nothing", formula=True)


def drag(**more: object) -> dict[str, object]:
    return {"at": "force", "law": "-F_0*tanh(v/0.02) - c_2*v*abs(v)",
            "F_0": (0, 5, 0.3, "N"), "c_2": (0, 10, 1, "N.s2/m2"), **more}  # fmt: skip


def test_an_effect_from_a_formula_is_fitted_and_a_candidate(mass: Model, data: Dataset) -> None:
    own = pysim.effect("my.drag", **drag())  # type: ignore[arg-type]
    assert "model MyDrag" in own.modelica
    assert own.parameters["0 is off"] == (True, True)
    assert own.plot().axes
    found = pysim.fit(mass.with_effects(own), data)
    assert abs(found.values["force.F_0"] - FRICTION) < 4 * found.found["force.F_0"].std
    rows = pysim.compare(mass, found.model, data).table["x noise"]
    assert rows[2] < 0.1 * rows[0]
    assert "my.drag" in mass.with_candidates(own).effects["name"]


def test_what_shapes_a_law_has_its_usual_value_and_a_strength_is_off() -> None:
    own = pysim.effect("my.bump", at="force", law="-F*exp(-((x - x_0)/w)^2)",
                       F=(-5, 5, 1, "N"), x_0=(-1, 1, 0.3, "m"), w=(0.1, 1, 0.2, "m"))  # fmt: skip
    declared = {p.name: (p.default, p.off) for p in own.found.parameters}
    assert declared == {"F": (0.0, 0.0), "x_0": (0.3, None), "w": (0.2, None)}


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (drag(law="-c_2*v*abs(w)"), "line 1, column 12: w is no name"),
        (drag(law="-c_2*v*log(v)"), "column 8: log is no function"),
        (drag(law="__import__('os').system('ls')"), "law of MyDrag, line 1"),
        (drag(law="-c_2*v"), "f is in N"),
        (drag(law="1.0*F_0/F_0 - c_2*v*abs(v)"), "law of MyDrag|switches the law off"),
        (drag(at="spool_of_nobody"), "no model that was opened has a slot"),
        (drag(c_2=(0, 10)), r"c_2=\(lowest, highest, usual, unit\)"),
        (drag(c_2=(0, 10, 20, "N.s2/m2")), "outside 0 to 10"),
        (drag(c_2=(1, 10, 2, "N.s2/m2")), "switches the law off"),
    ],
)
def test_what_a_law_may_not_be_is_refused_with_its_place(mass: Model, given: dict[str, object], said: str) -> None:
    with pytest.raises(BadInput, match=said):
        pysim.effect("my.drag", **given)  # type: ignore[arg-type]


def test_a_slot_of_two_models_asks_which(mass: Model, tmp_path: Path) -> None:
    text = (tmp_path / "Other.mo").write_text(
        "package Other partial model Force input Real p; output Real f; end Force; "
        "model None extends Force; equation f = 0; end None; "
        "model Part output Real y(start=0, fixed=true); replaceable None force constrainedby Force; "
        "equation force.p = y; der(y) = 1 + force.f; end Part; end Other;"
    )
    assert text
    other = pysim.model("Other.Part", library=tmp_path / "Other.mo")
    try:
        with pytest.raises(BadInput, match="say which"):
            pysim.effect("my.drag", **drag())  # type: ignore[arg-type]
        assert pysim.effect("my.drag", model=mass, **drag()).slot == "force"  # type: ignore[arg-type]
    finally:
        opened.remove(other)
    assert np.isfinite(other.simulate(0.1)["y"]).all()
