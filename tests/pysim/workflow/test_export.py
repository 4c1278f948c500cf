"""A model to take away: what is written runs by itself and gives what the model gave."""

import math
import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest

from pysim.effects import STANDARD_LIBRARY
from pysim.io import read_model
from pysim.present.report import MARKER
from pysim.simulate import Rodas, simulate
from pysim.types import BadInput, Experiment, Model, Signal
from pysim.workflow import Variants, class_in, export_model, model_of, models_in, recorded_of
from pysim.workflow.extended import copied
from tests.known_answers.plants import PLANTS
from tests.toy import CATALOGUE, library

MASS = model_of("Toy.Mass", [library()])
VARIANTS = Variants("Toy.Mass", (STANDARD_LIBRARY, library()))
TIMES = np.linspace(0.0, 2.0, 101)


def answer(model: Model, **values: float) -> np.ndarray:
    run = Experiment(TIMES, ("x",), {"F": Signal.constant(3.0)}, values)
    return np.asarray(simulate(model, run, solver=Rodas(1e-8, 1e-8))["x"])


def test_values_are_part_of_the_class_that_is_written(tmp_path: Path) -> None:
    values = {"m": 1.7, "force.F_c": 0.4}
    files = export_model(MASS, VARIANTS, [CATALOGUE["toy.friction"]], values, tmp_path / "better", fmi=3)
    assert {name: path.name for name, path in files.items()} == {
        "modelica": "MassWithRubbing.mo", "fmu": "MassWithRubbing.fmu", "parameters": "parameters.toml",
        library().stem: library().name,
    }  # fmt: skip
    written = read_model(files["fmu"])
    with_effect, _ = VARIANTS.build([CATALOGUE["toy.friction"]])
    assert written.abilities.fmi == 3
    assert answer(written) == pytest.approx(answer(with_effect, m=1.7, **{"force.F_c": 0.4}), abs=1e-7)


def test_without_effects_the_class_has_the_values_alone(tmp_path: Path) -> None:
    files = export_model(MASS, VARIANTS, [], {"m": 1.7, "x": 0.2}, tmp_path)
    assert files["fmu"].name == "MassFitted.fmu"
    assert answer(read_model(files["fmu"])) == pytest.approx(answer(MASS, m=1.7), abs=1e-7)


def test_an_fmu_of_others_is_copied_as_it_is(tmp_path: Path) -> None:
    files = export_model(MASS, None, [], {"m": np.sqrt(2.0), "x": 0.2}, tmp_path)
    assert files["fmu"].read_bytes() == MASS.path.read_bytes()
    assert tomllib.loads(files["parameters"].read_text()) == {"m": math.sqrt(2.0)}  # what --parameters takes: no state


def test_a_file_of_one_model_needs_no_name(tmp_path: Path) -> None:
    one, two = tmp_path / "One.mo", tmp_path / "Two.mo"
    one.write_text("model One output Real y = 1; end One;")
    two.write_text("package Two model A end A; model B end B; end Two;")
    assert class_in(one) == "One"
    for file, said in ((two, "Two.A, Two.B"), (tmp_path / "none.mo", "none.mo")):
        with pytest.raises(BadInput, match=said):
            class_in(file)


def test_the_models_of_a_library_are_neither_packages_nor_partial_nor_effects() -> None:
    found = models_in([PLANTS["mass"].library, Path("none.mo")])
    assert {*found} == {"Mass.Both", "Mass.Design", "Mass.NoForce"}
    assert found[-1] == "Mass.NoForce"  # the others have slots


def test_a_run_records_what_is_asked_for_else_the_outputs() -> None:
    assert recorded_of(MASS) == ("x", "v")
    assert recorded_of(MASS, ["force.f"]) == ("force.f",)


def test_files_of_the_user_stay_as_they_are_and_ours_are_replaced(tmp_path: Path) -> None:
    mine = tmp_path / "MassFitted.fmu"
    mine.write_text("mine")
    with pytest.raises(BadInput, match=r"MassFitted.fmu is there already .* name another folder"):
        export_model(MASS, VARIANTS, [], {"m": 1.7}, tmp_path)
    assert {path: path.read_text() for path in tmp_path.iterdir()} == {mine: "mine"}
    mine.unlink()
    shutil.copyfile(library(), tmp_path / library().name)  # the same: neither refused nor ours from then on
    for m in (1.7, 1.8):
        files = export_model(MASS, VARIANTS, [], {"m": m}, tmp_path)
        assert tomllib.loads(files["parameters"].read_text()) == {"m": m}
    assert {*(tmp_path / MARKER).read_text().splitlines()} == {"MassFitted.fmu", "MassFitted.mo", "parameters.toml"}


@pytest.mark.parametrize("name", ["Zyl.mo", "deep/Zyl.mo", "file/deep"])
def test_a_place_that_is_no_folder_is_refused_and_nothing_stays(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(BadInput, match=r"name .* folder"):
        export_model(MASS, VARIANTS, [], {}, tmp_path / name)
    assert [*tmp_path.rglob("*")] == [tmp_path / "file"]


def test_libraries_of_equal_name_lie_side_by_side_and_compile(tmp_path: Path) -> None:
    texts = {"a": "model Plant extends Base; end Plant;", "b": "partial model Base output Real x = 3; end Base;"}
    for place, text in texts.items():
        (tmp_path / place).mkdir()
        (tmp_path / place / "Lib.mo").write_text(text)
    libraries = tuple(tmp_path / place / "Lib.mo" for place in texts)
    files = export_model(model_of("Plant", libraries), Variants("Plant", libraries), [], {}, tmp_path / "out")
    kept = {files["Lib"].read_text(), files["Lib-2"].read_text()}
    assert kept == {*texts.values()}
    again = model_of("PlantFitted", [path for path in files.values() if path.suffix == ".mo"])
    assert simulate(again, Experiment(TIMES, ("x",))).values.tolist() == [[3.0]] * TIMES.size
    assert copied([libraries[0]], tmp_path / "out", "LIB.mo")[libraries[0]].name == "Lib-2.mo"
