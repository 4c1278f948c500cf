"""What cannot be lowered: each row is the body of a model M, the line that is named, and words of cause and cure."""

import re
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load
from fmu_build.lower import lower
from tests.fmu_build.lower.compiling import body, compiled

Row = tuple[str, int, str]
TWICE = "contradict or repeat"
EQUATIONS: list[Row] = [
    ("Real x; Real y; Real z;\nequation\nx = 1;\nx = time;\ny = z;", 4, "singular"),
    ("Real x; Real y;\nequation\nx + y = 1;\nx + y = 2;", 4, TWICE),
    ("Real x; Real y; Real z;\nequation\nx + z = y;\n2*x = time + z;\n3*x = y + time;", 4, TWICE),
    ("parameter Real a = 2; Real x; Real y;\nequation\na*x + sin(a)*y = 1;\n2*a*x + 2*sin(a)*y = time;", 4, TWICE),
    ("input Real u; Real x; Real v;\nequation\nder(x) = v;\nx = u;", 5, "derivative of the input u"),
    ("Real x(start = 0, fixed = true);\ninitial equation\nx = 1;\nequation\nder(x) = 1;", 4,
     "too many initial conditions"),
    ("parameter Real p(fixed = false);\nReal x(start = 0, fixed = true);\nequation\nder(x) = p;", 1,
     "p has fixed = false"),
    ("Real x(start = 0, fixed = true); Real y; discrete Real a(start = 0);\nequation\nder(x) = 1; y = 2*x;\n"
     "when x > 1 then\na = pre(y);\nend when;", 6, "pre of y"),
    ("Boolean a; Boolean b;\nequation\na = not b; b = a;", 1, "cycle|depend on each other"),
    ("parameter Real a = b;\nparameter Real b = a;\nReal x = a*time;\nequation", 1, "cyclic dependency"),
    ("parameter Real t[3] = {1, 2, 3};\nReal x = t[4]*time;\nequation", 3, "1 to 3|bounds|range"),
]  # fmt: skip
DECAY = "Real x(start = 1, fixed = true);\nequation\nder(x) = -x;"
BOUNDS: list[Row] = [
    (f"{declarations}\n{DECAY}", line, said)
    for declarations, line, said in (
        ("parameter Real p(min = 0, max = 1) = 2;", 2, "p of M: its value 2 is above max = 1"),
        ('parameter Real p(unit = "m", min = 0.5) = 0.25;', 2, "p of M: its value 0.25 m is below min = 0.5 m"),
        ("parameter Real a = 1;\nparameter Real p(min = 3*a, max = 2*a) = 2;", 3, "min = 3 is larger than max = 2"),
        ("parameter Integer p(max = 3) = 4;", 2, "its value 4 is above max = 3"),
        ("parameter Real p[2](each max = 1) = {0.5, 1.5};", 2, r"p\[2\] of M: its value 1.5 is above"),
    )
] + [
    (f"Real y(start = -1, fixed = true, min = 0);\n{DECAY}\nder(y) = 0;", 2, "y of M: its value -1 is below min = 0"),
    (f"type Share = Real(min = 0, max = 1);\nparameter Share s = 1.5;\n{DECAY}", 3, "its value 1.5 is above max = 1"),
]
VALUES: list[Row] = [
    ("parameter Real p;\nReal x = p*time;", 2, r"p has no value; .* --set p="),
    ('parameter Real p(unit = "m");\nReal x = p*time;', 2, r"p has no value; .* --set p="),
] + [
    (f"input Real v;\ninput Real u = {value};\n{DECAY[:-2]}u + v;", 3,
     r'the input u is declared with a value.*take "input" away')
    for value in ("3*time", "if time > 1 then 2 else 1", "v", "x")
]  # fmt: skip
POWERS: list[Row] = [
    ("parameter Real A[2,2] = {{1, 2}, {3, 4}}; parameter Real C[2,3] = ones(2, 3);\n"
     f"parameter Integer n = 2; Real y;\nequation\ny = sum({power});", 5, said)
    for power, said in (
        ("A^n", "make the parameter final"),
        ("A^(-1)", "whole number from 0 on"),
        ("A^0.5", "must be a scalar Integer"),
        ("C^2", "must be a square matrix"),
    )
]  # fmt: skip
TEXTS: list[Row] = [
    (f'parameter String mode = "fast"; parameter Integer k = 2;\nReal y = if {condition} then 1 else 0;', 3,
     "texts are joined.*use an Integer or an enumeration")
    for condition in ('mode < "slow"', 'String(k) == "2"', '"k = " + String(k) <> "k = 2"')
]  # fmt: skip
INDEX: Row = (
    "function f input Integer n; output Real y; protected Real v[3];\nalgorithm v := {1, 2, 3};\n"
    "v[{n, 1}] := {7, 8};\ny := v[1]; end f;\ninput Integer n(start = 2); Real y = f(n);",
    4,
    "depends on n, which can still change; make it final or a constant",
)


@pytest.mark.parametrize(("text", "line", "said"), [*EQUATIONS, *BOUNDS, *VALUES, *POWERS, *TEXTS, INDEX])
def test_refused_with_its_line_and_the_cure(text: str, line: int, said: str) -> None:
    with pytest.raises(BuildError) as caught:
        body(text)
    assert re.search(said, caught.value.message)
    assert caught.value.file is not None
    assert (caught.value.file.name, caught.value.line) == ("M.mo", line)


def test_a_bound_of_a_type_holds_for_variables_of_a_part() -> None:
    text = f"package M model Part type S = Real(max = 1); parameter S s = 1.5; {DECAY} end Part; end M;"
    with pytest.raises(BuildError, match=r"s of M.Part: its value 1.5 is above max = 1"):
        compiled(text, "M.Part")


@pytest.mark.parametrize(
    "text",
    [
        f"parameter Real p(min = 0, max = 0.1*3) = 0.3; {DECAY}",  # on its bound, whatever rounding makes of that
        f"parameter Real p(min = 0, max = 0) = 0; {DECAY}",
        "parameter Real p(start = 0); Real x = p*time;",
    ],
)
def test_a_value_on_its_bound_or_from_start_is_taken(text: str) -> None:
    assert body(text).name == "M"


def test_a_value_that_is_missing_can_be_set(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text("model M parameter Real p; Real x = p*time; end M;", encoding="utf-8")
    assert lower(load("M", [file], {"p": 3})).name == "M"
