"""Small `OdeModel`s written by hand, with known answers, for the tests of code generation and packing."""

from dataclasses import fields
from typing import Any

import casadi as ca

from fmu_build.lower.ode_model import (
    Check,
    DefaultExperiment,
    Delay,
    OdeModel,
    Relation,
    Sample,
    ScalarType,
    Symbols,
    Variable,
)


def symbols(**sizes: int) -> Symbols:
    """Symbols of the given lengths; t and the first two of e are always there."""
    n = {"t": 1, "e": 2} | sizes
    return Symbols(**{f.name: ca.SX.sym(f.name, n.get(f.name, 0)) for f in fields(Symbols)})


def real(name: str, vector: str, index: int, kind: str, **more: Any) -> Variable:
    """A Real variable; `kind` is "causality variability initial", with - for no initial."""
    causality, variability, initial = kind.split()
    return Variable(
        name=name,
        scalar_type=more.pop("scalar_type", ScalarType.REAL),
        causality=causality,  # type: ignore[arg-type]
        variability=variability,  # type: ignore[arg-type]
        initial=None if initial == "-" else initial,  # type: ignore[arg-type]
        vector=vector,  # type: ignore[arg-type]
        index=index,
        **more,
    )


def ode_model(name: str, s: Symbols, variables: tuple[Variable, ...], **given: Any) -> OdeModel:
    """An `OdeModel` in which everything that is not given is absent or stays as it is."""
    nothing = ca.SX(0, 1)
    parts: dict[str, Any] = {
        "description": "",
        "derivatives": nothing,
        "outputs": nothing,
        "residual": nothing,
        "relations": (),
        "samples": (),
        "delays": (),
        "updates_d": s.d,
        "updates_b": nothing,
        "updates_x": s.x,
        "checks": (),
        "terminations": (),
        "calculated": nothing,
        "start_x": s.x,
        "start_d": s.d,
        "start_q": ca.SX.zeros(s.q.numel()),
        "initial_residual": nothing,
        "guess_i": nothing,
        "nominal_x": (1.0,) * s.x.numel(),
        "default_experiment": DefaultExperiment(start=0.0, stop=1.0),
    }
    return OdeModel(name=name, symbols=s, variables=variables, **(parts | given))


PARAMETER = "parameter tunable exact"
STATE = "local continuous exact"
DERIVATIVE = "local continuous calculated"
INPUT = "input continuous -"
OUTPUT = "output continuous calculated"


def oscillator() -> OdeModel:
    """m x'' + c x' + k x = F: linear, damping from a calculated parameter c = 2 zeta sqrt(k m)."""
    s = symbols(x=2, u=1, p=3, c=1)
    mass, stiffness, zeta = s.p[0], s.p[1], s.p[2]
    position, speed = s.x[0], s.x[1]
    force = s.u[0] - stiffness * position - s.c[0] * speed
    return ode_model(
        "Test.Oscillator",
        s,
        (
            real("m", "p", 0, PARAMETER, start=2.0, unit="kg", min=0.0),
            real("k", "p", 1, PARAMETER, start=50.0, unit="N/m"),
            real("zeta", "p", 2, PARAMETER, start=0.1, unit="1"),
            real("c", "c", 0, "calculatedParameter tunable calculated", unit="N.s/m"),
            real("F", "u", 0, INPUT, start=0.0, unit="N"),
            real("x", "x", 0, STATE, start=0.1, unit="m"),
            real("v", "x", 1, STATE, start=0.0, unit="m/s"),
            real("der(x)", "dx", 0, DERIVATIVE, unit="m/s", derivative_of="x"),
            real("der(v)", "dx", 1, DERIVATIVE, unit="m/s2", derivative_of="v"),
            real("y", "w", 0, OUTPUT, unit="N", description="Force of the spring & damper"),
        ),
        description="Mass on a spring",
        derivatives=ca.vertcat(speed, force / mass),
        outputs=stiffness * position + s.c[0] * speed,
        calculated=2 * zeta * ca.sqrt(stiffness * mass),
    )


def bouncing_ball() -> OdeModel:
    """Falls from h0, bounces with restitution e; rests once it bounces slower than v_min."""
    s = symbols(x=2, p=3, d=1, r=2, pre_d=1, pre_b=1)
    gravity, restitution, v_min = s.p[0], s.p[1], s.p[2]
    flying = s.d[0]
    hit = s.r[0] * s.pre_d[0]
    active = ca.logic_and(s.r[0], ca.logic_not(s.pre_b[0]))
    return ode_model(
        "Test.BouncingBall",
        s,
        (
            real("g", "p", 0, PARAMETER, start=9.81, unit="m/s2"),
            real("e", "p", 1, PARAMETER, start=0.7, unit="1", min=0.0, max=1.0),
            real("v_min", "p", 2, PARAMETER, start=0.1, unit="m/s"),
            real("h", "x", 0, "output continuous exact", start=1.0, unit="m"),
            real("v", "x", 1, "output continuous exact", start=0.0, unit="m/s"),
            real("der(h)", "dx", 0, DERIVATIVE, unit="m/s", derivative_of="h"),
            real("der(v)", "dx", 1, DERIVATIVE, unit="m/s2", derivative_of="v"),
            real("flying", "d", 0, "output discrete exact", start=1.0, scalar_type=ScalarType.BOOLEAN),
        ),
        derivatives=ca.vertcat(s.x[1], ca.if_else(flying, -gravity, 0)),
        relations=(Relation(-s.x[0], strict=True), Relation(s.x[1] + v_min, strict=True)),
        updates_b=hit,
        updates_d=ca.if_else(ca.logic_and(active, s.r[1]), 0, s.pre_d[0]),
        updates_x=ca.vertcat(
            s.x[0],
            ca.if_else(active, ca.if_else(s.r[1], 0, -restitution * s.x[1]), s.x[1]),
        ),
        default_experiment=DefaultExperiment(start=0.0, stop=3.0, tolerance=1e-8),
    )


def implicit_decay() -> OdeModel:
    """x' = -q with q + a q^3 = x + u: one non-linear unknown."""
    s = symbols(x=1, u=1, p=1, q=1)
    q = s.q[0]
    return ode_model(
        "Test.ImplicitDecay",
        s,
        (
            real("a", "p", 0, PARAMETER, start=0.5, unit="1"),
            real("u", "u", 0, INPUT, start=0.0),
            real("x", "x", 0, STATE, start=2.0),
            real("der(x)", "dx", 0, DERIVATIVE, derivative_of="x"),
            real("y", "w", 0, OUTPUT),
        ),
        derivatives=-q,
        outputs=2 * q,
        residual=q + s.p[0] * q**3 - s.x[0] - s.u[0],
        start_q=s.x[0] + s.u[0],
    )


def sampled_delay() -> OdeModel:
    """x' = u delayed by T; n counts a clock's ticks; checks x < 10, ends at x > 5."""
    s = symbols(x=1, u=1, p=2, d=1, r=1, v=1, pre_d=1, pre_b=1, e=3)
    return ode_model(
        "Test.SampledDelay",
        s,
        (
            real("T", "p", 0, "parameter fixed exact", start=0.1, unit="s"),
            real("period", "p", 1, "parameter fixed exact", start=0.25, unit="s"),
            real("u", "u", 0, INPUT, start=1.0),
            real("x", "x", 0, STATE, start=0.0),
            real("der(x)", "dx", 0, DERIVATIVE, derivative_of="x"),
            real("n", "d", 0, "output discrete exact", start=0.0, scalar_type=ScalarType.INTEGER),
            real("late", "w", 0, OUTPUT),
        ),
        derivatives=s.v,
        outputs=ca.if_else(s.r[0], s.v, 0),
        relations=(Relation(s.t - 0.5, strict=False, instant=ca.SX(0.5)),),
        samples=(Sample(start=ca.SX(0), interval=s.p[1]),),
        delays=(Delay(source=s.u[0], time=s.p[0], maximum=s.p[0]),),
        updates_b=s.e[2],
        updates_d=ca.if_else(ca.logic_and(s.e[2], ca.logic_not(s.pre_b[0])), s.pre_d[0] + 1, s.pre_d[0]),
        checks=(Check(s.x[0] < 10, "x must stay below 10"),),
        terminations=(Check(s.x[0] > 5, 'far "enough"'),),
    )


def initialised() -> OdeModel:
    """x' = -k x, where k is found at the start so that x0 k^2 = s; nothing else about it is known."""
    s = symbols(x=1, p=1, c=1, i=1)
    return ode_model(
        "Test.Initialised",
        s,
        (
            real("s", "p", 0, "parameter fixed exact", start=8.0),
            real("k", "c", 0, "local fixed calculated"),
            real("x", "x", 0, STATE, start=2.0),
            real("der(x)", "dx", 0, DERIVATIVE, derivative_of="x"),
        ),
        derivatives=-s.c[0] * s.x[0],
        calculated=s.i[0],
        initial_residual=s.x[0] * s.i[0] ** 2 - s.p[0],
        guess_i=ca.SX(1),
    )


ALL = (oscillator, bouncing_ball, implicit_decay, sampled_delay, initialised)
