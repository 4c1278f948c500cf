"""An FMU is diagnosed with the values it was built with, in the candidates too."""

from pathlib import Path

import pytest

import pysim
from fmu_build import build
from pysim.cli.steps import read_parts
from pysim.io import read_model
from pysim.nouns.model import Model
from pysim.types import BadInput
from pysim.workflow import session_of
from pysim.workflow.built_in import built_in
from tests.pysim.cli.ran import parsed
from tests.toy import library, measured

FORCE = 3.0  # N


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


def soft(folder: Path) -> Model:
    """A mass whose spring has 12 N/m in the FMU, and 20 N/m in its class."""
    fmu = build("Toy.Mass", folder / "Soft.fmu", libraries=[library()], overrides={"k": 12.0})
    return pysim.model(fmu, library=library())


def spring(model: Model) -> float:
    """Its rate in N/m, from where a force leaves the mass once it is still."""
    return FORCE / float(model.simulate(60.0, F=FORCE)["x"][-1])


def test_a_model_with_effects_has_the_values_of_its_fmu(tmp_path: Path) -> None:
    model = soft(tmp_path)
    assert spring(model.with_effects("toy.hardening")) == pytest.approx(12.0, rel=1e-4)
    assert model.with_effects("toy.hardening").free_names == ("m", "d", "k", "force.k_3")
    for later in (model.set(k=15.0).with_effects("toy.hardening"), model.with_effects("toy.hardening").set(k=15.0)):
        assert spring(later) == pytest.approx(15.0, rel=1e-4)


@pytest.mark.parametrize(("values", "rate"), [({}, 12.0), ({"k": 15.0}, 15.0)])
def test_a_model_that_is_written_has_the_values_of_its_fmu(
    tmp_path: Path, values: dict[str, float], rate: float
) -> None:
    files = soft(tmp_path).set(**values).export(tmp_path / "out")
    assert spring(pysim.model(files["fmu"])) == pytest.approx(rate, rel=1e-4)


def test_the_model_of_an_answer_has_the_values_of_its_fmu(tmp_path: Path) -> None:
    """Spring and damper are those of the plant in the FMU, and not in the class; the mass is refitted."""
    fmu = build("Toy.Mass", tmp_path / "Known.fmu", libraries=[library()], overrides={"d": 0.75, "k": 21.0})
    model, data = pysim.model(fmu, library=library()).free("m"), measured(1, "toy.friction", F_c=0.4)
    why = pysim.diagnose(model, data, effects=["toy.friction"])
    assert why.verdict == "toy.friction"
    assert spring(why.model.set(**{"force.F_c": 0.0})) == pytest.approx(21.0, rel=1e-4)
    assert pysim.compare(why.model, data).table["x noise"] == pytest.approx([1.0, 1.0], abs=0.1)
