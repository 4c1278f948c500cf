"""Classes and their declarations, each read from text whose content is known."""

from pathlib import Path

import pytest

from fmu_build.text import ClassText, TextError
from fmu_build.text.classes import read_classes
from fmu_build.text.declarations import Kind, Source


def read(text: str, outer: str = "") -> dict[str, ClassText]:
    return read_classes(Source(Path("M.mo"), text), outer)


def words(tokens: object) -> str:
    return " ".join(token.text for token in tokens)  # type: ignore[attr-defined]


def test_a_class_says_what_it_is() -> None:
    text = """package P "All"
  partial model A "a \\"quoted\\" word"
    model Inner "inside" annotation(experiment(StopTime = 3)); end Inner;
    Real x annotation(Dialog(enable = false));
  equation
    x = time;
    annotation(experiment(StopTime = 2));
  end A;
  model B annotation(Documentation(info = "<html>b</html>")); end B;
  model C Real x annotation(Dialog(enable = false)); end C;
  operator record D "both" end D;
  type E = Real(unit = "m") "a length" annotation(x = 1);
end P;"""
    found = read(text)["P"].classes
    assert [(one.kind, one.description, words(one.annotation)) for one in found.values()] == [
        ("model", 'a "quoted" word', "experiment ( StopTime = 2 )"),
        ("model", "", 'Documentation ( info = "<html>b</html>" )'),
        ("model", "", ""),  # that of the last component is not its own
        ("record", "both", ""),
        ("type", "a length", "x = 1"),
    ]
    inner = found["A"].classes["Inner"]
    assert (inner.full_name, inner.place(inner.start), found["A"].prefixes) == (
        "P.A.Inner",
        (Path("M.mo"), 3),
        {"partial"},
    )
    assert [found["A"].text(one.tokens) for one in found["A"].equations] == ["x = time;"]


DECLARED = """model M
  extends A.B(x = 1, redeclare C d);
  import SI = Modelica.Units.SI;
  import Lib.{one, two};
  parameter Real[3] a[2](each min = 0, unit = "m") = fill(1, 2, 3) "All" + " of it" annotation(Dialog(tab = "t")), b;
  replaceable Part c(k = 2) if on constrainedby Base(k = 1) "Here";
  final constant String s = "not " + "its description" "but this";
  Real y = if y > 0 then 1 else 2 if on;
equation
  y = 1;
end M;
"""


def test_components_extends_and_imports() -> None:
    model = read(DECLARED)["M"]
    base, *imports = (d for d in model.declarations if d.kind is not Kind.COMPONENT)
    assert (base.class_name, list(base.modifiers)) == ("A.B", ["x", "d"])
    assert [(d.name, d.class_name) for d in imports] == [
        ("SI", "Modelica.Units.SI"),
        ("one", "Lib.one"),
        ("two", "Lib.two"),
    ]
    a, b, c, s, y = model.of_kind(Kind.COMPONENT)
    assert (a.name, a.description, words(a.dimensions), a.text(a.value)) == (
        "a",
        "All of it",
        "[ 3 ] [ 2 ]",
        "fill(1, 2, 3)",
    )
    assert {name: words(m.value) for name, m in a.modifiers.items()} == {"min": "0", "unit": '"m"'}
    assert (words(a.annotation), b.name, b.class_name, words(b.dimensions)) == (
        'Dialog ( tab = "t" )',
        "b",
        "Real",
        "[ 3 ]",
    )
    assert (c.constraining, c.description, words(c.modification)) == ("Base", "Here", "( k = 2 ) if on")
    assert (words(s.value), s.description) == ('"not " + "its description"', "but this")
    assert words(y.value) == "if y > 0 then 1 else 2"
    assert not model.is_plain
    assert read("model N extends M(a = 1); annotation(x = 1); end N;")["N"].is_plain


def test_a_file_belongs_where_it_says() -> None:
    text = "\nwithin Lib.Sub;\nmodel M end M;"
    assert read(text, "Lib.Sub")["M"].full_name == "Lib.Sub.M"
    for outer, cure in (("Lib", r"write within Lib;"), ("", "name the folder of that package")):
        with pytest.raises(TextError, match=rf"M\.mo:2: the file says within Lib\.Sub, .*{cure}"):
            read(text, outer)


def test_text_that_ends_too_early_gives_what_can_be_read() -> None:
    for end in range(len("model M"), len(DECLARED)):
        model = read(DECLARED[:end])["M"]
        names = [declaration.name for declaration in model.of_kind(Kind.COMPONENT)]
        assert names[:-1] == ["a", "b", "c", "s", "y"][: len(names[:-1])]


def test_what_an_equation_begins_with_is_no_component() -> None:
    """Declarations end where an equation begins; a short connector is of the class that it names."""
    text = """package P
  connector In = input Real "in";
  model M
    parameter Real p = 1 "a";
    Real x[2], y;
    In u;
  equation
    when sample(0, p) then
      y = u;
    end when;
    for i in 1:2 loop x[i] = if time < p then i else i*time; end for;
    if p > 2 then y = 1; else y = time; end if;
  end M;
end P;"""
    classes = read(text)["P"].classes
    assert [one.name for one in classes["M"].of_kind(Kind.COMPONENT)] == ["p", "x", "y", "u"]
    assert [one.tokens[0].text for one in classes["M"].equations] == ["when", "for", "if"]
    assert [one.class_name for one in classes["In"].of_kind(Kind.EXTENDS)] == ["Real"]
