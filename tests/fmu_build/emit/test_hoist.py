"""Hoisting changes where the work is done, not what comes out."""

from dataclasses import fields

import casadi as ca
import numpy as np
import pytest

from fmu_build.emit.hoist import hoist_parameters
from tests import ode_models
from tests.ode_models import DERIVATIVE, PARAMETER, STATE, ode_model, real, symbols


def evaluator(model):
    """values of the symbols -> c, derivatives, outputs, residual, relations, with c calculated from p and i."""
    s = model.symbols
    relations = ca.vertcat(*(r.value for r in model.relations))
    results = [model.calculated, model.derivatives, model.outputs, model.residual, relations]
    function = ca.Function("f", [getattr(s, f.name) for f in fields(s)], results)

    def evaluate(values):
        c = ca.Function("c", [s.p, s.i], [model.calculated])(values["p"], values["i"])
        return [np.array(r).ravel() for r in function(*((values | {"c": c})[f.name] for f in fields(s)))]

    return evaluate


@pytest.mark.parametrize("build", ode_models.ALL)
def test_values_stay_the_same(build):
    model = build()
    hoisted = hoist_parameters(model)
    random = np.random.default_rng(0)
    values = {f.name: random.uniform(0.5, 2, getattr(model.symbols, f.name).numel()) for f in fields(model.symbols)}
    before, after = evaluator(model)(values), evaluator(hoisted)(values)
    for a, b in zip(before[1:], after[1:], strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-15)  # a quotient becomes a product
    np.testing.assert_array_equal(before[0], after[0][: model.symbols.c.numel()])


def test_the_largest_parts_are_taken_once():
    s = symbols(x=2, p=2, c=1)
    area = ca.sqrt(2 / s.p[0]) * s.c[0]
    model = ode_model(
        "M",
        s,
        (
            real("a", "p", 0, PARAMETER, start=1.0),
            real("b", "p", 1, PARAMETER, start=1.0),
            real("x1", "x", 0, STATE, start=1.0),
            real("x2", "x", 1, STATE, start=1.0),
            real("der(x1)", "dx", 0, DERIVATIVE, derivative_of="x1"),
            real("der(x2)", "dx", 1, DERIVATIVE, derivative_of="x2"),
        ),
        derivatives=ca.vertcat(area * s.x[0] + s.p[1], area * s.x[1] + ca.exp(s.p[1]) / s.p[0] + s.x[0] / s.p[0]),
        calculated=s.p[0] + 1,
    )
    hoisted = hoist_parameters(model)
    assert hoisted.symbols.c.numel() == 4  # its own, area, exp(b)/a, 1/a; a bare parameter stays one
    values = ca.Function("c", [s.p], [hoisted.calculated])([2.0, 1.0])
    np.testing.assert_allclose(np.array(values).ravel(), [3, 3, np.e / 2, 0.5], rtol=1e-15)


def test_nothing_to_hoist_leaves_the_model_alone():
    model = ode_models.initialised()
    assert hoist_parameters(model) is model
