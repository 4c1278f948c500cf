"""Values of expressions, which Python and arithmetic know too."""

import math

import pytest

from fmu_build.text.expressions import Call, Name, Number, evaluate, literal, names_in, parse


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2*50e-3", 0.1),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("1 - 2 - 3", -4.0),
        ("8/2/2", 2.0),
        ("-(1e1)*3 + 1.", -29.0),
        ("2*Modelica.Constants.pi", 2 * math.pi),
        ("n + 1", 4.0),
        ("{1, 2*2, -3}", (1.0, 4.0, -3.0)),
        ("{{1, 2}, {3, 4}}", ((1.0, 2.0), (3.0, 4.0))),
        ("zeros(n)", (0.0, 0.0, 0.0)),
        ("2*ones(2) - {1, 0}", (1.0, 2.0)),
        ("fill(0.5, 1, 2)", ((0.5, 0.5),)),
        ("linspace(-1, 1, n)", (-1.0, 0.0, 1.0)),
        ("-{1}", (-1.0,)),
    ],
)
def test_literals(text: str, value: object) -> None:
    assert literal(text, {"n": 3.0}) == value


@pytest.mark.parametrize(
    "text",
    ["", "x", "1 +", "(1", "1)", "1 2", "{1, 2", "{1} + {1, 2}", "1/0", "(-8)^0.5", "9e99^9", "zeros(1e9)", "zeros(-1)",
     "fill(1, 1e4, 1e4)", "fill(zeros(1e4), 1e4)",
     "zeros()", "open(1)", '"a"', "__import__(1)", "(" * 5000, "1 if 2", "linspace(0, 1, 1)", "1_000", "c[n]", "c[1"],
)  # fmt: skip
def test_what_is_no_literal_is_refused(text: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011
        literal(text)


def test_conditions_and_calls() -> None:
    tree = parse("if not a.b >= 1 and c <> 2 then f(x, 1) elseif true then 2 else -y")
    assert list(names_in(tree)) == ["a.b", "c", "x", "y"]
    assert list(names_in(parse("c[1]*a[ 2 ].b + f(c[12])"))) == ["c[1]", "a[2].b", "c[12]"]
    assert parse("a or b and c") == Call("or", (Name("a"), Call("and", (Name("b"), Name("c")))))
    assert parse("-a*b^2") == Call("negate", (Call("*", (Name("a"), Call("^", (Name("b"), Number(2.0))))),))

    def value(x: float) -> float:
        functions = {"if": lambda test, a, b: a if test else b, ">": lambda a, b: a > b, "*": lambda a, b: a * b}
        return float(evaluate(parse("if x > 1 then x*x else x"), {"x": x}.__getitem__, functions))

    assert (value(0.5), value(3.0)) == (0.5, 9.0)
