"""The supported subset (fmu_build/SUBSET.md), each entry against a closed form."""

from math import cos, exp, sin

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.fmu_build.lower.compiling import body, compiled
from tests.fmu_build.lower.reference_runner import Runner


def test_array_of_states_in_a_for_loop():
    model = body(
        "parameter Integer n = 3; Real x[n](each start = 1, each fixed = true);"
        "equation for i in 1:n loop der(x[i]) = -i*x[i]; end for;"
    )
    run = Runner(model).run(0.5)
    assert [run.at(f"x[{i}]") for i in (1, 2, 3)] == pytest.approx([exp(-0.5 * i) for i in (1, 2, 3)], rel=1e-9)
    size = run.variable("n")
    assert (size.causality, size.variability) == ("calculatedParameter", "fixed")


def test_matrix_equation_follows_its_parameters():
    model = body(
        "Real x[2](start = {1, 0}, each fixed = true); parameter Real A[2,2] = [0, 1; -4, 0];equation der(x) = A*x;"
    )
    assert Runner(model).run(1).at("x[1]") == pytest.approx(cos(2), rel=1e-9)
    assert Runner(model, {"A[2,1]": -9.0}).run(1).at("x[1]") == pytest.approx(cos(3), rel=1e-9)


def test_linear_block_is_solved_symbolically():
    model = body(
        "Real x(start = 1, fixed = true); Real y; Real z; parameter Real R = 2;"
        "equation der(x) = -y; y + R*z = x; y - z = 1;"
    )
    assert model.symbols.q.numel() == 0
    run = Runner(model, {"R": 3.0})
    assert (run.at("y"), run.at("z")) == pytest.approx((1.0, 0.0))


def test_nonlinear_block_uses_the_start_value():
    model = body("Real x(start = 2, fixed = true); Real y(start = 1); equation der(x) = 0; y^3 + y = 5*x;")
    assert model.symbols.q.numel() == 1
    assert Runner(model).at("y") == pytest.approx(2.0, rel=1e-12)


def test_tearing_leaves_one_unknown_for_two_orifices_in_series():
    model = body(
        "Real p(start = 50); Real q1; Real q2; Real dp1; Real dp2; parameter Real p0 = 100; Real s = 10*time;"
        "equation dp1 = p0 - p; dp2 = p - s; q1 = dp1/(dp1^2 + 1)^0.25; q2 = 2*dp2/(dp2^2 + 1)^0.25; q1 = q2;"
    )
    assert model.symbols.q.numel() == 1
    run = Runner(model).run(1)
    assert run.at("q1") == pytest.approx(2 * run.at("dp2") / (run.at("dp2") ** 2 + 1) ** 0.25, rel=1e-12)
    assert run.at("dp1") + run.at("dp2") == pytest.approx(90, rel=1e-12)


def test_aliases_share_a_place_and_negated_ones_do_not():
    model = body("Real x(start = 1, fixed = true); Real y; Real z; equation der(x) = -x; y = x; z = -y;")
    x, y, z = (next(v for v in model.variables if v.name == name) for name in "xyz")
    assert (y.vector, y.index) == (x.vector, x.index) == ("x", 0)
    assert z.vector == "w"
    assert Runner(model).at("z") == -1.0


def test_rigidly_connected_inertias_are_one_state_pair():
    model = compiled(
        """
        package P
          connector F Real phi; flow Real tau; end F;
          model I F a; F b; Real phi; Real w; parameter Real J = 1;
          equation phi = a.phi; phi = b.phi; w = der(phi); J*der(w) = a.tau + b.tau; end I;
          model T F b; equation b.tau = -3; end T;
          model G F a; F b; parameter Real r = 2; equation a.phi = r*b.phi; r*a.tau + b.tau = 0; end G;
          model M I i1(J = 2, phi(fixed = true, start = 0.5)); I i2(J = 3); T t; G g;
            I i3(J = 0.5, w(fixed = true, start = 1, stateSelect = StateSelect.always));
          equation connect(t.b, i1.a); connect(i1.b, i2.a); connect(i2.b, g.a); connect(g.b, i3.a); end M;
        end P;""",
        "P.M",
    )
    assert {v.name for v in model.variables if v.vector == "x" and v.initial == "exact"} == {"i1.phi", "i3.w"}
    run = Runner(model).run(2)
    acceleration = 3 / (2 + 3 + 0.5 / 4)  # of i1; i3 turns half as far
    assert run.at("i1.phi") == pytest.approx(0.5 + 2 * 2 + acceleration * 2, rel=1e-9)
    assert run.at("i3.w") == pytest.approx(1 + acceleration, rel=1e-9)


def test_pendulum_keeps_its_length_and_energy():
    model = body(
        "parameter Real L = 1; Real x(start = 0.6, fixed = true); Real y(start = -0.8);"
        "Real vx(start = 0, fixed = true); Real vy; Real T; equation der(x) = vx; der(y) = vy;"
        "der(vx) = -T*x; der(vy) = -T*y - 9.81; x^2 + y^2 = L^2;"
    )
    run = Runner(model).run(0.5)
    assert run.at("x") ** 2 + run.at("y") ** 2 == pytest.approx(1, rel=1e-9)
    energy = 0.5 * (run.at("vx") ** 2 + run.at("vy") ** 2) + 9.81 * run.at("y")
    assert energy == pytest.approx(-0.8 * 9.81, rel=1e-8)


@pytest.mark.parametrize("height", ["y", "z"])
def test_only_unknowns_bound_to_states_are_constrained(height):
    """y is a state no more, and z another name of it; f is a flow as of an orifice."""
    model = body(
        "Real x(start = 0.6, fixed = true); Real y; Real z(start = -0.8); Real vx(start = 0, fixed = true); Real vy;"
        "Real T; Real f(start = 1); equation der(x) = vx; der(y) = vy; der(vx) = -T*x; der(vy) = -T*y - 9.81;"
        f"z = y; x^2 + {height}^2 = 1; f + f^3 = x;"
    )
    names = [model.symbols.q[k].name() for k in range(model.symbols.q.numel())]
    assert dict(zip(names, model.constrained, strict=True)) == {"y": True, "f": False}


def test_parameters_follow_each_other():
    model = body(
        "parameter Real b = 2*a; parameter Real a = 3; final parameter Real f = a + b;"
        "Real x(start = f, fixed = true); equation der(x) = 0;"
    )
    by_name = {v.name: v for v in model.variables}
    assert (by_name["a"].causality, by_name["b"].causality) == ("parameter", "calculatedParameter")
    assert by_name["f"].causality == "calculatedParameter"
    assert Runner(model, {"a": 5.0}).at("x") == 15.0


def test_parameters_written_ahead_of_those_they_follow_may_be_many():
    """A recursion along the chain would end at some hundred."""
    chain = " ".join(f"parameter Real p{k} = p{k - 1} + 1;" for k in range(400, 0, -1))
    model = body(f"{chain} parameter Real p0 = 1; Real x(start = p400, fixed = true); equation der(x) = 0;")
    assert Runner(model, {"p0": 2.0}).at("x") == 402.0


def test_structural_parameter_cannot_be_set():
    model = body(
        "parameter Boolean b = true; Real x(start = 0, fixed = true);"
        "equation if b then der(x) = 1; else der(x) = -x; end if;"
    )
    variable = next(v for v in model.variables if v.name == "b")
    assert (variable.causality, variable.variability, variable.vector) == ("calculatedParameter", "fixed", "c")
    assert model.symbols.p.numel() == 0


def test_attributes_are_numbers_of_the_default_parameters():
    model = body(
        'parameter Real p = 4; Real x(start = p, min = -p, max = 10*p, nominal = p/2, unit = "m", '
        'displayUnit = "mm", quantity = "Length") "Way"; equation der(x) = -x;'
    )
    x = next(v for v in model.variables if v.name == "x")
    assert (x.min, x.max, x.nominal, x.unit, x.display_unit) == (-4.0, 40.0, 2.0, "m", "mm")
    assert (x.quantity, x.description, x.initial, x.start) == ("Length", "Way", "calculated", None)
    assert model.nominal_x == (2.0,)
    assert next(v for v in model.variables if v.name == "der(x)").unit == "m/s"


def test_initial_equations_linear_and_steady_state():
    assert Runner(body("Real x; initial equation der(x) = 0; equation der(x) = 3 - 2*x;")).at("x") == 1.5
    model = body("Real x; Real y(start = 7); initial equation x + y = 10; equation der(x) = -x; der(y) = 0;")
    run = Runner(model)
    assert (run.at("x"), run.at("y")) == (3.0, 7.0)


def test_fixed_start_of_an_algebraic_variable_determines_the_state():
    model = body(
        "Real T(start = 300, fixed = true); Real h(start = 3e5); equation h = 1000*T + 0.5*T^2; der(h) = -1000;"
    )
    run = Runner(model)
    assert (run.at("h"), run.at("T")) == pytest.approx((345000, 300), rel=1e-9)
    assert run.run(1).at("T") == pytest.approx(-1000 + (1e6 + 2 * 344000) ** 0.5, rel=1e-9)


def test_derivative_of_an_algebraic_expression():
    model = body("Real x(start = 0, fixed = true); Real y; Real a; equation der(x) = 2; y = x^2; a = der(y);")
    assert model.symbols.x.numel() == 1
    assert Runner(model).run(1).at("a") == pytest.approx(8, rel=1e-9)


def test_nonlinear_initial_equation_is_left_to_newton():
    model = body("Real x(start = 1); initial equation x^3 + x = 10; equation der(x) = -x;")
    assert model.symbols.i.numel() == 1
    assert Runner(model).at("x") == pytest.approx(2.0, rel=1e-12)


def test_free_parameter_is_found_at_the_start():
    model = body(
        "parameter Real p(fixed = false, start = 1); Real x(start = 4, fixed = true);"
        "initial equation der(x) = -8; equation der(x) = -p*x;"
    )
    run = Runner(model)
    assert run.at("p") == pytest.approx(2.0)
    assert run.run(0.5).at("x") == pytest.approx(4 * exp(-1), rel=1e-9)


def test_initial_equation_over_a_nonlinear_block():
    model = body(
        "Real x(start = 1); Real y(start = 1); initial equation der(x) = -2;equation der(x) = -y; y^3 + y = 5*x;"
    )
    assert Runner(model).at("x") == pytest.approx(2.0, rel=1e-10)


def test_branch_that_is_not_taken_may_be_undefined():
    model = body("Real x(start = -1, fixed = true); Real y; equation der(x) = 1; y = if x > 0 then sqrt(x) else 0;")
    run = Runner(model)
    assert run.at("y") == 0.0
    assert run.run(2).at("y") == pytest.approx(1.0, rel=1e-9)


def test_functions_with_loops_branches_records_and_tables():
    model = compiled("""
        model M
          record R Real a; Real b; end R;
          function f input Real x; output R r; algorithm r.a := x; r.b := 2*x; end f;
          function g input Real v[:]; output Real y; algorithm y := 0; for i in 1:size(v, 1) loop y := y + i*v[i]^2;
            end for; end g;
          function tab input Real u; output Real y; protected Real X[3] = {0, 1, 2}; Real Y[3] = {0, 1, 4}; Integer k;
          algorithm k := 1; while k < 2 and u > X[k + 1] loop k := k + 1; end while;
            y := Y[k] + (Y[k + 1] - Y[k])*(u - X[k])/(X[k + 1] - X[k]); end tab;
          Real x(start = 0, fixed = true); R r; Real y; Real z; Real w;
        equation der(x) = 1; r = f(x); y = g({x, 2*x}); z = tab(x); w = max({x, 1 - x, 0.2}) + sum({x, x});
        end M;""")
    run = Runner(model).run(1.5)
    assert (run.at("r.a"), run.at("r.b")) == pytest.approx((1.5, 3.0), rel=1e-9)
    assert run.at("y") == pytest.approx(1.5**2 + 2 * 9, rel=1e-9)
    assert run.at("z") == pytest.approx(2.5, rel=1e-9)
    assert run.at("w") == pytest.approx(4.5, rel=1e-9)


def test_acausal_circuit_against_its_hand_written_equations():
    """Pressure source, orifice, volume, hydraulic motor, inertia with friction, tank."""
    model = compiled(
        """
        package H
          connector Port Real p; flow Real q; end Port;
          connector Flange Real phi; flow Real tau; end Flange;
          model Source Port port; parameter Real p0 = 200; equation port.p = p0; end Source;
          model Orifice Port a; Port b; parameter Real k = 3; Real dp; equation dp = a.p - b.p;
            a.q + b.q = 0; a.q = k*dp/(dp^2 + 1)^0.25; end Orifice;
          model Volume Port port; parameter Real C = 0.5; Real p(start = 10, fixed = true);
          equation port.p = p; C*der(p) = port.q; end Volume;
          model Motor Port a; Port b; Flange shaft; parameter Real D = 0.8;
          equation a.q = D*der(shaft.phi); a.q + b.q = 0; shaft.tau = -D*(a.p - b.p); end Motor;
          model Inertia Flange a; Flange b; parameter Real J = 2; Real phi(start = 0, fixed = true);
            Real w(start = 0, fixed = true); equation a.phi = phi; b.phi = phi; der(phi) = w;
            J*der(w) = a.tau + b.tau; end Inertia;
          model Friction Flange a; parameter Real F = 20; Real w; equation w = der(a.phi);
            a.tau = F*tanh(w/0.1) + 0.3*w; end Friction;
          model M Source s; Orifice o; Volume v; Motor m; Inertia j; Friction f; Source tank(p0 = 0);
          equation connect(s.port, o.a); connect(o.b, v.port); connect(v.port, m.a); connect(m.b, tank.port);
            connect(m.shaft, j.a); connect(j.b, f.a); end M;
        end H;""",
        "H.M",
    )
    assert (model.symbols.x.numel(), model.symbols.q.numel()) == (3, 0)

    def rate(t, y):
        p, _, w = y
        dp = 200 - p
        return [(3 * dp / (dp**2 + 1) ** 0.25 - 0.8 * w) / 0.5, w, (0.8 * p - 20 * np.tanh(w / 0.1) - 0.3 * w) / 2]

    expected = solve_ivp(rate, (0, 1.5), [10, 0, 0], method="Radau", rtol=1e-10, atol=1e-10).y[:, -1]
    run = Runner(model).run(1.5)
    assert [run.at(n) for n in ("v.p", "j.phi", "j.w")] == pytest.approx(list(expected), rel=1e-6)


def test_delay_of_a_ramp_and_its_parameter():
    model = body(
        "parameter Real T = 0.2; Real x(start = 0, fixed = true); Real y; equation der(x) = 2*time;"
        "y = delay(x, T, 1.0);"
    )
    assert Runner(model).run(1).at("y") == pytest.approx(0.64, rel=1e-9)
    assert Runner(model, {"T": 0.5}).run(1).at("y") == pytest.approx(0.25, rel=1e-9)
    assert Runner(model, {"T": 0.5}).run(0.3).at("y") == 0.0


def test_homotopy_smooth_and_math_functions():
    model = body(
        "Real y = homotopy(sin(time), 0) + smooth(1, if time > 0.5 then 1 else 0) + abs(-time) + sign(-2)"
        " + atan2(time, 1) - atan2(time, 1) + min(time, 0.25); equation"
    )
    assert model.relations == ()
    assert Runner(model).run(1).at("y") == pytest.approx(sin(1) + 1 + 1 - 1 + 0.25, rel=1e-12)


def test_start_of_oscillator_state_is_settable_and_default():
    model = body("Real x(start = 1); Real v; equation der(x) = v; der(v) = -4*x;")
    starts = {v.name: (v.start, v.initial) for v in model.variables if v.vector == "x"}
    assert starts == {"x": (1.0, "exact"), "v": (0.0, "exact")}
    assert Runner(model, start={"x": 2.0}).run(1).at("x") == pytest.approx(2 * cos(2), rel=1e-9)


X = 0.7


@pytest.mark.parametrize(
    ("algorithm", "expected"),
    [
        ("a := x; b := 1; for i in 1:3 loop a := a*b + i; b := a - b; end for; y := a + 10*b;", 95.4741),
        ("a := 0; for i in 1:3 loop for j in 1:i loop a := a + i*j*x; end for; a := 2*a; end for; y := a;", 68 * X),
        ("v[1] := x; for i in 2:3 loop v[i] := 2*v[i-1]; end for; y := v[3];", 4 * X),
        ("v := {x, 2*x, 3*x}; v[2] := 10; y := sum(v);", 4 * X + 10),
        ("v := zeros(3); v[2:3] := {x, 1}; y := v[1] + 10*v[2] + 100*v[3];", 10 * X + 100),
        ("n := integer(2*x) + 1; v := {1, 2, 3}; v[n] := x; y := v[1] + 10*v[2] + 100*v[3];", 301 + 10 * X),
        ("if x > 0.5 then y := 1; return; end if; y := 2;", 1),
        ("n := 0; y := x; while y < 100 and n < 20 loop y := 2*y; n := n + 1; end while;", 256 * X),
        ("a := x; if a > 0.5 then a := a + 1; y := 2*a; else a := a - 1; y := a; end if; y := y + a;", 3 * X + 3),
    ],
)
def test_function_bodies(algorithm, expected):
    model = compiled(f"""
        model M
          function f input Real x; output Real y; protected Real a; Real b; Real v[3]; Integer n;
          algorithm {algorithm} end f;
          Real x(start = {X}, fixed = true); Real y;
        equation der(x) = 0; y = f(x);
        end M;""")
    assert Runner(model).at("y") == pytest.approx(expected, rel=1e-12)


def test_string_parameter_shows_in_messages_only():
    model = body(
        'parameter String who = "tank"; Real x(start = 0, fixed = true); equation der(x) = 1;'
        'assert(x < 1, "level of the " + who + " is too high");'
    )
    assert model.checks[0].message == "level of the tank is too high"
    assert "who" not in [variable.name for variable in model.variables]


def test_calculated_parameter_is_tunable_where_it_follows_a_tunable_one():
    model = body("parameter Real a = 2; final parameter Real b = 3*a; final parameter Real c = 4; Real y = b*c*time;")
    assert {v.name: v.variability for v in model.variables if v.vector == "c"} == {"b": "tunable", "c": "fixed"}
