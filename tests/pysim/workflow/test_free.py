"""Which parameters a command refits: those that are named, have bounds, and were not set."""

import json
from pathlib import Path

import pytest

from pysim.cli import main
from pysim.cli.steps import read_parts
from pysim.types import BadInput, NoteCode
from pysim.workflow import SessionParts, free_parameters
from tests.pysim.cli.ran import parsed
from tests.toy import base


def given(*words: str) -> SessionParts:
    """What a command line of `compare --refit` names."""
    return read_parts(parsed(["compare", *words, "--refit"]))


def as_it_is(words: list[str], tmp_path: Path) -> dict[str, float]:
    """The error over noise of a model that is not refitted."""
    assert main(["compare", *words, "--json", str(tmp_path / "a.json")]) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    assert (found["parameters"], found["conditions"]["free parameters"]) == ({}, "none")
    (prior,) = found["error"]
    return {key: prior[key] for key in ("fit", "validate")}


def test_an_fmu_without_bounds_is_compared_as_that_with_bounds(
    rubbing: Path, toy: list[str], foreign: Path, tmp_path: Path
) -> None:
    by_name = as_it_is([str(rubbing), *toy], tmp_path)
    assert as_it_is([str(rubbing), "--model", str(foreign)], tmp_path) == pytest.approx(by_name, rel=1e-4)


def test_the_others_are_refitted_beside_what_was_set(rubbing: Path, toy: list[str]) -> None:
    found = given(str(rubbing), *toy, "--set", "m=1.05")
    assert (found.free, found.overrides) == (("d", "k"), {"m": 1.05})
    assert [note.values for note in found.notes if note.code is NoteCode.HELD_AS_SET] == [{"parameters": "m"}]


def test_bounds_alone_make_free(rubbing: Path, foreign: Path) -> None:
    bounds = [word for text in ("m=0.5:5", "k=1:100") for word in ("--bounds", text)]
    found = given(str(rubbing), "--model", str(foreign), *bounds)
    assert found.free == ("m", "k")
    assert dict(found.bounds) == {"m": (0.5, 5.0), "k": (1.0, 100.0)}


def test_what_a_fit_found_is_where_the_refit_begins(rubbing: Path, toy: list[str], tmp_path: Path) -> None:
    """Named with `--free`, values of `--parameters` are no longer held."""
    values = tmp_path / "parameters.toml"
    values.write_text("m = 1.3\nd = 0.4\n")
    words = [str(rubbing), *toy, "--parameters", str(values)]
    held, begun = given(*words), given(*words, "--free", "m,d,k")
    assert (held.free, held.overrides) == (("k",), {"m": 1.3, "d": 0.4})
    assert (begun.free, begun.overrides) == (("m", "d", "k"), {})
    assert [begun.model[name].start for name in "mdk"] == [1.3, 0.4, 20.0]


def test_what_is_set_is_refitted_where_it_is_named_or_has_bounds() -> None:
    assert free_parameters(base(), ["d", "m"], {}, {"m": 1.0}) == ("d", "m")
    assert free_parameters(base(), [], {"m": (1.0, 2.0)}, {"m": 1.0, "d": 1.0}) == ("m", "k")
    with pytest.raises(BadInput, match="none is left to refit; free those to refit from there"):
        free_parameters(base(), [], {}, {"m": 1.0, "d": 1.0, "k": 1.0})


def test_free_are_those_of_the_model_and_those_with_bounds() -> None:
    assert free_parameters(base(), [], {}, {"d": 1.0}) == ("m", "k")
    assert free_parameters(base(), [], {"x": (0.0, 1.0)}, {}) == ("m", "d", "k", "x")
    assert free_parameters(base(), ["k"], {}, {}) == ("k",)
