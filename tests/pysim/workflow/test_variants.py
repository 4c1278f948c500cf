"""A candidate that cannot be built is refused, so that a diagnosis goes on without it."""

from types import SimpleNamespace
from typing import Any

import pytest

import fmu_build
from fmu_build.pack import CompilerError
from pysim.effects import law_class
from pysim.types import BadInput, EffectParameter
from pysim.workflow import Variants
from tests.toy import CATALOGUE, library, with_term

LAW = SimpleNamespace(declarations=[], equations=[], probes=())


@pytest.mark.parametrize("error", [CompilerError("linux: the C compiler failed."), fmu_build.BuildError("too much")])
def test_what_does_not_compile_is_refused(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    def build(name: str, *arguments: Any, **options: Any) -> None:
        asked.append(name)
        raise error

    monkeypatch.setattr(fmu_build, "build", build)
    variants = Variants("Toy.Mass", (library(),))
    for _ in range(2):  # a failure is not kept
        with pytest.raises(BadInput, match=str(error)):
            variants.build([CATALOGUE["toy.friction"]])
    assert len(asked) == 2
    with pytest.raises(BadInput, match=str(error)):
        variants.probed([], [LAW])


def test_each_is_built_once_and_says_where_its_parameters_are() -> None:
    variants = Variants("Toy.Mass", (library(),))
    model, places = variants.build([CATALOGUE["toy.friction"]])
    assert places == {"toy.friction": "force"}
    assert model["force.F_c"].unit == "N"
    assert variants.build([CATALOGUE["toy.friction"]])[0] is model
    assert [slot.name for slot in variants.slots] == ["force"]


def test_a_law_stands_in_its_slot_behind_the_effects_that_are_there() -> None:
    variants = Variants("Toy.Mass", (library(),))
    (force,) = variants.slots
    k_3 = EffectParameter("k_3", "N/m3", 0.0, 100.0, 5.0, 0.0, 0.0)
    text = law_class("Cubic", force, "-k_3*x^3", [k_3], [library()], effect="own.cubic")
    model, places = with_term(variants, text, [CATALOGUE["toy.friction"]])
    assert places == {"toy.friction": "force.first", "own.cubic": "force.second"}
    assert (model["force.second.k_3"].max, model["force.first.F_c"].unit) == (100.0, "N")
    with pytest.raises(BadInput, match="nowhere"):
        with_term(variants, text.replace("-k_3*x^3", "-k_3*nowhere"))
