"""Generated C against CasADi's own evaluation of the same expressions."""

import re
from pathlib import Path

import casadi as ca
import numpy as np

from fmu_build.emit.c_function import ARGUMENTS, c_function, c_number
from tests.generated_c import Generated, exported

HEAD = '#include "model.h"\n#include <math.h>\n#include <string.h>\n'


def arguments(**given):
    return [given.get(name.lower(), ca.SX.sym(name, 0)) for name in ARGUMENTS]


def compiled(folder: Path, results: list[ca.SX], **symbols: ca.SX) -> Generated:
    """The C function of these results."""
    source = HEAD + c_function("f", arguments(**symbols), results)
    return exported(source, {"f": tuple(r.numel() for r in results)}, folder)["f"]


def test_every_operation_agrees_with_casadi(tmp_path):
    x = ca.SX.sym("x", 2)
    a, b = x[0], x[1]
    one = [
        *(f(a) for f in (ca.exp, ca.expm1, ca.log, ca.log1p, ca.sqrt, ca.fabs, ca.floor, ca.ceil, ca.erf, ca.sign)),
        *(f(a) for f in (ca.sin, ca.cos, ca.tan, ca.asin, ca.acos, ca.atan)),
        *(f(a) for f in (ca.sinh, ca.cosh, ca.tanh, ca.asinh, ca.atanh)),
        ca.acosh(1 + a),
        *(-a, a**2, 2 * a, 1 / a, a**3, a**1.5, a**-0.5, a**-2.5, a**3.5, a**0.7, a**b, b**7),
        *(a**0.25, a**-0.75, a**1.25, a**-1.75),
        *(a + b, a - b, a * b, a / b, ca.fmin(a, b), ca.fmax(a, b), ca.fmod(b, a), ca.remainder(b, a)),
        *(ca.atan2(a, b), ca.hypot(a, b), ca.copysign(a, b)),
        *(a < b, a <= b, a == b, a != b, ca.logic_not(a), ca.logic_and(a, b - b), ca.logic_or(a, b)),
        *(ca.if_else(a < b, a, b), ca.if_else(a > b, a, b), ca.if_else(a, b, 0), ca.if_else(b - b, 3, a)),
    ]
    expected = ca.Function("f", [x], [ca.vertcat(*one)])
    generated = compiled(tmp_path, [ca.vertcat(*one)], x=x)
    for point in ([0.3, 1.7], [0.9, -0.4], [0.9, 0.9]):
        (found,) = generated(x=point)
        np.testing.assert_allclose(found, np.array(expected(point)).ravel(), rtol=1e-14)


def test_matrices_are_dense_and_column_major(tmp_path):
    x = ca.SX.sym("x", 2)
    (found,) = compiled(tmp_path, [ca.jacobian(ca.vertcat(x[0] * x[1], x[1], 3), x)], x=x)(x=[5.0, 7.0])
    np.testing.assert_array_equal(found, [7, 0, 0, 5, 1, 0])


def test_only_the_results_asked_for_are_written(tmp_path):
    x = ca.SX.sym("x")
    shared = ca.exp(x)
    first, second = compiled(tmp_path, [shared + 1, shared * 2], x=x)({1}, x=[0.0])
    assert np.isnan(first[0])
    assert second[0] == 2.0


def test_a_value_is_computed_once():
    x = ca.SX.sym("x", 2)
    text = c_function("f", arguments(x=x), [ca.vertcat(ca.tanh(x[0] * x[1]), ca.tanh(x[1] * x[0]) + 1)])
    assert text.count("tanh(") == 1


def test_a_branch_not_taken_does_not_spoil_the_value(tmp_path):
    x = ca.SX.sym("x")
    (found,) = compiled(tmp_path, [ca.if_else(x > 0, ca.sqrt(x), -1)], x=x)(x=[-4.0])
    assert found[0] == -1.0


def test_literals_read_back_as_the_same_doubles(tmp_path):
    values = [0.1, -2.0, 1e-300, 5e-324, 1e22, float("inf"), -float("inf"), 3.0]
    (found,) = compiled(tmp_path, [ca.vertcat(*values)])()
    assert list(found) == values
    assert all(re.search(r"[.e]|INF", c_number(value)) for value in values)
