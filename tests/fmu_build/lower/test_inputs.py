"""Inputs that are declared with a value, or as discrete."""

import pytest

from fmu_build.lower import OdeModel
from tests.fmu_build.lower.compiling import body


def starts(model: OdeModel) -> dict[str, float | None]:
    return {v.name: v.start for v in model.variables if v.causality == "input"}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("input Real u = 3; Real y = u;", {"u": 3}),
        ("parameter Real k = 2; input Real u(start = 5) = k + 1; Real y = u;", {"u": 3}),
        ("input Real u[2] = {1, 2}; Real y = sum(u);", {"u[1]": 1, "u[2]": 2}),
        ("input Integer n = 3; input Boolean b = true; Integer y = if b then n else 0;", {"n": 3, "b": 1}),
    ],
)
def test_the_value_of_a_declaration_is_the_start_value(text: str, expected: dict[str, float]) -> None:
    assert starts(body(text)) == expected


def test_an_input_is_discrete_by_prefix_or_by_type() -> None:
    model = body("input Real u; discrete input Real d; input Integer n; Real y = u + d + n;")
    found = {v.name: v.variability for v in model.variables if v.causality == "input"}
    assert found == {"u": "continuous", "d": "discrete", "n": "discrete"}
