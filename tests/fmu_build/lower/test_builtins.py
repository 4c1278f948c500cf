"""Built-in functions: arrays, quotients and remainders of either sign, slopes at a kink, powers of matrices."""

import math
from itertools import product
from pathlib import Path

import casadi as ca
import numpy as np
import pytest

import fmu_build
from fmu_build.lower.builtins import ELEMENTWISE
from tests.contracts.fmu import Fmu
from tests.fmu_build.lower.compiling import body, compiled
from tests.fmu_build.lower.reference_runner import Runner


def test_the_slope_of_abs_at_zero_is_that_of_the_branch_for_positive_arguments() -> None:
    """A law on each side of u >= 0, such as a valve's K(abs(u)), has the slope there that it has beside it."""
    u = ca.SX.sym("u")
    size = ELEMENTWISE["abs"](u)
    slope, value = (ca.Function("f", [u], [e]) for e in (ca.jacobian(size, u), size))
    for x, expected in ((-2.0, -1.0), (-1e-300, -1.0), (0.0, 1.0), (3.0, 1.0)):
        assert float(slope(x)) == expected
        assert float(value(x)) == abs(x)
    flow = ca.if_else(u >= 0, size, -size) * 7.0
    gain = ca.Function("g", [u], [ca.jacobian(flow, u)])
    assert [float(gain(x)) for x in (-0.1, 0.0, 0.1)] == pytest.approx([7.0] * 3)


@pytest.mark.parametrize(
    ("power", "expected"),
    [
        ("A^2", [7, 10, 15, 22]),
        ("A^3", [37, 54, 81, 118]),
        ("A^1", [1, 2, 3, 4]),
        ("A^0", [1, 0, 0, 1]),
        ("A^n", [7, 10, 15, 22]),
        ("A.^2", [1, 4, 9, 16]),
        ("2 .^A", [2, 4, 8, 16]),
    ],
)
def test_the_power_of_a_matrix_is_its_repeated_product(power: str, expected: list[float]) -> None:
    run = Runner(
        body(f"""
        parameter Real A[2,2] = {{{{1, 2}}, {{3, 4}}}}; final parameter Integer n = 2; Real B[2,2];
      equation
        B = {power};""")
    )
    assert [run.at(f"B[{row},{col}]") for row in (1, 2) for col in (1, 2)] == expected


PLACES = ("parameter", "no_event", "function", "event")  # each has an implementation of its own
DIVISIONS = """
model Divisions
  function f input Real a; input Real b; output Real q[3];
  algorithm q := {div(a, b), mod(a, b), rem(a, b)}; end f;
  parameter Real x = 1;
  parameter Real y = 1;
  input Real u(start = 1);
  final parameter Real parameter_div = div(x, y);
  final parameter Real parameter_mod = mod(x, y);
  final parameter Real parameter_rem = rem(x, y);
  Real no_event_div = noEvent(div(u, y));
  Real no_event_mod = noEvent(mod(u, y));
  Real no_event_rem = noEvent(rem(u, y));
  Real event_div = div(u, y);
  Real event_mod = mod(u, y);
  Real event_rem = rem(u, y);
  Real of_function[3] = f(u, y);
  Real function_div = of_function[1];
  Real function_mod = of_function[2];
  Real function_rem = of_function[3];
end Divisions;
"""
PAIRS = tuple(product((7.0, -7.0, 6.0, -6.0, 0.5, -0.5, 0.0), (3.0, -3.0)))


def quotients(x: float, y: float) -> dict[str, float]:
    """Modelica 3.7.1.1: div cuts towards zero, rem has the sign of x, mod that of y."""
    right = {"div": float(math.trunc(x / y)), "mod": x - math.floor(x / y) * y, "rem": math.fmod(x, y)}
    return {f"{place}_{name}": value for place in PLACES for name, value in right.items()}


def test_quotients_and_remainders_of_either_sign() -> None:
    model = compiled(DIVISIONS, "Divisions")
    for x, y in PAIRS:
        run = Runner(model, {"x": x, "y": y}, inputs=lambda t, x=x: [x])
        expected = quotients(x, y)
        assert {name: run.at(name) for name in expected} == expected, (x, y)


def test_quotients_and_remainders_in_the_fmu(tmp_path: Path) -> None:
    file = tmp_path / "Divisions.mo"
    file.write_text(DIVISIONS, encoding="utf-8")
    fmu = Fmu.unpack(fmu_build.build("Divisions", libraries=[file]), tmp_path / "fmu", 2)
    for x, y in PAIRS:
        expected = quotients(x, y)
        with fmu.open("me").start({"x": x, "y": y, "u": x}) as instance:
            assert dict(zip(expected, instance.get(list(expected)), strict=True)) == expected, (x, y)


ARRAYS = {  # an expression of v = {1, 2, 4}, w = {3, -1, 5} and A = [1, 2; 3, 4; 5, 6]: its elements, row by row
    "linspace(-1.0, 3.0, 5)": np.linspace(-1, 3, 5),
    "cross(v, w)": np.cross([1, 2, 4], [3, -1, 5]),
    "outerProduct(v, w)": np.outer([1, 2, 4], [3, -1, 5]),
    "identity(3)": np.eye(3),
    "diagonal(v)": np.diag([1, 2, 4]),
    "transpose(A)": [[1, 3, 5], [2, 4, 6]],
    "cat(1, v, {7.0, 8.0})": [1, 2, 4, 7, 8],
    "cat(2, A, A)": [[1, 2, 1, 2], [3, 4, 3, 4], [5, 6, 5, 6]],
    "[v, w; 8, 9]": [[1, 3], [2, -1], [4, 5], [8, 9]],
    "fill(2.5, 2, 2)": [[2.5, 2.5], [2.5, 2.5]],
    "{sum(v), product(w), min(v), max(A), v*w}": [7, -15, 1, 6, 21],
    "A*{1, 10}": [21, 43, 65],
    "v*A": [27, 34],
    "vector(A[2:2, :])": [3, 4],
    "v .* w - v ./ w + 2*v": [3 - 1 / 3 + 2, -2 + 2 + 4, 20 - 4 / 5 + 8],
}


def test_arrays_are_what_numpy_makes_of_them() -> None:
    values = [np.asarray(value, dtype=float) for value in ARRAYS.values()]
    declared = "".join(
        f"  Real y{k}[{', '.join(map(str, value.shape))}] = {expression};\n"
        for k, (expression, value) in enumerate(zip(ARRAYS, values, strict=True))
    )
    given = "parameter Real v[3] = {1, 2, 4}; parameter Real w[3] = {3, -1, 5}; parameter Real A[3, 2] = "
    run = Runner(body(f"{given}{{{{1, 2}}, {{3, 4}}, {{5, 6}}}};\n{declared}"))
    for k, (expression, value) in enumerate(zip(ARRAYS, values, strict=True)):
        for place, expected in np.ndenumerate(value):
            index = ",".join(str(i + 1) for i in place)
            assert run.at(f"y{k}[{index}]") == pytest.approx(expected, rel=1e-14), (expression, index)
