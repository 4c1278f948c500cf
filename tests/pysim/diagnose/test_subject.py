"""What is diagnosed: free parameters, bounds, and models that say little of themselves."""

import pytest

from fmu_build import build
from pysim.diagnose import Subject, subject
from pysim.diagnose.subject import extended, identifiable
from pysim.io import read_model
from pysim.types import BadInput, Dataset, Model
from tests.foreign import made_foreign
from tests.pysim.diagnose.toy import base, library, measured, toy_subject

BOUNDS = {"m": (0.5, 5.0), "k": (1.0, 100.0)}


@pytest.fixture(scope="module")
def data() -> Dataset:
    return measured(1)


@pytest.fixture(scope="module")
def foreign(tmp_path_factory: pytest.TempPathFactory) -> Model:
    folder = tmp_path_factory.mktemp("foreign")
    return read_model(made_foreign(build("Toy.Mass", libraries=[library()]), folder / "foreign.fmu"))


def given(model: Model, data: Dataset, **more: object) -> Subject:
    return subject(model, data, (), None, **more)  # type: ignore[arg-type]


def test_without_names_all_that_the_model_bounds_are_free(data: Dataset) -> None:
    found = toy_subject(data)
    assert found.free == identifiable(base()) == ("m", "d", "k")
    assert found.bounds == {}
    assert found.dataset is data


def test_bounds_go_before_those_of_the_model(data: Dataset) -> None:
    space = extended(given(base(), data, free=("m", "d"), bounds={"m": (0.9, 1.2)}), ()).space
    assert (space.lower.tolist(), space.upper.tolist()) == ([0.9, 0.0], [1.2, 10.0])


def test_a_foreign_model_takes_names_and_bounds(data: Dataset, foreign: Model) -> None:
    with pytest.raises(BadInput, match="no parameter min, max and nominal; name those"):
        given(foreign, data)
    found = given(foreign, data, free=("m", "k"), bounds=BOUNDS)
    space = extended(found, ()).space
    assert (space.lower.tolist(), space.upper.tolist(), space.log.tolist()) == ([0.5, 1.0], [5.0, 100.0], [True, True])
    assert not any("without bounds" in note for note in found.notes)


def test_a_parameter_without_bounds_is_told(data: Dataset, foreign: Model) -> None:
    (note,) = (n for n in given(foreign, data, free=("m", "d"), bounds={"m": (0.5, 5.0)}).notes if "bounds" in n)
    assert note.startswith("d: refitted without bounds")


def test_bounds_of_what_is_not_free_are_refused(data: Dataset) -> None:
    with pytest.raises(BadInput, match="k has bounds but is not free; free are m"):
        given(base(), data, free=("m",), bounds=BOUNDS)
