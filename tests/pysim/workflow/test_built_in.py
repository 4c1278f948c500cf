"""An FMU is diagnosed with the values it was built with, in the candidates too."""

from pathlib import Path

import pytest

from fmu_build import build
from pysim.cli.steps import read_parts
from pysim.io import read_model
from pysim.types import BadInput
from pysim.workflow import session_of
from pysim.workflow.built_in import built_in
from tests.pysim.cli.ran import parsed
from tests.toy import library


def test_values_that_the_class_has_too_are_not_told(tmp_path: Path) -> None:
    plain = read_model(build("Toy.Mass", tmp_path / "Mass.fmu", libraries=[library()]))
    assert built_in(plain, [library()]) == {}


def test_values_of_its_own_are_told(tmp_path: Path) -> None:
    heavy = read_model(build("Toy.Mass", tmp_path / "Mass.fmu", libraries=[library()], overrides={"m": 1.25}))
    assert built_in(heavy, [library()]) == {"m": 1.25}


def test_what_no_candidate_could_be_given_is_refused(tmp_path: Path) -> None:
    source = tmp_path / "Sized.mo"
    source.write_text(
        "model Sized parameter Integer n = 2; constant Real c = 1; Real x[n]; input Real u; output Real y; "
        "equation for i in 1:n loop der(x[i]) = u - c * x[i]; end for; y = sum(x); end Sized;"
    )
    long = read_model(build("Sized", tmp_path / "Long.fmu", libraries=[source], overrides={"n": 3}))
    with pytest.raises(BadInput, match=r"^Long.fmu: has 3 states, where Sized has 2; effects are added to the class"):
        built_in(long, [source])


def test_a_fixed_number_of_another_value_is_refused(tmp_path: Path) -> None:
    source = tmp_path / "Fixed.mo"
    text = "model Fixed constant Real c = 1; input Real u; output Real y(start = 0); "
    text += "equation der(y) = u - c * y; end Fixed;"
    source.write_text(text)
    one = read_model(build("Fixed", tmp_path / "One.fmu", libraries=[source]))
    source.write_text(text.replace("c = 1", "c = 2"))
    with pytest.raises(
        BadInput, match=r"^One.fmu: built with c = 1, where Fixed has 2; effects are added to the class"
    ):
        built_in(one, [source])


def test_candidates_of_an_fmu_have_the_values_that_it_was_built_with(rubbing: Path, tmp_path: Path) -> None:
    """A mass that is held at 1.3 kg in the FMU stays there in every candidate, as with `--set` on the class."""
    fmu = build("Toy.Mass", tmp_path / "Mass.fmu", libraries=[library()], overrides={"m": 1.3})
    words = ["add", str(rubbing), "--effects", "toy.friction", "--free", "d,k", "--library", str(library())]
    for model in (["--model", str(fmu)], ["--model", "Toy.Mass", "--set", "m=1.3"]):
        parts = read_parts(parsed([*words, *model]))
        assert parts.overrides == {"m": 1.3}
        assert parts.free == ("d", "k")
        assert session_of(parts).data.overrides["m"] == 1.3
