"""What the commands read from their words: one form for a data set and a model, and lists of names."""

from pathlib import Path

import pytest

from pysim.cli.main import argument_parser
from pysim.cli.option import names_of
from tests.pysim.cli.ran import parsed

OWN = {"add": ["--effects", "e"]}


@pytest.mark.parametrize("command", ["add", "compare", "diagnose", "fit", "locate"])
def test_a_data_set_and_its_model_have_one_form(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    typed = parsed([command, "d", "--model", "m.fmu", *OWN.get(command, [])]).typed
    assert typed["model"] == "m.fmu"
    assert typed["dataset"] in (Path("d"), [Path("d")])
    for words, named in ((["d"], "--model"), (["--model", "m"], "DATASET")):
        with pytest.raises(SystemExit) as end:
            argument_parser().parse_args([command, *words, *OWN.get(command, [])])
        assert end.value.code == 2
        assert named in capsys.readouterr().err.splitlines()[-1]


def test_a_fit_takes_several_data_sets() -> None:
    assert parsed(["fit", "a", "b", "--model", "m.fmu"]).typed["dataset"] == [Path("a"), Path("b")]


@pytest.mark.parametrize(
    ("words", "option"),
    [
        (["add", "d", "--model", "m", "--effects", "a,b", "--effects", "c"], "effects"),
        (["locate", "d", "--model", "m", "--with", "a, b", "--with", "c"], "with"),
        (["diagnose", "d", "--model", "m", "--effects", "a", "--effects", "b,c"], "effects"),
        (["fit", "d", "--model", "m", "--free", "a,b", "--free", "c"], "free"),
        (["fit", "d", "--model", "m", "--free", "a", "--signal", "a,b", "--signal", "c"], "signal"),
        (["fit", "d", "--model", "m", "--free", "a", "--profile", "a,b,c"], "profile"),
        (["simulate", "m", "--record", "a,b", "--record", "c"], "record"),
    ],
)
def test_names_are_listed_with_commas_or_one_by_one(words: list[str], option: str) -> None:
    assert getattr(parsed(words), option) == ["a", "b", "c"]


def test_a_comma_within_brackets_belongs_to_the_name() -> None:
    assert names_of(["x[1,2],y,z[3, 4].u"]) == ["x[1,2]", "y", "z[3, 4].u"]
