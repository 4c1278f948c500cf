"""What the front end refuses: each row is a text, the line that is named, and words of the cause and of the cure."""

import re

import pytest

from fmu_build.errors import BuildError
from fmu_build.front.rumoca.failures import UnresolvedName
from tests.fmu_build.lower.compiling import loaded

Row = tuple[str, int, str]


def model(text: str) -> str:
    return f"model M\n{text}\nend M;"


DISCRETE = "Integer n(start = 0, fixed = true); Integer m(start = 0, fixed = true);"
COUNTS = "n = pre(n) + 1; end when;"
CALLED = "function f\n  input Real x;\n  output Real y;\nalgorithm\n{}\nend f;\nReal z = f(time);"
LANGUAGE: list[Row] = [
    ("model M\n  Real x\nequation\n  der(x) = 1;\nend M;", 2, "syntax error: unexpected `x`"),
    ("package P model A\n Real x = (1;\n end A;\n model M\n Real y = 1;\n end M;\nend P;", 2, "syntax error"),
    ("model M\n  Real x;\n  Real y;\nequation\n  der(x) = 1;\nend M;", 1, "unbalanced"),
    ("model M\n  input Real u;\n  Real y;\nequation\n  y = der(u);\nend M;", 5, "der"),
    ('model M\n  Real x = time;\n  String s = "a";\nend M;', 3, "s is a String variable.*make it a parameter"),
    ("model M\n  Real x;\n  Real y;\nequation\n  x = 1;\nend M;", 1, "1 equations for 2 unknowns; add 1"),
    ("model M\n  Real x[2];\nequation\n  x = {1, 2, 3};\nend M;", 4, "dimension"),
    ('model M\n  function f input Real x; output Real y; external "C" y = g(x); end f;\n'
     "  Real y = f(time);\nequation\nend M;", 2, "external"),
    # rumoca would keep the branch of the default value without a word
    ("model M Real x(start = 0, fixed = true); discrete Real a(start = 0); parameter Real limit = 3;\nequation\n"
     "der(x) = 1;\nwhen x > 1 then\nif limit > 2 then a = 1; else a = 2; end if;\nend when;\nend M;",
     5, "if-expression"),
    ("package M end M;", 1, "M is a package; name a model or a block$"),
    ("package M partial model P end P; model N end N; function f end f; end M;", 1,
     r"M is a package; name a model or a block, such as M\.N$"),
    ("\npartial model M\n  Real x;\nend M;", 2, "M is a partial model; name a model"),
]  # fmt: skip
# line 1 is what the message then calls the first of the model
PLAIN_WORDS: list[Row] = [
    (model(text), line, said)
    for text, line, said in (
        ("Real x = time; Integer i; equation i = x;", 1,
         r"types or sizes do not agree in this model \(the line is its first\)"),
        ("Real x; Real y[2] = fill(time, 2); equation x = y*{1, 2, 3};", 1, "types or sizes do not agree"),
        ("Real y = sum(cross({1, 0, 0}, {0, 1, 0}))*time;", 1, r"write 1\.0 instead of 1"),
        ("Real y = delay(time, 1);", 2, r"write 1\.0 instead of 1"),
        ('Real y = time;\nparameter Real K(unit = "m3/(s.Pa0.5)") = 1;', 3, r"unit of K .*Q_n\*sqrt\(dp/dp_n\)"),
        ('parameter Real K(unit = "m3/s/Pa0.5") = 1;', 2, r"unit of K .*use parentheses; .*Q_n\*sqrt\(dp/dp_n\)"),
        ("type E = enumeration(a, b); E e = if time > 1 then E.a else E.b; Integer i; equation i = Integer(e);", 1,
         r"Integer\(e\) is not supported, compare e"),
        (f"input Boolean u; {DISCRETE} equation m = 1; when edge(u) then {COUNTS}", 1,
         r"Boolean inside = u.*edge\(inside\)"),
        (f"input Integer u; {DISCRETE} equation m = 1; when change(u) then {COUNTS}", 1, r"change\(inside\)"),
        (f"input Boolean u; {DISCRETE} equation m = 1; when time > 1 and pre(u) then {COUNTS}", 1,
         r"pre\(\) of the input u .*Boolean inside = u"),
        ("Integer n[2](each start = 0); equation for i in 1:2 loop when time > i then n[i] = 1; end when; end for;",
         1, r"single element n\[1\].*set all of n"),
        ("Real x[2](each start = 0); equation der(x) = {1, 1}; when x[2] > 1 then reinit(x[2], 0); end when;", 1,
         r"single element x\[2\].*reinit\(x, \{\.\.\.\}\)"),
        ("Real y; Real z; algorithm y := time; z := 2*y;", 1,
         "only one continuous variable.*algorithm section for each"),
        ("Real y; algorithm y := 0; for i in 1:3 loop y := y + i*time; end for;", 1, "only one continuous variable"),
        ("function f input Real x; output Real y; algorithm y := 0; for i in {1, 3} loop y := y + i*x; end for; end f;"
         " Real z = f(time);", 1, "loop in function f .* for i in 1:2:5"),
        (f"Real x = time; {DISCRETE} algorithm when sample(0, 0.1) then n := pre(n) + 1; "
         "if n > 3 then n := 0; m := 1; end if; end when;", 1, "write equations: variable = if"),
        (CALLED.format("if x > 1 then\n  y := 1;\nelseif x > 0 then\n  y := 2;\nend if;"), 2,
         "without a value .* on every path"),
        (CALLED.format('y := x;\nassert(x < 1, "a");'), 7, "assert in a function is not supported"),
    )
]  # fmt: skip
MISREAD = """package P
  type Temperature = Real(unit = "K");
  model Part parameter Real k = 1; Real y = k*time; end Part;
  model Pair Part b[2]; end Pair;
  model Wide parameter Real w[2] = {1, 2}; Real y = w[1]*time; end Wide;
  model One Wide b; end One;
  model Inside
    %s
  end Inside;
  model M %s Inside inside; end M;
end P;
"""
MISCOUNTED: list[Row] = [
    (MISREAD % texts, line, said)
    for texts, line, said in (
        (("outer Real T; Real y = T;", "inner Real T = time;"), 8, "outer Real T is a plain variable"),
        (("outer Temperature T; Real y = T;", "inner Temperature T = time;"), 8, "outer Temperature T is a plain"),
        (("Pair v[2](each b(k = {8, 9}));", ""), 8, "each in front .* leave each out"),
        # an each that is followed is not to blame
        (("One v[2](each b(w = {8, 9})); Integer i; equation i = time;", ""), 10, "types or sizes do not agree"),
    )
]
NAMES = """\
package P
  model Part "pp is not here, nor a part(pp = 3)"
    Real a = 1; // nor is pp here
  end Part;
  function f input Real x; output Real y;
  algorithm
    y := lost*x;
  end f;
  model M
    parameter Real k = 1;
    %s
    Part part;
    %s
  end M;
  model Base
    Real b = qq;
  end Base;
end P;
"""
STANDARD = "name the Modelica Standard Library too: --library path/to/Modelica$"
NOT_DECLARED = r"motor is a {}, which is in none of the libraries; {}"
UNRESOLVED: list[Row] = [
    (NAMES % ("", below), line, said)
    for below, line, said in (
        ("Real x = pp;", 13, "'pp'"),
        ("Real x(start = 1);\n  equation\n    der(x) = -k*x\n      + pp;", 16, "'pp'"),
        ("Prt part2;", 13, "'Prt'"),
        ("Real y = part.a + square(k);", 13, "'square'"),
        ("Real y = Oil.rho;", 13, "'Oil.rho'"),
        ("extends Bse;", 13, "Bse"),
        ("import Nowhere.Bar;", 13, "'Nowhere.Bar'"),
        ("Real y; equation\n    y =\n    .Nowhere.c;", 15, "Nowhere.c"),
        ("extends Base;", 16, "'qq'"),
        ("Base base;", 16, "'qq'"),
        ("Real y = f(k);", 7, "'lost'"),
        ("Drives.Motor motor;\n  Real w = k*motor.flange.w;", 13,
         NOT_DECLARED.format("Drives.Motor", "name its library with --library")),
        ("Modelica.Mechanics.Rotational.Components.Fixed motor;\n  Real w = k*motor.flange.w;", 13,
         NOT_DECLARED.format("Modelica.Mechanics.Rotational.Components.Fixed", STANDARD)),
    )
] + [
    (NAMES % texts, 11, STANDARD)
    for texts in (
        ("Modelica.Units.SI.Temperature T = 3;", ""),
        ("Real x = Modelica.Constants.pi;", ""),
        ("import Modelica.Units.SI;", "SI.Temperature T = 3;"),
        ("extends Modelica.Icons.Example;", ""),
    )
]  # fmt: skip


def refused(text: str) -> BuildError:
    with pytest.raises(BuildError) as caught:
        loaded(text, "P.M" if text.startswith("package P") else "M")
    assert caught.value.file is not None
    assert str(caught.value).startswith(f"{caught.value.file}:{caught.value.line}: ")
    return caught.value


@pytest.mark.parametrize(("text", "line", "said"), [*LANGUAGE, *PLAIN_WORDS, *MISCOUNTED, *UNRESOLVED])
def test_refused_with_its_line_and_the_cure(text: str, line: int, said: str) -> None:
    error = refused(text)
    assert re.search(said, error.message)
    assert error.file is not None
    assert (error.file.name, error.line) == ("M.mo", line)
    # a name that is nowhere is an error of its own kind: another compiler cannot help, another library may
    assert isinstance(error, UnresolvedName) == ((text, line, said) in UNRESOLVED)
    assert ("--library" in error.message) == ("librar" in said)


def test_what_is_missing_in_something_declared_may_be_known_to_another_compiler() -> None:
    error = refused(NAMES % ("", "Real y = part.b;"))
    assert error.line == 13
    assert not isinstance(error, UnresolvedName)


@pytest.mark.parametrize(
    "text",
    [
        model(f"input Boolean u; Boolean inside = u; {DISCRETE} equation m = 1; when edge(inside) then {COUNTS}"),
        model("Real y; Real z; algorithm y := time; algorithm z := 2*y;"),
        model("Real x[2](each start = 0); equation der(x) = {1, 1}; when x[2] > 1 then reinit(x, {0, 0}); end when;"),
        model("Real y = delay(time, 1.0);"),
        MISREAD % ("outer Part T; Real y = T.y;", "inner Part T;"),
        MISREAD % ("outer parameter Real T; Real y = T;", "inner parameter Real T = 3;"),
        MISREAD % ("Pair v[2](b(k = {{8, 9}, {8, 9}}));", ""),
        MISREAD % ("One v[2](each b(w = {8, 9}));", ""),
    ],
)
def test_a_cure_and_a_neighbour_of_a_refusal_are_taken(text: str) -> None:
    name = "P.M" if text.startswith("package") else "M"
    assert loaded(text, name).name == name
