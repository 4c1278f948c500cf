"""Generated C against CasADi's own evaluation of the same expressions."""

import casadi as ca
import numpy as np
import pytest

from fmu_build.emit.c_function import ARGUMENTS, c_function, c_number
from tests.generated_c import exported

HEAD = '#include "model.h"\n#include <math.h>\n#include <string.h>\n'


def arguments(**given):
    return [given.get(name.lower(), ca.SX.sym(name, 0)) for name in ARGUMENTS]


def evaluate(folder, results, wanted=None, **values):
    """Compile `results` and evaluate them; values: argument = (symbol, numbers)."""
    source = HEAD + c_function("f", arguments(**{name: pair[0] for name, pair in values.items()}), results)
    f = exported(source, {"f": tuple(r.numel() for r in results)}, folder)["f"]
    return f(wanted, **{name: pair[1] for name, pair in values.items()})


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
    for point in ([0.3, 1.7], [0.9, -0.4], [0.9, 0.9]):
        (found,) = evaluate(tmp_path, [ca.vertcat(*one)], x=(x, point))
        np.testing.assert_allclose(found, np.array(expected(point)).ravel(), rtol=1e-14)


def test_matrices_are_dense_and_column_major(tmp_path):
    x = ca.SX.sym("x", 2)
    (found,) = evaluate(tmp_path, [ca.jacobian(ca.vertcat(x[0] * x[1], x[1], 3), x)], x=(x, [5.0, 7.0]))
    np.testing.assert_array_equal(found, [7, 0, 0, 5, 1, 0])


def test_only_the_results_asked_for_are_written(tmp_path):
    x = ca.SX.sym("x")
    shared = ca.exp(x)
    first, second = evaluate(tmp_path, [shared + 1, shared * 2], wanted={1}, x=(x, [0.0]))
    assert np.isnan(first[0])
    assert second[0] == 2.0


def test_a_value_is_computed_once():
    x = ca.SX.sym("x", 2)
    text = c_function("f", arguments(x=x), [ca.vertcat(ca.tanh(x[0] * x[1]), ca.tanh(x[1] * x[0]) + 1)])
    assert text.count("tanh(") == 1


def test_a_branch_not_taken_does_not_spoil_the_value(tmp_path):
    x = ca.SX.sym("x")
    (found,) = evaluate(tmp_path, [ca.if_else(x > 0, ca.sqrt(x), -1)], x=(x, [-4.0]))
    assert found[0] == -1.0


@pytest.mark.parametrize("value", [0.1, -2.0, 1e-300, 5e-324, 1e22, float("inf"), -float("inf"), 3.0])
def test_a_literal_reads_back_as_the_same_double(tmp_path, value):
    (found,) = evaluate(tmp_path, [ca.SX(value)])
    assert found[0] == value
    assert ("." in c_number(value)) or ("e" in c_number(value)) or ("INF" in c_number(value))
