"""A command as data: what its options become, what is written, and the line that repeats it."""

import json
import shlex
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from pysim.cli import main
from pysim.cli.command import Command, Given
from pysim.cli.option import Role, argument, choice, file, number, switch, text
from pysim.cli.options import JSON, OUTPUT
from pysim.present import Drawing, Picture
from pysim.present.report import MARKER, VIEWS
from pysim.present.style import new_figure
from pysim.types import BadInput

SEEN: list[Given] = []


@dataclass(frozen=True)
class Level:
    """What is found."""

    level: float
    fast: bool


def run(given: Given) -> Level:
    SEEN.append(given)
    return Level(given.level, given.fast)


COMMAND = Command(
    "try",
    "Try it.",
    run,
    options=(
        argument("PLACE", "where", convert=Path, role=Role.READ, read=lambda given: given.typed["place"].name),
        number("--level", "V", 0.5, "how high"),
        number("--count", "N", 2, "how many", convert=int),
        choice("--way", "up", ("up", "down"), "which"),
        text("--name", "NAME", "whose", repeated=True),
        switch("--fast", "or slow"),
        file("--more", "FILE", "further numbers", suffixes=(".npz",)),
        JSON,
        OUTPUT,
    ),
    passes=lambda result: not result.fast,
)


def figures(result: Level) -> Iterator[Picture]:
    figure = new_figure(1.0, 1.0)
    figure.subplots()
    yield Picture("square", "A square.", figure)


def data(result: Level) -> dict[str, Any]:
    return {"level": result.level}


def page(result: Level, drawings: Sequence[Drawing], redo: str) -> str:
    return f"{len(drawings)} {redo}"


def files(result: Level) -> dict[str, str]:
    return {"level.txt": str(result.level)}


@pytest.fixture(autouse=True)
def known(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    here = sys.modules[__name__]
    monkeypatch.setattr(here, "text", lambda result: f"level {result.level}")
    monkeypatch.setitem(VIEWS, "Level", __name__)
    monkeypatch.setitem(sys.modules, __name__, here)
    monkeypatch.setattr(sys.modules["pysim.cli.main"], "registry", lambda: {"try": COMMAND})
    monkeypatch.chdir(tmp_path)
    SEEN.clear()


def test_values_are_converted_and_read_when_they_are_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["try", "a/b", "--count", "3", "--name", "x", "--name", "y"]) == 0
    (given,) = SEEN
    assert (given.place, given.typed["place"], given.count, given.level) == ("b", Path("a/b"), 3, 0.5)
    assert (given.name, given.fast, given.way, given.json) == (["x", "y"], False, "up", None)
    assert capsys.readouterr().out == "level 0.5\n"


def test_the_answer_no_is_exit_1() -> None:
    assert main(["try", "a", "--fast"]) == 1


def test_all_that_was_asked_for_is_written_and_replaced_whole(tmp_path: Path) -> None:
    words = ["try", "a", "--json", "out/n.json", "--output", "out"]
    for level in ("1", "2"):
        assert main([*words, "--level", level]) == 0
        assert json.loads(Path("out/n.json").read_text()) == {"level": float(level)}
        assert Path("out/level.txt").read_text() == f"{level}.0"
    expected = {"n.json", "level.txt", "square.png", "square.svg", "report.html", MARKER}
    assert {path.name for path in Path("out").iterdir()} == expected
    assert Path("out/report.html").read_text().startswith("1 ")


def test_a_refusal_leaves_no_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(given: Given) -> Level:
        assert given.output.is_dir()  # it was seen before that it can be written to
        raise BadInput("no such model")

    monkeypatch.setattr(sys.modules["pysim.cli.main"], "registry", lambda: {"try": replace(COMMAND, run=refuse)})
    (tmp_path / "there").mkdir()
    for out in ("new/out", "there", "there/out"):
        assert main(["try", "a", "--output", out, "--json", "numbers/of/a.json", "--more", f"{out}/more.npz"]) == 2
    assert [*tmp_path.rglob("*")] == [tmp_path / "there"]


@pytest.mark.parametrize(
    ("words", "again"),
    [
        (["a b"], ["a b"]),
        (["--level", "0.50", "a"], ["a"]),
        (["--level=-1e3", "a", "--fast"], ["a", "--level=-1e3", "--fast"]),
        (["a", "--name", "x", "--name", "y", "--way", "up"], ["a", "--name", "x", "--name", "y"]),
    ],
)
def test_the_line_to_repeat_it_has_what_is_not_the_default(words: list[str], again: list[str]) -> None:
    main(["try", *words])
    line = shlex.split(SEEN[0].repeated)
    assert line[line.index("try") + 1 :] == again
    main(line[line.index("try") :])
    assert SEEN[1].typed == SEEN[0].typed


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["a", "--levle", "1"], "no option --levle; did you mean --level?"),
        (["a", "--level", "1,5"], "'1,5' is no number; write a point in place of the comma: 1.5"),
        (["a", "--count", "1.5"], "'1.5' is no whole number"),
        (["a", "--way", "dwon"], "'dwon' is none of up, down; did you mean down?"),
        (["a", "--more", "x.csv"], "--more x.csv: the suffix chooses the form; write one of .npz"),
        (["a", "--json", "."], "--json .: this is a folder; name a file in it"),
        (["a", "--output", "foreign"], "mine.txt is there, which is no part of an earlier answer"),
    ],
)
def test_mistakes_are_said_before_it_runs(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    Path("foreign").mkdir()
    Path("foreign/mine.txt").write_text("mine")
    assert main(["try", *words]) == 2
    assert said in capsys.readouterr().err.splitlines()[-1]
    assert SEEN == []


def test_parts_are_commands_of_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    both = Command("both", "Two.", parts=(COMMAND, Command("other", "Not this.", lambda given: 7)))
    monkeypatch.setattr(sys.modules["pysim.cli.main"], "registry", lambda: {"both": both})
    assert main(["both", "try", "a", "--count", "5"]) == 0
    assert shlex.split(SEEN[0].repeated)[-5:] == ["both", "try", "a", "--count", "5"]
    assert main(["both", "other"]) == 7
