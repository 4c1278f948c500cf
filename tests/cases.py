"""Models with known answers. Each is built for FMI 2 and 3 and must pass every test in tests/contracts."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from scipy.optimize import brentq

from fmu_build.lower.ode_model import OdeModel
from tests import ode_models


@dataclass(frozen=True)
class Answer:
    """The value a variable has at a time (s), and how far the FMU may be off: integration and rounding."""

    variable: str
    time: float
    value: float
    tolerance: float


@dataclass(frozen=True)
class Case:
    """One model: Modelica text or a class of our library, or an `OdeModel` written by hand.

    Args:
        class_name: full name of the class to build.
        text: Modelica text that holds it; empty for a class of HydraulicTestBench.
        model: instead of a class, what lowering would have made of it.
        stop: end of a run that shows everything, s.
        settings: start values to set before each run, beside those of the model.
        probes: variables whose equation gets a further input.
        answers: of that run.
        has_delay: whether it uses delay(). Partial derivatives hold the delayed values fixed.
        agreement: largest difference between model exchange (FMPy's CVODE) and co-simulation, relative to the
            variables' sizes. More for delay(): model exchange knows its history at the importer's steps only.
    """

    name: str
    class_name: str = ""
    text: str = ""
    model: Callable[[], OdeModel] | None = None
    stop: float = 1.0
    settings: Mapping[str, float] = field(default_factory=dict)
    probes: tuple[str, ...] = ()
    answers: tuple[Answer, ...] = ()
    has_delay: bool = False
    agreement: float = 1e-4


def _oscillation(time: float) -> float:
    """Position of `ode_models.oscillator` after release from 0.1 m at rest: m = 2 kg, k = 50 N/m, zeta = 0.1."""
    frequency, zeta, start = math.sqrt(50 / 2), 0.1, 0.1
    damped = frequency * math.sqrt(1 - zeta**2)
    angle = damped * time
    decay = math.exp(-zeta * frequency * time)
    return start * decay * (math.cos(angle) + zeta * frequency / damped * math.sin(angle))


def _ball_contact(number: int) -> float:
    """Time of the ball's n-th contact: fall from 1 m, restitution 0.7, g = 9.81 m/s2."""
    fall = math.sqrt(2 / 9.81)
    return fall + sum(2 * fall * 0.7**k for k in range(1, number))


def _implicit_start() -> float:
    """q at time 0 of `ode_models.implicit_decay`: q + a q^3 = 2, a = 0.5."""
    return brentq(lambda q: q + 0.5 * q**3 - 2, 0, 2, xtol=1e-14)


def _implicit_decay(time: float) -> float:
    """x of that model: q' (1 + 3 a q^2) = -q integrates to ln q + 3/2 a q^2 = const - t."""

    def integral(q: float) -> float:
        return math.log(q) + 0.75 * q**2

    q = brentq(lambda q: integral(q) - integral(_implicit_start()) + time, 1e-6, 2, xtol=1e-14)
    return q + 0.5 * q**3


HAND_WRITTEN = (
    Case(
        name="oscillator",
        model=ode_models.oscillator,
        stop=2.0,
        answers=tuple(Answer("x", t, _oscillation(t), 1e-6) for t in (0.5, 1.0, 2.0)),
    ),
    Case(
        name="bouncing_ball",
        model=ode_models.bouncing_ball,
        stop=1.5,
        answers=(
            Answer("h", 0.3, 1 - 9.81 / 2 * 0.3**2, 1e-7),
            # halfway between two contacts it is highest: e^2 h0
            Answer("h", (_ball_contact(1) + _ball_contact(2)) / 2, 0.49, 1e-5),
            Answer("h", (_ball_contact(2) + _ball_contact(3)) / 2, 0.49**2, 1e-5),
        ),
    ),
    Case(
        name="implicit_decay",
        model=ode_models.implicit_decay,
        stop=1.0,
        answers=(Answer("x", 1.0, _implicit_decay(1.0), 1e-5), Answer("y", 0.0, 2 * _implicit_start(), 1e-9)),
    ),
    Case(
        name="sampled_delay",
        model=ode_models.sampled_delay,
        has_delay=True,
        stop=1.0,
        answers=(
            Answer("n", 0.1, 1, 0.0),
            Answer("n", 0.6, 3, 0.0),
            Answer("x", 0.9, 0.9, 1e-9),
            Answer("late", 0.4, 0.0, 0.0),
            Answer("late", 0.6, 1.0, 1e-12),
        ),
    ),
    Case(
        name="initialised",
        model=ode_models.initialised,
        stop=1.0,
        answers=(Answer("k", 0.0, 2.0, 1e-9), Answer("x", 1.0, 2 * math.exp(-2), 1e-6)),
    ),
)

LIBRARY = (
    Case(name="pump", class_name="HydraulicTestBench.Pump.FreeGreyBox", stop=0.2, settings={"alphaCMD": 30.0}),
    Case(name="pump_locked", class_name="HydraulicTestBench.Pump.LockedGreyBox", stop=0.1, settings={"alphaCMD": 10.0}),
    Case(
        name="pump_probed",
        class_name="HydraulicTestBench.Pump.FreeGreyBox",
        stop=0.1,
        settings={"alphaCMD": 10.0, "probe.pistonForce.f": 100.0, "probe.spool.u": 0.1, "probe.linkage.y": 1e-4},
        probes=("pistonForce.f", "spool.u", "linkage.y", "supply.dp", "oil.kappa1"),
    ),
    Case(
        name="pump_with_delay",
        class_name="HydraulicTestBench.Examples.TrueDelay",
        stop=0.3,
        has_delay=True,
        agreement=1e-2,
    ),
    Case(
        name="chamber_filling",
        class_name="HydraulicTestBench.Validation.ChamberFilling",
        answers=(Answer("chamber.p", 1.0, 1.4e9 * 1e-6 / 1e-3, 1.0), Answer("error", 0.5, 0.0, 1.0)),
    ),
    Case(
        name="spool_step",
        class_name="HydraulicTestBench.Validation.SpoolStep",
        stop=0.1,
        answers=tuple(Answer("error", t, 0.0, 1e-7) for t in (0.005, 0.02, 0.1)),
    ),
    Case(
        name="orifices_in_series",
        class_name="HydraulicTestBench.Validation.OrificesInSeries",
        stop=0.2,
        answers=(Answer("error", 0.2, 0.0, 10.0),),
    ),
)

BALL = """model Ball "Bounces, and rests once it is slow"
  parameter Real e(min=0, max=1) = 0.7;
  parameter Real g(unit="m/s2") = 9.81;
  output Real h(start=1, fixed=true, unit="m");
  output Real v(start=0, fixed=true, unit="m/s");
  output Boolean flying(start=true, fixed=true);
  output Integer bounces(start=0, fixed=true);
equation
  der(h) = v;
  der(v) = if flying then -g else 0;
  when h < 0 then
    flying = pre(flying) and abs(v) > 0.01;
    bounces = pre(bounces) + 1;
    reinit(v, if flying then -e*pre(v) else 0);
  end when;
end Ball;
"""

SAMPLED = """model Sampled "First-order plant under a sampled controller"
  type Mode = enumeration(Slow, Fast);
  parameter Mode mode = Mode.Fast;
  parameter Real T(unit="s") = 0.1;
  input Real r(start=1);
  output Real y(start=0, fixed=true);
  output Real u(start=0, fixed=true);
  output Integer ticks(start=0, fixed=true);
equation
  when sample(0, T) then
    u = pre(u) + T*(if mode == Mode.Fast then 2 else 1)*(r - y);
    ticks = pre(ticks) + 1;
  end when;
  der(y) = u - y;
end Sampled;
"""

IMPLICIT = """model Implicit "Flow through two quadratic resistances with a volume between"
  parameter Real a = 2;
  input Real p(start=4);
  output Real v(start=0, fixed=true);
  Real q;
  Real k(start=1);
initial equation
  k^2 = a;
equation
  p - v = q + a*q^3;
  der(v) = q*k;
  der(k) = 0;
end Implicit;
"""

TEXTS = (
    Case(
        name="ball",
        class_name="Ball",
        text=BALL,
        stop=1.5,
        answers=(
            Answer("h", (_ball_contact(1) + _ball_contact(2)) / 2, 0.49, 1e-5),
            Answer("bounces", (_ball_contact(2) + _ball_contact(3)) / 2, 2, 0),
            Answer("v", _ball_contact(2) + 1e-4, 0.49 * math.sqrt(2 * 9.81) - 9.81e-4, 1e-5),
        ),
    ),
    Case(
        name="sampled",
        class_name="Sampled",
        text=SAMPLED,
        answers=(
            Answer("ticks", 0.55, 6, 0),
            Answer("u", 0.05, 0.2, 1e-12),
            Answer("y", 0.1, 0.2 * (1 - math.exp(-0.1)), 1e-8),
            Answer("u", 0.15, 0.2 + 0.2 * (1 - 0.2 * (1 - math.exp(-0.1))), 1e-8),
        ),
    ),
    Case(
        name="implicit",
        class_name="Implicit",
        text=IMPLICIT,
        answers=(Answer("q", 0.0, 1.1281738984, 1e-8), Answer("k", 1.0, math.sqrt(2), 1e-9)),
    ),
)

CASES = HAND_WRITTEN + LIBRARY + TEXTS
