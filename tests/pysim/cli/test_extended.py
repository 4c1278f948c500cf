"""The class that is written for the user: named after theirs, its limits told, compiled again from its folder."""

import shlex
import shutil
import sys
from dataclasses import replace
from pathlib import Path

import pytest

import pysim.cli
from fmu_build import build
from fmu_build.cli import main as fmu_build_main
from pysim.cli._extended import extended_name, relative_files, write_extended
from pysim.cli._options import parameters_of
from pysim.cli._outputs import quoted
from pysim.cli._subject import Given
from pysim.cli._variants import Variants
from pysim.diagnose import diagnose
from pysim.io import read_model
from pysim.types import Diagnosis
from tests.pysim.diagnose.toy import CATALOGUE, library, measured, toy_subject


@pytest.fixture(scope="module")
def found() -> Diagnosis:
    return diagnose(toy_subject(measured(1, "toy.friction", F_c=0.4)))


def given() -> Given:
    data = measured(1, "toy.friction", F_c=0.4)
    return Given(toy_subject(data), data, Variants("Toy.Mass", [library()]), {}, (library(),))


def test_the_class_holds_the_fitted_values_and_compiles_from_its_folder(found: Diagnosis, tmp_path: Path) -> None:
    files = write_extended(found, given(), tmp_path)
    name = "MassWithRubbing"
    assert {path.name for path in files.values()} == {f"{name}.mo", f"{name}.fmu", "parameters.toml"}
    text = files["modelica"].read_text()
    assert "extends Toy.Mass(" in text
    assert "redeclare Toy.Rubbing force(F_c=0.4" in text
    again = read_model(build(name, tmp_path / "again.fmu", libraries=[library(), files["modelica"]]))
    fitted = {e.name: e.value for e in found.parameters}
    assert set(fitted) == {"m", "d", "k", "force.F_c"}
    for model in (again, read_model(files["fmu"])):
        assert {n: model[n].start for n in fitted} == pytest.approx(fitted, rel=1e-12)
        assert (model["m"].min, model["m"].max) == (0.5, 5)
    assert 'm" = ' in files["parameters"].read_text()


def test_the_header_tells_what_it_is_and_when_not_to_trust_it(found: Diagnosis, tmp_path: Path) -> None:
    head = write_extended(found, given(), tmp_path)["modelica"].read_text().partition("model ")[0]
    words = " ".join(head.replace("//", " ").split())
    assert "MassWithRubbing: Toy.Mass with toy.friction." in words
    assert "beyond what was excited: F from -" in words
    assert "apart" not in words
    weak = replace(found, verdict="unknown", confusable=(("toy.friction", "toy.twin"),))
    data = measured(1, "toy.friction", F_c=0.4)
    alone = replace(given(), dataset=replace(data, records=data.records[:1]))
    words = " ".join(write_extended(weak, alone, tmp_path)["modelica"].read_text().replace("//", " ").split())
    assert "these data do not tell toy.friction, toy.twin apart" in words
    assert "more than noise is left" in words
    assert "no record was held out" in words


@pytest.mark.skipif(sys.platform == "win32", reason="a shell of POSIX takes the line apart")
def test_the_command_in_the_header_works_wherever_it_is_pasted(
    found: Diagnosis, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Folders as they were typed, one with blanks in its name and longer than a line of the comment."""
    typed = Path("my libraries") / ("long " * 20).strip()
    monkeypatch.chdir(tmp_path)
    typed.mkdir(parents=True)
    copied = Path(shutil.copy(library(), typed))
    Path("results").mkdir()
    with monkeypatch.context() as installed:  # by pip, not in the environment that run.py makes
        installed.setattr(sys, "prefix", str(tmp_path))
        head = write_extended(found, replace(given(), libraries=(copied,)), Path("results"))["modelica"].read_text()
    (line,) = (line for line in head.splitlines() if "Compiles by:" in line)
    program, *words = shlex.split(line.partition("Compiles by: ")[2])
    assert program == "fmu-build"
    Path("elsewhere").mkdir()
    monkeypatch.chdir("elsewhere")
    assert fmu_build_main(words) == 0
    assert read_model(Path("MassWithRubbing.fmu"))["force.F_c"].start == pytest.approx(0.4, abs=0.01)


def test_the_command_in_the_header_starts_where_fmu_build_is_at_hand(
    found: Diagnosis, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = Path(pysim.cli.__file__).parents[2]
    monkeypatch.setattr(sys, "prefix", str(root / ".venv"))
    head = write_extended(found, given(), tmp_path)["modelica"].read_text()
    words = ["fmu-build", "MassWithRubbing", "--library", str(tmp_path.resolve() / "MassWithRubbing.mo")]
    assert quoted([str(root / "run.py"), *words]) in head


def test_where_nothing_was_added_the_base_model_has_its_values(found: Diagnosis, tmp_path: Path) -> None:
    values = tuple(e for e in found.parameters if e.name in "mk")
    nothing = replace(found, verdict="none", added=(), parameters=values)
    data = replace(measured(1, "toy.friction", F_c=0.4), name="of\nMay = 5")
    files = write_extended(nothing, replace(given(), dataset=data, overrides={"d": 0.8}), tmp_path)
    assert files == {"parameters": tmp_path / "parameters.toml"}
    assert list(tmp_path.iterdir()) == [tmp_path / "parameters.toml"]
    assert parameters_of(files["parameters"]) == {e.name: e.value for e in values}
    head = files["parameters"].read_text().splitlines()[0]
    assert head == "# Of Toy.Mass, refitted to data set of May = 5. They hold with what was set: d = 0.8."


def test_the_values_of_the_extended_class_say_whose_they_are(found: Diagnosis, tmp_path: Path) -> None:
    head = write_extended(found, given(), tmp_path)["parameters"].read_text().splitlines()[0]
    assert head.startswith("# Of MassWithRubbing, the class in MassWithRubbing.mo, fitted to data set ")


def test_where_nothing_was_refitted_nothing_is_written(found: Diagnosis, tmp_path: Path) -> None:
    nothing = replace(found, verdict="unknown", added=(), parameters=())
    assert write_extended(nothing, given(), tmp_path) == {}
    assert list(tmp_path.iterdir()) == []


def test_names_and_paths(tmp_path: Path) -> None:
    assert extended_name("A.B.Pump", ["X.Deadband", "Y.Bias"]) == "PumpWithDeadbandAndBias"
    assert relative_files({"a": tmp_path / "out" / "a.png"}, tmp_path) == {"a": "out/a.png"}
    assert CATALOGUE["toy.friction"].class_name == "Toy.Rubbing"
