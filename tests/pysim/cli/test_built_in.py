"""An FMU is diagnosed with the values it was built with, in the candidates too."""

import json
from pathlib import Path

import pytest

from fmu_build import build
from pysim.cli import main
from pysim.cli._built_in import built_in
from pysim.io import read_model, write_dataset
from pysim.types import BadInput
from tests.pysim.diagnose.toy import library, measured

LIBRARY = ["--library", str(library())]


def test_values_that_the_class_has_too_are_not_told(tmp_path: Path) -> None:
    plain = read_model(build("Toy.Mass", tmp_path / "Mass.fmu", libraries=[library()]))
    assert built_in(plain, "Toy.Mass", [library()]) == {}


def test_values_of_its_own_are_told(tmp_path: Path) -> None:
    heavy = read_model(build("Toy.Mass", tmp_path / "Mass.fmu", libraries=[library()], overrides={"m": 1.25}))
    assert built_in(heavy, "Toy.Mass", [library()]) == {"m": 1.25}


def test_what_no_candidate_could_be_given_is_refused(tmp_path: Path) -> None:
    source = tmp_path / "Sized.mo"
    source.write_text(
        "model Sized parameter Integer n = 2; constant Real c = 1; Real x[n]; input Real u; output Real y; "
        "equation for i in 1:n loop der(x[i]) = u - c * x[i]; end for; y = sum(x); end Sized;"
    )
    long = read_model(build("Sized", tmp_path / "Long.fmu", libraries=[source], overrides={"n": 3}))
    with pytest.raises(BadInput, match=r"^Long.fmu: has 3 states, where Sized has 2; effects are added to the class"):
        built_in(long, "Sized", [source])


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
        built_in(one, "Fixed", [source])


def test_a_candidate_differs_from_the_fmu_in_its_effect_alone(tmp_path: Path) -> None:
    """A mass that is held at 1.3 kg in the FMU is held there with friction too: friction off is the FMU."""
    data = tmp_path / "toy"
    write_dataset(data, measured(1))
    fmu = tmp_path / "Mass.fmu"
    build("Toy.Mass", fmu, libraries=[library()], overrides={"m": 1.3})
    words = ["add", str(data), "--effects", "toy.friction", "--free", "d,k", *LIBRARY]
    answers = []
    for model in (["--model", str(fmu)], ["--model", "Toy.Mass", "--set", "m=1.3"]):
        main([*words, *model, "--json", str(tmp_path / "a.json")])
        answers.append(json.loads((tmp_path / "a.json").read_text()))
    by_fmu, by_class = answers
    assert by_fmu["error"][-1]["fit"] == pytest.approx(by_class["error"][-1]["fit"], rel=1e-6)
    assert any("built with values of its own, which every candidate has too: m" in note for note in by_fmu["notes"])
