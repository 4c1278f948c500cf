"""Dependencies of small models whose equations can be read off."""

import casadi as ca
import pytest

from fmu_build.emit.structure import model_structure
from fmu_build.emit.table import complete_table
from tests import ode_models
from tests.ode_models import DERIVATIVE, INPUT, OUTPUT, PARAMETER, STATE, ode_model, real, symbols


def described(model, part):
    """{unknown: {known: kind}} by name; kind None where none is claimed."""
    model = complete_table(model)
    names = [variable.name for variable in model.variables]
    return {
        names[unknown.row]: {
            names[k]: kind
            for k, kind in zip(unknown.dependencies, unknown.kinds or (None,) * len(unknown.dependencies), strict=True)
        }
        for unknown in getattr(model_structure(model), part)
    }


def test_linear_model():
    model = ode_models.oscillator()
    assert described(model, "derivatives") == {
        "der(x)": {"v": "constant"},
        "der(v)": {"F": "tunable", "x": "tunable", "v": "tunable"},
    }
    assert described(model, "outputs") == {"y": {"x": "tunable", "v": "tunable"}}
    assert described(model, "initial_unknowns") == {
        "c": {"m": None, "k": None, "zeta": None},
        "der(x)": {"v": None},
        "der(v)": dict.fromkeys(("m", "k", "zeta", "F", "x", "v")),
        "y": dict.fromkeys(("m", "k", "zeta", "x", "v")),
    }


def test_a_fixed_parameter_makes_a_fixed_factor():
    s = symbols(x=1, p=1)
    model = ode_model(
        "M",
        s,
        (
            real("k", "p", 0, "parameter fixed exact", start=1.0),
            real("x", "x", 0, STATE, start=1.0),
            real("der(x)", "dx", 0, DERIVATIVE, derivative_of="x"),
        ),
        derivatives=-s.p[0] * s.x[0],
    )
    assert described(model, "derivatives") == {"der(x)": {"x": "fixed"}}


def test_through_an_implicit_block():
    model = ode_models.implicit_decay()
    both = {"u": "dependent", "x": "dependent"}
    assert described(model, "derivatives") == {"der(x)": both}
    assert described(model, "outputs") == {"y": both}
    assert described(model, "initial_unknowns")["y"] == {"a": None, "u": None, "x": None}


def test_separate_implicit_blocks_stay_apart():
    s = symbols(x=2, q=3)
    model = ode_model(
        "M",
        s,
        (
            real("x1", "x", 0, STATE, start=1.0),
            real("x2", "x", 1, STATE, start=1.0),
            real("der(x1)", "dx", 0, DERIVATIVE, derivative_of="x1"),
            real("der(x2)", "dx", 1, DERIVATIVE, derivative_of="x2"),
            real("y1", "w", 0, OUTPUT),
            real("y2", "w", 1, OUTPUT),
        ),
        derivatives=-s.x,
        outputs=s.q[0:2],
        residual=ca.vertcat(ca.sinh(s.q[0]) - s.x[0], s.q[1] + s.q[2] ** 3 - s.q[0], s.q[2] + s.q[1] - s.x[1]),
    )
    assert described(model, "outputs") == {
        "y1": {"x1": "dependent"},
        "y2": {"x1": "dependent", "x2": "dependent"},
    }


def test_events_and_time():
    model = ode_models.bouncing_ball()
    assert described(model, "derivatives") == {"der(h)": {"v": "constant"}, "der(v)": {}}
    assert described(model, "outputs")["flying"] == {"h": "dependent", "v": "dependent"}
    assert described(model, "event_indicators") == {
        "'event indicator'[1]": {"h": "constant"},
        "'event indicator'[2]": {"v": "constant"},
    }
    assert described(ode_models.sampled_delay(), "outputs") == {
        "n": {"time": "dependent"},
        "late": {"time": "dependent"},
    }


def test_a_relation_switches_the_factor():
    s = symbols(x=1, u=1, r=1, p=1)
    variables = (
        real("k", "p", 0, PARAMETER, start=1.0),
        real("u", "u", 0, INPUT, start=0.0),
        real("x", "x", 0, STATE, start=1.0),
        real("der(x)", "dx", 0, DERIVATIVE, derivative_of="x"),
    )
    relation = ode_models.Relation(s.u[0], strict=True)
    model = ode_model(
        "M", s, variables, derivatives=ca.if_else(s.r[0], -s.x[0], -s.p[0] * s.x[0]), relations=(relation,)
    )
    assert described(model, "derivatives") == {"der(x)": {"u": "discrete", "x": "discrete"}}


def test_parameters_found_at_the_start():
    found = described(ode_models.initialised(), "initial_unknowns")
    assert found == {"der(x)": {"s": None, "x": None}}


@pytest.mark.parametrize("build", ode_models.ALL)
def test_no_dependency_is_missing(build):
    """A derivative that CasADi finds by its own sparsity must be among the dependencies."""
    model = complete_table(build())
    structure = model_structure(model)
    rows = {(v.vector, v.index): row for row, v in enumerate(model.variables)}
    for unknown in structure.derivatives:
        index = model.variables[unknown.row].index
        for vector in ("x", "u"):
            sparsity = ca.jacobian(model.derivatives, getattr(model.symbols, vector)).sparsity()
            columns = [c for r, c in zip(*sparsity.get_triplet(), strict=True) if r == index]
            assert {rows[vector, c] for c in columns} <= set(unknown.dependencies)
