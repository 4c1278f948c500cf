"""Values of a TOML file with the line of their section."""

from pathlib import Path

import pytest

from pysim.io import Section, TomlFile, read_toml
from pysim.types import BadInput

TEXT = """# a comment
[head]
name = "x"

[part.one]
n = 3
flag = true
row = [1, 2.5]
pairs = [[1, 2], [3, 4]]
words = ["a", "b"]
inside = { x = 1.5 }
long = LONG
longs = [1, LONG]

[part . "two words"]
n = -1.5

[[list]]
n = 0
[[list]]
n = 1
""".replace("LONG", "9" * 400)


@pytest.fixture
def toml(tmp_path: Path) -> TomlFile:
    (tmp_path / "x.toml").write_text(TEXT, encoding="utf-8")
    return read_toml(tmp_path / "x.toml", "test")


def test_values(toml: TomlFile) -> None:
    one = toml.tables("part")["one"]
    assert (one.number("n"), one.integer("n"), one.flag("flag", False), one.flag("none", True)) == (3.0, 3, True, True)
    assert (one.numbers("row"), one.pairs("pairs"), one.texts("words")) == ((1, 2.5), ((1, 2), (3, 4)), ("a", "b"))
    assert (one.inner("inside").number("x"), one.inner("none").values) == (1.5, {})
    assert (one.integer("none", 7), one.optional_number("none"), one.positive("none")) == (7, None, None)
    assert [section.number("n") for section in toml.rows("list", "thing")] == [0, 1]
    assert toml.table("head").text("name", among=("x", "y")) == "x"
    assert toml.optional_table("none").values == {}


def test_places(toml: TomlFile) -> None:
    places = [section.place.rpartition(", ")[2] for section in (*toml.tables("part").values(), *toml.rows("list", ""))]
    assert places == ["line 5", "[part.two words]", "line 18", "line 20"]
    assert toml.table("head").place.endswith("x.toml, line 2")


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda s: s.text("n"), "n is missing or no text"),
        (lambda s: s.number("none"), "none is missing; write none = and a number"),
        (lambda s: s.number("long"), f"long = {'9' * 60}... is no finite number; write long = and a number"),
        (lambda s: s.numbers("longs"), "longs is missing or no row of numbers"),
        (lambda s: s.number("flag"), "flag = True is no finite number"),
        (lambda s: s.integer("words"), "words is missing or no whole number"),
        (lambda s: s.integer("n", least=4), "n cannot be below 4, got 3"),
        (lambda s: s.flag("n", True), "n = 3 is neither true nor false"),
        (lambda s: s.numbers("words"), "words is missing or no row of numbers"),
        (lambda s: s.pairs("row"), "row is missing or no row of pairs"),
        (lambda s: s.texts("row"), "row is missing or no row of texts"),
        (lambda s: s.inner("n"), "n = 3 is no table"),
        (lambda s: s.refuse_unknown(("n", "flag")), "the key 'row' is not known; use n, flag"),
    ],
)
def test_refusals_name_the_line(toml: TomlFile, ask: object, words: str) -> None:
    with pytest.raises(BadInput, match=rf"x\.toml, line 5: {words}"):
        ask(toml.tables("part")["one"])  # type: ignore[operator]


@pytest.mark.parametrize(
    ("line", "cure"),
    [
        (r'file = "C:\Users\me\log.csv"', "write / between folders"),
        (r'file = "logs\sine.txt"', "write / between folders"),
        (r"file = logs\sine.txt", "write / between folders"),
        ("unit = %", 'put texts in quotes: unit = "%"'),
        ("unit = 1/s  # a rate", 'put texts in quotes: unit = "1/s"'),
        ("name = Prüf Stand", 'put texts in quotes: name = "Prüf Stand"'),
        ("offset = 25,5", "write offset = 25.5"),
        ("noise = .5", "write noise = 0.5"),
        ('unit = "%', "correct the TOML"),
        ('row = ["a", b]', "correct the TOML"),
        ("row = [1\nb = 3", "correct the TOML"),
    ],
)
def test_the_cure_fits_the_faulty_line(tmp_path: Path, line: str, cure: str) -> None:
    (tmp_path / "bad.toml").write_text(f"a = 1\n{line}\nc = 2\n", encoding="utf-8")
    with pytest.raises(BadInput) as caught:
        read_toml(tmp_path / "bad.toml", "test")
    assert str(caught.value).endswith(f"; {cure}")


def test_signs() -> None:
    section = Section("here", {"a": -1.0, "b": 0})
    with pytest.raises(BadInput, match="here: a must be positive, got -1"):
        section.positive("a")
    with pytest.raises(BadInput, match="here: b must be positive, got 0"):
        section.positive("b")
    with pytest.raises(BadInput, match="here: a cannot be negative, got -1"):
        section.not_negative("a")
    assert section.not_negative("b") == 0.0


def test_missing_parts(toml: TomlFile, tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"x\.toml: the section \[none\] is missing"):
        toml.table("none")
    with pytest.raises(BadInput, match=r"there are no head; add one \[\[head\]\] section per thing"):
        toml.rows("head", "thing")
    (tmp_path / "bad.toml").write_text("a = \n")
    with pytest.raises(BadInput, match=r"bad\.toml: .*line 1.*; correct the TOML"):
        read_toml(tmp_path / "bad.toml", "test")
    with pytest.raises(BadInput, match=r"plan: cannot read .*none\.toml"):
        read_toml(tmp_path / "none.toml", "plan")


def test_a_number_of_thousands_of_digits_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.toml").write_text("n = " + "9" * 5000 + "\n")
    with pytest.raises(BadInput, match=r"x\.toml: .*digits.*; correct the TOML"):
        read_toml(tmp_path / "x.toml", "test")
