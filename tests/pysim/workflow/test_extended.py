"""The class that is written for the user: named after theirs, its limits told, compiled again from its folder."""

import shlex
import shutil
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from fmu_build.cli import main as fmu_build_main
from pysim.cli.options import parameters_of
from pysim.diagnosis import add
from pysim.io import read_model
from pysim.present.diagnosis.answer import relative_files
from pysim.types import Diagnosis, Effect, Model
from pysim.workflow import (
    LawPlace,
    SessionParts,
    Variants,
    effect_class,
    effects_of,
    model_of,
    session_of,
    session_parts,
    whole_answer,
    write_extended,
)
from pysim.workflow.extended import copied, extended_name, needed
from tests.pysim.diagnosis_answer import LAW
from tests.toy import CATALOGUE, library, measured

NAME = "MassWithRubbing"


class Unbuilt(Variants):
    """Writes what stands ahead of the class, and compiles nothing."""

    def write(
        self,
        effects: Sequence[Effect],
        folder: Path,
        fmu: Path | None,
        name: str = "",
        values: Mapping[str, float] | None = None,
        comment: str = "",
        **_: Any,
    ) -> Any:
        (folder / f"{name}.mo").write_text(comment)


@pytest.fixture(scope="module")
def found() -> Diagnosis:
    return add(session_of(given(Variants)), [CATALOGUE["toy.friction"]])


def given(variants: type[Variants] = Unbuilt) -> SessionParts:
    data = measured(1, "toy.friction", F_c=0.4)
    parts = session_parts(
        model_of("Toy.Mass", [library()]), data, libraries=[library()], bounds={}, values={}, reference_hz=None
    )
    return replace(parts, variants=variants("Toy.Mass", (library(),)))


def head(found: Diagnosis, given: SessionParts, folder: Path) -> str:
    """What stands ahead of the class."""
    return write_extended(found, given, folder)["modelica"].read_text()


@pytest.fixture(scope="module")
def written(found: Diagnosis, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """By a program that pip has installed, into a folder as it was typed, of a library whose folder has blanks."""
    home, typed = tmp_path_factory.mktemp("extended"), Path("my libraries") / ("long " * 20).strip()
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(home)
        patch.setattr(sys, "prefix", str(home))
        typed.mkdir(parents=True)
        Path("results").mkdir()
        copied = Path(shutil.copy(library(), typed))
        files = write_extended(found, replace(given(Variants), libraries=(copied,)), Path("results"))
        return {name: path.resolve() for name, path in files.items()}


def test_the_class_and_its_fmu_hold_the_fitted_values(found: Diagnosis, written: dict[str, Path]) -> None:
    assert {path.name for path in written.values()} == {f"{NAME}.mo", f"{NAME}.fmu", "parameters.toml", library().name}
    text = written["modelica"].read_text()
    assert "extends Toy.Mass(" in text
    assert "redeclare Toy.Rubbing force(F_c=0.4" in text
    fitted = {e.name: e.value for e in found.estimates}
    assert set(fitted) == {"m", "d", "k", "force.F_c"}
    model = read_model(written["fmu"])
    assert {n: model[n].start for n in fitted} == pytest.approx(fitted, rel=1e-12)
    assert (model["m"].min, model["m"].max) == (0.5, 5)
    assert parameters_of(written["parameters"]) == fitted


def command(file: Path) -> list[str]:
    (line,) = (line for line in file.read_text().splitlines() if "Compiles where" in line)
    return shlex.split(line.partition(" by: ")[2])


def compiled_elsewhere(files: Mapping[str, Path], folder: Path) -> Model:
    """What becomes of the files alone in another folder, by the command of the header."""
    for one in files.values():
        shutil.copy(one, folder)
    program, *words = command(files["modelica"])
    assert program == "fmu-build"
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        assert fmu_build_main(words) == 0
    return read_model(folder / f"{words[0]}.fmu")


@pytest.mark.skipif(sys.platform == "win32", reason="a shell of POSIX takes the line apart")
def test_the_command_in_the_header_works_where_the_files_lie(
    found: Diagnosis, written: dict[str, Path], tmp_path: Path
) -> None:
    model = compiled_elsewhere({**written, "fmu": written["modelica"]}, tmp_path)
    fitted = {e.name: e.value for e in found.estimates}
    assert {n: model[n].start for n in fitted} == pytest.approx(fitted, rel=1e-12)
    assert str(written["modelica"].parents[1]) not in written["modelica"].read_text()


@pytest.mark.skipif(sys.platform == "win32", reason="a shell of POSIX takes the line apart")
def test_a_law_that_was_typed_comes_along_with_the_class(tmp_path: Path) -> None:
    place = LawPlace.of("Toy.Mass", "force", [library()])
    law = tmp_path / "laws" / "MyDrag.mo"
    law.parent.mkdir()
    law.write_text(effect_class("my.drag", place.slot, "-F_c*tanh(v/0.02)", {"F_c": (0, 5, 0.3, "N")}, [library()]))
    libraries = [library(), law]
    data = measured(1, "toy.friction", F_c=0.4)
    model = model_of("Toy.Mass", libraries)
    parts = session_parts(model, data, libraries=libraries, bounds={}, values={}, reference_hz=None)
    results = tmp_path / "results"
    results.mkdir()
    files = write_extended(add(session_of(parts), effects_of(["my.drag"], parts)), parts, results)
    assert files["MyDrag"].read_text() == law.read_text()
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    assert compiled_elsewhere(files, elsewhere)["force.F_c"].start == pytest.approx(0.4, rel=0.05)


def test_what_the_class_does_not_use_is_neither_named_nor_copied(tmp_path: Path) -> None:
    """A class is used where it is extended or a part, and where a constant or a function of it is."""
    texts = {
        "Plant": 'model Plant "Not of Spare" extends Base; Part part(k=Lib.k); equation x = f(part.y); end Plant;',
        "Base": "partial model Base output Real x; end Base;",
        "Part": "model Part parameter Real k = 1; Real y = k; end Part;",
        "Lib": "package Lib constant Real k = 2; end Lib;",
        "f": "function f input Real u; output Real y; algorithm y := u; end f;",
        "Spare": "model Spare extends Base; end Spare;",
        "Slip": "model Slip extends",
    }
    for name, text in texts.items():
        (tmp_path / f"{name}.mo").write_text(text)
    found = needed(Variants("Plant", tuple(sorted(tmp_path.glob("*.mo")))), [])
    assert {one.stem for one in found} == {"Plant", "Base", "Part", "Lib", "f"}
    folder = tmp_path / "beside"
    folder.mkdir()
    assert {*copied(found, folder).values()} == {*folder.iterdir()} == {folder / one.name for one in found}


def test_an_effect_that_the_logs_do_not_ask_for_has_no_share_of_the_misfit(found: Diagnosis) -> None:
    """Beside dry friction, which is there, and a bias that is not."""
    both = add(session_of(given(Variants)), [CATALOGUE["toy.friction"], CATALOGUE["toy.bias"]])
    assert {one.effect.name: one.share == 0 for one in both.effects} == {"toy.friction": False, "toy.bias": True}
    assert [one.share for one in found.effects] == [1.0]


def test_the_header_tells_when_not_to_trust_it(found: Diagnosis, tmp_path: Path) -> None:
    """Each weakness of an answer adds a limit."""
    data = measured(1, "toy.friction", F_c=0.4)
    weak = [
        (found, given()),
        (replace(found, complete=False), given()),
        (replace(found, ties=(("toy.friction", "toy.twin"),)), given()),
        (found, replace(given(), dataset=replace(data, records=data.records[:1]))),
    ]
    failing = replace(found, history=(replace(found.history[-1], passes=False),))
    pump = replace(given(), inside=replace(given().inside, is_thesis_pump=True))
    weak += [(whole_answer(failing, one), one) for one in (pump, given())]  # its limits are for its pump alone
    limits = [sum(line.startswith("- ") for line in head(*one, tmp_path).splitlines()) for one in weak]
    assert limits == [limits[0], *[limits[0] + 1] * 4, limits[0]]


def test_more_is_left_where_more_is_left_and_not_where_a_learned_law_leaves_noise(
    found: Diagnosis, tmp_path: Path
) -> None:
    whole, partly, with_law, with_more = (
        set(head(replace(found, learned=laws, complete=complete), given(), tmp_path).splitlines())
        for laws in ((), (LAW,))
        for complete in (True, False)
    )
    (more,) = partly - whole
    assert more in with_more
    assert more not in with_law
    assert len(with_law) == len(with_more)  # what causes the law is open all the same


def test_where_nothing_was_added_the_base_model_has_its_values(found: Diagnosis, tmp_path: Path) -> None:
    """A name with a line break does not end the comment ahead of them."""
    values = tuple(e for e in found.estimates if e.name in "mk")
    nothing = replace(found, effects=(), estimates=values)
    data = replace(measured(1, "toy.friction", F_c=0.4), name="of\nMay = 5")
    files = write_extended(nothing, replace(given(), dataset=data, overrides={"d": 0.8}), tmp_path)
    assert files == {"parameters": tmp_path / "parameters.toml"}
    assert list(tmp_path.iterdir()) == [tmp_path / "parameters.toml"]
    assert parameters_of(files["parameters"]) == {e.name: e.value for e in values}


def test_where_nothing_was_refitted_nothing_is_written(found: Diagnosis, tmp_path: Path) -> None:
    nothing = replace(found, effects=(), estimates=(), complete=False)
    assert write_extended(nothing, given(), tmp_path) == {}
    assert list(tmp_path.iterdir()) == []


def test_names_and_paths(tmp_path: Path) -> None:
    assert extended_name("A.B.Pump", ["X.Deadband", "Y.Bias"]) == "PumpWithDeadbandAndBias"
    assert relative_files({"a": tmp_path / "out" / "a.png"}, tmp_path) == {"a": "out/a.png"}
