"""Learned laws become classes: beside an answer, and in a folder of the user's own."""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.effects import STANDARD_LIBRARY, read_catalogue
from pysim.simulate import simulate
from pysim.types import BadInput, Effect, Experiment, Model, Signal
from pysim.types.answer import Diagnosis, FoundEffect, LearnedLaw, Left
from pysim.types.factor import Factor, Form
from pysim.workflow.learned import keep_law, with_classes, with_laws
from pysim.workflow.variants import Variants

PUMP = "HydraulicTestBench.Pump.FreeGreyBox"
KNOTS = np.linspace(-20e-3, 20e-3, 9)
LAW = LearnedLaw(
    "pistonForce", Factor(Form.VARIABLE, "v"), "pistonForce.x", KNOTS, 3e5 * KNOTS, 1e4 * np.eye(9), 0.7, "m", "N.s/m"
)


def answer(law: LearnedLaw, *effects: FoundEffect) -> Diagnosis:
    return Diagnosis(effects, False, Left({}, None, None), (), (), (), (), learned=(law,))


def beside_drag(folder: Path, law: str) -> tuple[Effect, tuple[Path, ...], Diagnosis]:
    """An effect of the user's own in the law's slot, the libraries with it, and the answer that has both."""
    own = folder / "Own.mo"
    own.write_text(f"""model Drag "Drag"
      extends HydraulicTestBench.Interfaces.PartialPistonForce;
      parameter Real c(unit="N.s/m", min=0, max=1e5, nominal=1e3) = 0 "Drag, 0 = off";
    {law}
      annotation(__HydraulicTestBench(effect="own.drag", slot="pistonForce"));
    end Drag;""")
    libraries = (STANDARD_LIBRARY, own)
    drag = next(effect for effect in read_catalogue(*libraries) if effect.name == "own.drag")
    return drag, libraries, with_classes(answer(LAW, FoundEffect(drag, "pistonForce", ())), PUMP, libraries)


def test_an_answer_gets_classes_and_formulas(tmp_path: Path) -> None:
    nowhere = replace(LAW, slot="supplyOfNobody")
    found = Diagnosis((), False, Left({}, None, None), (), (), (), (), learned=(LAW, nowhere))
    one, other = with_classes(found, PUMP, [STANDARD_LIBRARY]).learned
    (tmp_path / "Own.mo").write_text(one.modelica)
    (effect,) = read_catalogue(tmp_path / "Own.mo")
    assert (effect.name, effect.class_name) == ("learned.pistonForce_over_x", "LearnedPistonForceOverX")
    assert effect.law == "f = curve(x, x_k, x_w, c)*v;"
    slope, _, argument = one.formula.partition("*")
    assert (float(slope), argument) == (pytest.approx(3e5, rel=0.02), "x")  # the curve's ends are rounded
    assert other.modelica == ""


def test_a_law_is_kept_once_under_a_name_of_the_users(tmp_path: Path) -> None:
    effect = keep_law(LAW, "my.damping_of_age", PUMP, [STANDARD_LIBRARY], tmp_path / "own")
    assert effect == read_catalogue(tmp_path / "own" / "MyDampingOfAge.mo")[0]
    assert (effect.name, effect.slot) == ("my.damping_of_age", "pistonForce")
    for name, why in (("my.damping_of_age", "already"), ("1.x", "begin with a letter")):
        with pytest.raises(BadInput, match=why):
            keep_law(LAW, name, PUMP, [STANDARD_LIBRARY], tmp_path / "own")
    with pytest.raises(BadInput, match="no slot nothing"):
        keep_law(replace(LAW, slot="nothing"), "my.other", PUMP, [STANDARD_LIBRARY], tmp_path)


def test_an_effect_in_the_slot_of_a_law_becomes_part_of_its_class(tmp_path: Path) -> None:
    """The model with both answers as the plant that has both; a slot takes one class."""
    variants = Variants(PUMP, (STANDARD_LIBRARY,))
    known = {effect.name: effect for effect in read_catalogue(STANDARD_LIBRARY)}
    friction = FoundEffect(known["friction.coulomb"], "pistonForce", ())
    text = with_classes(answer(LAW, friction), PUMP, [STANDARD_LIBRARY])
    (effect,), wider = with_laws(text, variants, tmp_path)
    assert effect.slot == "pistonForce"
    assert {p.name for p in effect.parameters} >= {"F_c", "c[1]", "c[9]"}
    model, places = wider.build([effect])
    place = places[effect.name]
    assert model[f"{place}.F_c"].causality == "parameter"

    alone = keep_law(LAW, "my.damping", PUMP, [STANDARD_LIBRARY], tmp_path / "own")
    only, _ = Variants(PUMP, (STANDARD_LIBRARY, tmp_path / "own" / "MyDamping.mo")).build([alone])
    times = np.linspace(0, 0.4, 81)
    swing = Signal(np.zeros(1), np.array([[0.0, 0.0, 0.0, 0.0]]), np.array([[[0.2, 0.0, 12.0, 0.0]]]))
    runs = {
        "law": (only, {}),
        "law and friction off": (model, {f"{place}.F_c": 0.0}),
        "law and friction": (model, {f"{place}.F_c": 300.0}),
    }
    angle = {
        key: simulate(m, Experiment(times, ("alphaPercent",), {"alphaCMD": swing}).override(**own))["alphaPercent"]
        for key, (m, own) in runs.items()
    }
    assert angle["law and friction off"] == pytest.approx(angle["law"], abs=1e-6)
    assert np.ptp(angle["law and friction"] - angle["law"]) > 1e-3


def test_a_pair_of_effects_in_the_slot_of_a_law_becomes_part_of_its_class(tmp_path: Path) -> None:
    """As the pair alone with the law off, and as the law alone with the pair off; parameters keep their names."""
    known = {effect.name: effect for effect in read_catalogue(STANDARD_LIBRARY)}
    both = [FoundEffect(known[name], "pistonForce", ()) for name in ("friction.coulomb", "spring.preload")]
    found = with_classes(answer(LAW, *both), PUMP, [STANDARD_LIBRARY])
    (effect,), wider = with_laws(found, Variants(PUMP, (STANDARD_LIBRARY,)), tmp_path)
    model, places = wider.build([effect])
    pair, its = Variants(PUMP, (STANDARD_LIBRARY,)).build([one.effect for one in both])
    names = [f"{its[one.effect.name]}.{p.name}" for one in both for p in one.effect.parameters]
    assert {one.name for one in model.variables} >= {*names, f"{places[effect.name]}.c[9]"}
    alone = keep_law(LAW, "my.damping", PUMP, [STANDARD_LIBRARY], tmp_path / "own")
    only, _ = Variants(PUMP, (STANDARD_LIBRARY, tmp_path / "own" / "MyDamping.mo")).build([alone])
    off = {name: 0.0 for name in names if name.endswith((".F_c", ".F_0"))}
    no_law = {f"{places[effect.name]}.c[{k}]": 0.0 for k in range(1, 10)}
    given = dict.fromkeys(off, 200.0)

    def angle(which: Model, values: Mapping[str, float]) -> NDArray[np.float64]:
        swing = Signal(np.zeros(1), np.array([[0.0, 0.0, 0.0, 0.0]]), np.array([[[0.2, 0.0, 12.0, 0.0]]]))
        experiment = Experiment(np.linspace(0, 0.4, 81), ("alphaPercent",), {"alphaCMD": swing})
        return simulate(which, experiment.override(**values))["alphaPercent"]

    assert len(off) == 2
    assert angle(model, off) == pytest.approx(angle(only, {}), abs=1e-6)
    assert angle(model, {**given, **no_law}) == pytest.approx(angle(pair, given), abs=1e-6)
    assert np.ptp(angle(model, off) - angle(model, {**off, **no_law})) > 1e-5
    assert np.ptp(angle(model, given) - angle(model, off)) > 1e-3


def test_an_effect_and_the_curve_in_its_class_may_both_be_called_c(tmp_path: Path) -> None:
    _, libraries, found = beside_drag(tmp_path, "equation f = -c*v;")
    (effect,), wider = with_laws(found, Variants(PUMP, libraries), tmp_path / "better")
    assert [p.name for p in effect.parameters] == ["c", *(f"c_h[{k}]" for k in range(1, 10))]
    model, places = wider.build([effect])
    assert model[f"{places[effect.name]}.c_h[9]"].start == pytest.approx(6e3)


def test_a_law_stays_out_beside_an_effect_that_is_more_than_equations(tmp_path: Path) -> None:
    drag, libraries, found = beside_drag(tmp_path, "algorithm f := -c*v;")
    effects, variants = with_laws(found, Variants(PUMP, libraries), tmp_path / "better")
    assert effects == [drag]
    assert variants.libraries == libraries
    assert not (tmp_path / "better").exists()
