"""Indices that are known at run time only, texts, and functions of scalars that are applied to arrays."""

from math import isnan

import pytest

from tests.fmu_build.lower.compiling import body, compiled
from tests.fmu_build.lower.reference_runner import Runner


@pytest.mark.parametrize(("index", "expected"), [(1, 10), (3, 30), (0, None), (4, None), (-1, None)])
def test_an_index_outside_the_array_has_no_value(index: int, expected: float | None) -> None:
    model = body("input Integer i(start = 1); parameter Real v[3] = {10, 20, 30}; Real y = v[i];")
    value = Runner(model, inputs=lambda t: [index]).at("y")
    assert isnan(value) if expected is None else value == expected


@pytest.mark.parametrize(("index", "expected"), [(1, 12), (3, 10), (0, None), (4, None)])
def test_what_is_written_outside_the_array_spoils_it(index: int, expected: float | None) -> None:
    model = compiled(
        """
        package P
          function f input Integer i; output Real y; protected Real a[3];
          algorithm a := {1, 2, 3}; a[i] := 7; y := sum(a); end f;
          model M input Integer i(start = 1); Real y = f(i); end M;
        end P;""",
        "P.M",
    )
    value = Runner(model, inputs=lambda t: [index]).at("y")
    assert isnan(value) if expected is None else value == expected


def test_an_index_outside_the_array_does_no_harm_where_it_is_not_asked_for() -> None:
    model = body("input Integer i(start = 1); parameter Real v[2] = {10, 20}; Real y = if i <= 2 then v[i] else -1;")
    assert [Runner(model, inputs=lambda t, i=i: [i]).at("y") for i in (1, 2, 3)] == [10, 20, -1]


@pytest.mark.parametrize(
    ("elements", "expected"),
    [("v[k]", [3, 1]), ("A[k, 2]", [32, 12]), ("A[1, k]", [13, 11]), ("sum(A[k, k])", [88, 88])],
)
def test_a_vector_of_indices_may_be_set(elements: str, expected: list[float]) -> None:
    model = body(f"""
        parameter Integer k[2] = {{2, 2}}; Real v[3] = {{1, 2, 3}}; Real y[2];
        Real A[3, 3] = {{{{11, 12, 13}}, {{21, 22, 23}}, {{31, 32, 33}}}};
      equation
        y = {elements if elements[0] != "s" else f"fill({elements}, 2)"};""")
    run = Runner(model, {"k[1]": 3, "k[2]": 1})
    assert [run.at("y[1]"), run.at("y[2]")] == expected


FUNCTIONS = """
package P
  function square input Real x; output Real y; algorithm y := x^2; end square;
  function times input Real x; input Real k; output Real y; algorithm y := k*x; end times;
  model M Real v[3] = {1, 2, 3}; Real A[2, 2] = {{1, 2}, {3, 4}}; Real y[3]; Real B[2, 2];
  equation
    y = %s;
    B = square(A);
  end M;
end P;"""


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("square(v)", [1, 4, 9]),
        ("1 .+ square(v)", [2, 5, 10]),
        ("times(v, {3, 2, 1})", [3, 4, 3]),
        ("times(v, 2)", [2, 4, 6]),
        ("{square(v[i]) for i in 1:3}", [1, 4, 9]),
    ],
)
def test_a_function_of_scalars_is_applied_to_each_element(value: str, expected: list[float]) -> None:
    run = Runner(compiled(FUNCTIONS % value, "P.M"))
    assert [run.at(f"y[{k}]") for k in (1, 2, 3)] == expected
    assert [run.at(f"B[{r},{c}]") for r in (1, 2) for c in (1, 2)] == [1, 4, 9, 16]


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ('mode == "fast"', 1),
        ('mode <> "fast"', 0),
        ('mode == "slow"', 0),
        ('mode + "er" == "faster"', 1),
        ("is_fast", 1),
    ],
)
def test_texts_are_compared(condition: str, expected: float) -> None:
    model = body(f"""
        parameter String mode = "fast"; parameter Boolean is_fast = mode == "fast";
        Real y = if {condition} then 1 else 0;""")
    assert Runner(model).at("y") == expected
