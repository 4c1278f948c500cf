"""A model and its measurements in either spelling."""

import argparse
from pathlib import Path

import pytest

from pysim.cli._main import argument_parser
from pysim.cli._subject import subject_words

OWN = {"add": ["--effect", "e"], "fit": ["--free", "m"]}


@pytest.mark.parametrize("command", ["add", "compare", "diagnose", "fit", "locate", "rank"])
@pytest.mark.parametrize(
    "words", [["m.fmu", "--data", "d"], ["d", "--model", "m.fmu"], ["--data", "d", "--model", "m.fmu"]]
)
def test_both_spellings_mean_the_same(command: str, words: list[str]) -> None:
    args = argument_parser().parse_args([command, *words, *OWN.get(command, [])])
    assert args.model == "m.fmu"
    assert args.data == ([Path("d")] if command == "fit" else Path("d"))
    assert not hasattr(args, "place")


@pytest.mark.parametrize("words", [[], ["m.fmu"], ["--data", "d"], ["x", "--data", "d", "--model", "m"]])
def test_one_of_each_is_needed(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        argument_parser().parse_args(["diagnose", *words])
    assert end.value.code == 2
    said = capsys.readouterr().err
    assert "usage: pysim diagnose" in said
    assert "one model and its measurements are needed: DATASET --model MODEL or MODEL --data DATASET" in said


def test_a_fit_takes_several_data_sets() -> None:
    args = argument_parser().parse_args(["fit", "m.fmu", "--data", "a", "--data", "b", "--free", "m"])
    assert args.data == [Path("a"), Path("b")]


def names(args: argparse.Namespace, option: str) -> list[str]:
    from pysim.cli._options import names_of

    return names_of(getattr(args, option))


@pytest.mark.parametrize(
    ("words", "option"),
    [
        (["add", "d", "--model", "m", "--effect", "a,b", "--effects", "c"], "effect"),
        (["locate", "d", "--model", "m", "--with", "a, b", "--effect", "c"], "with"),
        (["diagnose", "d", "--model", "m", "--effect", "a", "--effect", "b,c"], "effects"),
        (["rank", "d", "--model", "m", "--effects", "a,b,c"], "effects"),
        (["fit", "m", "--data", "d", "--free", "a,b", "--free", "c"], "free"),
        (["fit", "m", "--data", "d", "--free", "a", "--signal", "a,b", "--signal", "c"], "signal"),
        (["fit", "m", "--data", "d", "--free", "a", "--profile", "a,b,c"], "profile"),
        (["simulate", "m", "--record", "a,b", "--record", "c"], "record"),
    ],
)
def test_names_are_listed_with_commas_or_one_by_one(words: list[str], option: str) -> None:
    assert names(argument_parser().parse_args(words), option) == ["a", "b", "c"]


def test_effects_that_a_model_has_already_are_not_those_to_choose_from(capsys: pytest.CaptureFixture[str]) -> None:
    """`--effects` of `diagnose` and `rank` narrows the catalogue; `locate` does not take it for something else."""
    with pytest.raises(SystemExit):
        argument_parser().parse_args(["locate", "d", "--model", "m", "--effects", "a"])
    assert "unrecognized arguments: --effects a" in capsys.readouterr().err


def test_the_line_that_does_it_again_names_what_the_model_had() -> None:
    args = argument_parser().parse_args(["locate", "d", "--model", "m", "--with", "a,b"])
    assert subject_words(args)[:5] == ["d", "--model", "m", "--with", "a,b"]


def test_a_comma_within_brackets_belongs_to_the_name() -> None:
    args = argument_parser().parse_args(["simulate", "m", "--record", "x[1,2],y,z[3, 4].u"])
    assert names(args, "record") == ["x[1,2]", "y", "z[3, 4].u"]
