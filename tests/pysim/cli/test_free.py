"""Which parameters a command refits: those that are named, have bounds, and were not set."""

import json
from pathlib import Path

import pytest

from pysim.cli import main
from pysim.cli._free import free_parameters
from pysim.io import write_dataset
from pysim.types import BadInput
from tests.pysim.diagnose.toy import base, library, measured

MODEL = ["--model", "Toy.Mass", "--library", str(library())]


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Logs of a plant that is the model with other parameters."""
    folder = tmp_path_factory.mktemp("data") / "toy"
    write_dataset(folder, measured(1))
    return folder


def compared(words: list[str], tmp_path: Path, end: int = 0) -> dict:
    assert main(["compare", *words, "--json", str(tmp_path / "a.json")]) == end
    return json.loads((tmp_path / "a.json").read_text())


def test_what_a_fit_found_is_compared(data: Path, tmp_path: Path) -> None:
    """Every parameter with bounds is in the file, so nothing is left to be free."""
    out = tmp_path / "fit"
    assert main(["fit", str(data), *MODEL, "--free", "m,d", "--free", "k", "--output", str(out)]) == 0
    found = compared([str(data), *MODEL, "--parameters", str(out / "parameters.toml")], tmp_path)
    (prior,) = found["error"]
    assert prior["fit"] == pytest.approx(1.0, abs=0.1)
    assert found["conditions"]["free parameters"] == "none"
    assert found["parameters"] == {}


def test_the_others_are_refitted_beside_what_was_set(data: Path, tmp_path: Path) -> None:
    found = compared([str(data), *MODEL, "--set", "m=1.05", "--refit"], tmp_path)
    assert set(found["parameters"]) == {"d", "k"}
    assert found["error"][-1]["fit"] == pytest.approx(1.0, abs=0.1)


def test_an_fmu_without_bounds_is_compared(data: Path, foreign: Path, tmp_path: Path) -> None:
    """As the FMU with bounds is: nothing is refitted in either."""
    by_name = compared([str(data), *MODEL], tmp_path)
    without = compared([str(data), "--model", str(foreign)], tmp_path)
    assert without["error"][0]["fit"] == pytest.approx(by_name["error"][0]["fit"], rel=1e-4)
    assert without["parameters"] == {}
    assert not any("without bounds" in note for note in without["notes"])


def test_bounds_alone_make_free(data: Path, foreign: Path, tmp_path: Path) -> None:
    bounds = [word for text in ("m=0.5:5", "k=1:100") for word in ("--bounds", text)]
    found = compared([str(data), "--model", str(foreign), "--refit", *bounds], tmp_path)
    assert set(found["parameters"]) == {"m", "k"}


def test_what_a_fit_found_is_where_the_refit_begins(data: Path, tmp_path: Path) -> None:
    """Named with `--free`, values of `--parameters` are no longer held; as they were found they come out again."""
    values = tmp_path / "parameters.toml"
    values.write_text("m = 1.3\nd = 0.4\n")
    words = [str(data), *MODEL, "--parameters", str(values)]
    as_is = compared(words, tmp_path, 1)["error"][0]["fit"]
    held = compared([*words, "--refit"], tmp_path, 1)
    assert set(held["parameters"]) == {"k"}
    assert any("held as set, not refitted: m, d; --free refits them from there" in note for note in held["notes"])
    begun = compared([*words, "--free", "m,d,k", "--refit"], tmp_path)
    assert set(begun["parameters"]) == {"m", "d", "k"}
    assert begun["error"][0]["fit"] == pytest.approx(as_is, rel=1e-6)
    assert held["error"][-1]["fit"] > 1.5 > begun["error"][-1]["fit"]


def test_what_is_set_is_refitted_where_it_is_named_or_has_bounds() -> None:
    assert free_parameters(base(), ["d", "m"], {}, {"m": 1.0}) == ("d", "m")
    assert free_parameters(base(), [], {"m": (1.0, 2.0)}, {"m": 1.0, "d": 1.0}) == ("m", "k")
    with pytest.raises(BadInput, match="none is left to refit; name with --free those to refit from there"):
        free_parameters(base(), [], {}, {"m": 1.0, "d": 1.0, "k": 1.0})


def test_free_are_those_of_the_model_and_those_with_bounds() -> None:
    assert free_parameters(base(), [], {}, {"d": 1.0}) == ("m", "k")
    assert free_parameters(base(), [], {"x": (0.0, 1.0)}, {}) == ("m", "d", "k", "x")
    assert free_parameters(base(), ["k"], {}, {}) == ("k",)
