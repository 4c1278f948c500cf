"""Events of the supported subset: instants and values known in closed form."""

from math import asin, ceil, floor, sqrt

import pytest

from tests.fmu_build.lower.compiling import body, compiled
from tests.fmu_build.lower.reference_runner import Runner


def test_bouncing_ball():
    model = body("""
        Real h(start = 1, fixed = true); Real v(start = 0, fixed = true); parameter Real e = 0.7; Integer n(start = 0);
      equation der(h) = v; der(v) = -9.81;
        when h <= 0 then reinit(v, -e*pre(v)); n = pre(n) + 1; end when;""")
    first = sqrt(2 / 9.81)
    run = Runner(model).run(first * (1 + 2 * 0.7) + 0.01)
    assert run.at("n") == 2
    assert run.at("v") == pytest.approx(0.49 * 9.81 * first - 9.81 * 0.01, rel=1e-6)


def test_elsewhen_is_not_active_beside_the_branch_before():
    model = body("""
        Real x(start = 0, fixed = true); discrete Real a(start = 0); discrete Real b(start = 0);
      equation der(x) = 1;
        when x > 1 then a = 1; b = 0; elsewhen x > 2 then a = 2; b = 5; end when;""")
    assert Runner(model).run(1.5).at("a") == 1
    assert Runner(model).run(2.5).at("b") == 5
    both = body("""
        discrete Real a(start = 0); discrete Real b(start = 0); equation
        when time > 1 then a = 1; elsewhen time > 1 and time < 5 then a = 2; end when;
        when time > 1 then b = 1; end when;""")
    run = Runner(both).run(2)
    assert (run.at("a"), run.at("b")) == (1, 1)


def test_only_what_the_initial_event_leaves_alone_is_exact():
    model = body("""
        discrete Real set(start = -1); discrete Real follow(start = 2); discrete Real kept(start = 3);
        Real x(start = 0, fixed = true); Real y(start = 0, fixed = true); equation der(x) = 1; der(y) = 1;
        when initial() then set = pre(set) + 8; reinit(y, 5); end when;
        when {x > 1, initial()} then follow = 4; end when;
        when x > 2 then kept = set; reinit(x, 0); elsewhen sample(0, 1) then kept = 1; end when;""")
    found = {v.name: (v.initial, v.start) for v in model.variables if v.vector in ("x", "d")}
    assert found == {
        "set": ("calculated", -1),
        "follow": ("calculated", 2),
        "kept": ("exact", 3),
        "x": ("exact", 0),
        "y": ("calculated", 0),
    }
    run = Runner(model).run(0.5)
    assert (run.at("set"), run.at("follow"), run.at("y")) == (7, 4, pytest.approx(5.5))


def test_elsewhen_with_reinit_in_the_second_branch_only():
    model = body("""
        Real x(start = 0, fixed = true); discrete Real a(start = 0); equation der(x) = 1;
        when x > 3 then a = 1; elsewhen x > 1 then a = 2; reinit(x, 10); end when;""")
    run = Runner(model).run(1.5)
    # At 1 the state jumps to 10, which in the next pass makes the first branch active.
    assert (run.at("a"), run.at("x")) == (1, pytest.approx(10.5, rel=1e-9))


def test_if_inside_a_when_clause():
    model = body("""
        Real x(start = 0, fixed = true); discrete Real a(start = 0); Real y = 2*time; equation der(x) = 1;
        when x > 1 then if y > 3 then a = 1; else a = 2; end if; end when;""")
    assert Runner(model).run(2).at("a") == 2
    assert Runner(model, start={"x": -1.0}).run(3).at("a") == 1


def test_vector_of_conditions_fires_once_per_rise():
    model = body("""
        Real x(start = 0, fixed = true); Integer n(start = 0); Boolean b(start = false); equation der(x) = 1;
        when {x > 1, x > 2} then n = pre(n) + 1; b = not pre(b); end when;""")
    assert [Runner(model).run(t).at("n") for t in (0.5, 1.5, 2.5)] == [0, 1, 2]
    assert Runner(model).run(1.5).at("b") == 1


def test_when_in_an_algorithm():
    model = body("""
        Real x(start = 0, fixed = true); discrete Real a(start = 0); discrete Real c(start = 0);
      algorithm when x > 1 then a := pre(a) + 1; c := a + 1; elsewhen x > 2 then a := 7; end when;
      equation der(x) = 1;""")
    run = Runner(model).run(1.5)
    assert (run.at("a"), run.at("c")) == (1, 2)
    assert Runner(model).run(2.5).at("a") == 7


def test_time_events_follow_their_parameters():
    model = body("parameter Real T = 0.5; Real x(start = 0, fixed = true);equation der(x) = if time > T then 1 else 0;")
    assert [relation.instant is not None for relation in model.relations] == [True]
    assert Runner(model).run(2).at("x") == pytest.approx(1.5, rel=1e-12)
    assert Runner(model, {"T": 1.25}).run(2).at("x") == pytest.approx(0.75, rel=1e-12)


def test_sampled_integrator_follows_its_period():
    model = body(
        "parameter Real Ts = 0.1; discrete Real a(start = 0); Real x(start = 1, fixed = true);"
        "equation der(x) = 0; when sample(0, Ts) then a = pre(a) + Ts*x; end when;"
    )
    assert Runner(model).run(1.05).at("a") == pytest.approx(1.1)  # ticks at 0, 0.1, ... 1.0
    assert Runner(model, {"Ts": 0.25}).run(1.05).at("a") == pytest.approx(1.25)


def test_two_instances_with_periods_of_their_own():
    model = compiled(
        """
        package P
          block Counter parameter Real Ts = 0.1; Integer n(start = 0); equation
            when sample(Ts, Ts) then n = pre(n) + 1; end when; end Counter;
          model M Counter a; Counter b(Ts = 0.1); Counter c(Ts = 0.25); end M;
        end P;""",
        "P.M",
    )
    run = Runner(model, {"b.Ts": 0.5}).run(1.05)
    assert [run.at(f"{name}.n") for name in "abc"] == [10, 2, 4]


def test_sample_as_a_boolean_is_true_for_the_event_only():
    model = body(
        "Boolean tick; Integer n(start = 0); equation tick = sample(0, 0.3);when tick then n = pre(n) + 1; end when;"
    )
    run = Runner(model).run(1)
    assert (run.at("n"), run.at("tick")) == (4, 0)


def test_edge_change_and_pre():
    model = body("""
        Real x = sin(time); Boolean b = x > 0.5; Integer n; Integer edges(start = 0); Integer changes(start = 0);
      equation n = if x > 0.5 then 1 else 0;
        when edge(b) then edges = pre(edges) + 1; end when;
        when change(n) then changes = pre(changes) + 1; end when;""")
    assert len(model.relations) == 1
    run = Runner(model).run(asin(0.5) + 0.01)
    assert (run.at("edges"), run.at("changes"), run.at("b")) == (1, 1, 1)
    run.run(3.0)
    assert (run.at("edges"), run.at("changes"), run.at("b")) == (1, 2, 0)


def test_hysteresis():
    model = body(
        "Real x(start = 0, fixed = true); Boolean b(start = false, fixed = true);"
        "equation der(x) = if b then -1 else 1; b = x > 1 or (pre(b) and x > 0);"
    )
    assert Runner(model).run(1.5).at("x") == pytest.approx(0.5, abs=1e-9)
    assert Runner(model).run(2.25).at("x") == pytest.approx(0.25, abs=1e-9)


def test_initial_and_terminal():
    model = body(
        "Real x(start = 0, fixed = true); discrete Real a(start = 0); discrete Real c(start = 0);"
        "equation der(x) = a; when initial() then a = 3; end when;"
        "when {initial(), x > 6} then c = pre(c) + 1; end when;"
    )
    run = Runner(model)
    assert (run.at("a"), run.at("c")) == (3, 1)
    assert run.run(2.5).at("c") == 2


def test_condition_true_at_the_start_is_no_event():
    model = body(
        "Real x(start = 5, fixed = true); Integer n(start = 0); equation der(x) = -1;"
        "when x > 1 then n = pre(n) + 1; end when;"
    )
    assert Runner(model).run(1).at("n") == 0


def test_initial_equation_of_a_discrete_variable():
    model = body(
        "Real x(start = 0, fixed = true); Integer n; discrete Real d; initial equation n = 4; d = 0.5;"
        "equation der(x) = d; when x > 1 then n = pre(n) + 1; d = 2*pre(d); end when;"
    )
    run = Runner(model).run(2.5)
    assert (run.at("n"), run.at("x")) == (5, pytest.approx(1.5, rel=1e-9))


def test_discrete_start_value_is_obeyed():
    model = body(
        "Real x(start = 0, fixed = true); Integer n(start = 2); equation der(x) = n;"
        "when x > 100 then n = pre(n) + 1; end when;"
    )
    assert Runner(model, start={"n": 3}).run(1).at("x") == pytest.approx(3, rel=1e-12)


def test_assert_and_terminate():
    model = body(
        "Real x(start = 0, fixed = true); parameter Real top = 10; equation der(x) = 1;"
        'assert(x < top, "x is too large"); assert(x < 0.5, "note", AssertionLevel.warning);'
        'when x > 2 then terminate("done"); end when;'
    )
    assert [(check.message, check.is_warning) for check in model.checks] == [("x is too large", False), ("note", True)]
    run = Runner(model).run(5)
    assert run.time == pytest.approx(2, abs=1e-9)
    assert run.terminated
    assert "x is too large" not in run.failed
    assert "x is too large" in Runner(model, {"top": 1.0}).run(5).failed


def test_assert_inside_a_when_clause():
    model = body(
        "Real x(start = 0, fixed = true); parameter Real top = 10; equation der(x) = 1;"
        'when x > 1 then assert(top > 5, "top is too low"); end when;'
    )
    assert Runner(model).run(2).failed == []
    assert "top is too low" in Runner(model, {"top": 1.0}).run(2).failed
    assert Runner(model, {"top": 1.0}).run(0.5).failed == []


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("floor(x)", floor),
        ("ceil(x)", ceil),
        ("integer(2*x)", lambda x: floor(2 * x)),
        ("mod(x, 0.75)", lambda x: x - floor(x / 0.75) * 0.75),
        ("div(x, 0.75)", lambda x: int(x / 0.75)),
        ("rem(x, 0.75)", lambda x: x - int(x / 0.75) * 0.75),
    ],
)
def test_jumps_are_events(call, expected):
    model = body(
        f"Real x(start = -1.3, fixed = true); Real y; Integer n(start = 0); Real s(start = 0, fixed = true);"
        f"equation der(x) = 1; y = {call}; der(s) = y; when y > 0.6 then n = pre(n) + 1; end when;"
    )
    run = Runner(model)
    total, steps = 0.0, 26000
    for k in range(steps):
        total += expected(-1.3 + 2.6 * (k + 0.5) / steps) * 2.6 / steps
    assert run.at("y") == pytest.approx(expected(-1.3))
    run.run(2.6)
    assert run.at("y") == pytest.approx(expected(1.3), abs=1e-9)
    assert run.at("s") == pytest.approx(total, abs=2e-4)


def test_opposite_comparisons_share_a_relation():
    model = body("Real x(start = 0, fixed = true); Boolean a = x > 0.5; Boolean b = x <= 0.5; equation der(x) = 1;")
    assert len(model.relations) == 1
    run = Runner(model).run(1)
    assert (run.at("a"), run.at("b")) == (1, 0)


def test_comparisons_with_constants_that_agree_in_six_digits_are_two():
    model = body("""
        Real x(start = 0, fixed = true); discrete Real a(start = -1); discrete Real b(start = -1); equation der(x) = 1;
        when x > 1 then a = time; end when; when x > 1.0000001 then b = time; end when;""")
    assert len(model.relations) == 2
    run = Runner(model).run(2)
    assert run.at("b") - run.at("a") == pytest.approx(1e-7, abs=1e-9)


def test_floors_of_values_that_agree_in_six_digits_are_two():
    model = body("""
        Real p(start = 24999990, fixed = true); Integer n = integer(p/25000000); Integer m = integer(p/25000040);
      equation der(p) = 10;""")
    run = Runner(model).run(2)
    assert (run.at("n"), run.at("m")) == (1, 0)


def test_clocks_whose_starts_agree_in_six_digits_are_two():
    model = body("""
        discrete Real a(start = -1); discrete Real b(start = -1); equation
        when sample(1, 10) then a = time; end when; when sample(1.0000001, 10) then b = time; end when;""")
    assert len(model.samples) == 2
    run = Runner(model).run(2)
    assert (run.at("a"), run.at("b")) == (1, 1.0000001)


def test_a_variable_called_like_the_symbol_of_a_comparison_is_another_value():
    model = body("""
        input Boolean r0; Real x(start = 0, fixed = true); Real y(start = 0, fixed = true);
        Boolean a = x > (if y > 0.5 then 1 else 0); Boolean b = x > (if r0 then 1 else 0);
      equation der(x) = 1; der(y) = 1;""")
    assert len(model.relations) == 3


def test_enumeration_state_machine():
    model = compiled(
        """
        package P
          type Mode = enumeration(idle, busy, done);
          model M Mode m(start = Mode.idle, fixed = true); Real x(start = 0, fixed = true);
          equation der(x) = if m == Mode.idle then 1 else 2;
            when x > 1 then m = Mode.busy; elsewhen x > 3 then m = Mode.done; end when; end M;
        end P;""",
        "P.M",
    )
    mode = next(variable for variable in model.variables if variable.name == "m")
    assert (mode.enumeration, mode.start) == (("idle", "busy", "done"), 1.0)
    run = Runner(model).run(2.5)
    assert (run.at("m"), run.at("x")) == (3, pytest.approx(4, rel=1e-9))


def test_discrete_inputs():
    model = body(
        "input Boolean b; input Integer n; output Boolean c; Real x(start = 0, fixed = true);"
        "equation der(x) = if b then 1 else n; c = not b;"
    )
    run = Runner(model, inputs=lambda t: [0, 3]).run(1)
    assert (run.at("x"), run.at("c")) == (pytest.approx(3, rel=1e-12), 1)
