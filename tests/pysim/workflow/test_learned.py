"""Learned laws become classes: beside an answer, and in a folder of the user's own."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.effects import STANDARD_LIBRARY, read_catalogue
from pysim.types import BadInput
from pysim.types.answer import Diagnosis, LearnedLaw, Left
from pysim.workflow.learned import keep_law, with_classes

PUMP = "HydraulicTestBench.Pump.FreeGreyBox"
KNOTS = np.linspace(-20e-3, 20e-3, 9)
LAW = LearnedLaw("pistonForce", "v", "pistonForce.x", KNOTS, 3e5 * KNOTS, 1e4 * np.eye(9), 0.7, "m", "N.s/m")


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
