import pytest

from fmu_build.errors import BuildError
from tests.fmu_build.lower.compiling import body, compiled

EQUATION = "Real x(start = 1, fixed = true);\nequation\nder(x) = -x;"


@pytest.mark.parametrize(
    ("declarations", "line", "message"),
    [
        ("parameter Real p(min = 0, max = 1) = 2;", 2, "p of M: its value 2 is above max = 1"),
        ('parameter Real p(unit = "m", min = 0.5) = 0.25;', 2, "p of M: its value 0.25 m is below min = 0.5 m"),
        ("parameter Real a = 1;\nparameter Real p(min = 3*a, max = 2*a) = 2;", 3, "min = 3 is larger than max = 2"),
        ("parameter Integer p(max = 3) = 4;", 2, "its value 4 is above max = 3"),
        ("parameter Real p[2](each max = 1) = {0.5, 1.5};", 2, r"p\[2\] of M: its value 1.5 is above"),
        ("Real y(start = -1, fixed = true, min = 0);", 2, "y of M: its value -1 is below min = 0"),
    ],
)
def test_a_value_outside_its_own_bounds_is_refused_where_it_is_declared(declarations, line, message):
    equation = EQUATION + ("\nder(y) = 0;" if "Real y(" in declarations else "")
    with pytest.raises(BuildError, match=message) as caught:
        body(f"{declarations}\n{equation}")
    assert caught.value.line == line
    assert caught.value.file.name == "M.mo"


def test_values_on_their_bounds_pass_whatever_rounding_makes_of_them():
    body(f"parameter Real p(min = 0, max = 0.1*3) = 0.3;\n{EQUATION}")
    body(f"parameter Real p(min = 0, max = 0) = 0;\n{EQUATION}")


def test_a_bound_of_a_type_holds_for_its_variables():
    text = f"""
    package M
      type Share = Real(min = 0, max = 1);
      model Inner
        parameter Share s = 1.5;
        {EQUATION}
      end Inner;
    end M;"""
    with pytest.raises(BuildError, match=r"s of M.Inner: its value 1.5 is above max = 1"):
        compiled(text, "M.Inner")
