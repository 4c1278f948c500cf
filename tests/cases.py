"""Four models with known answers that show every branch of the run-time system: eight FMUs, for FMI 2 and 3.

ball: `when` on a state, `reinit`, Boolean and Integer outputs, a parameter calculated from others. In the run-time
system: event indicators, the search for a crossing, event iteration, saved discrete states, and partial derivatives by
parameters in one call, as there is no q.

sampled: `sample`, `when` on time, an enumeration, `delay`, a warning, `terminate`, an input that acts at events. In the
run-time system: clocks, time events, histories with their breaks, checks after a step.

implicit: a cubic equation in each step, an initial equation of a parameter and one of a state. In the run-time system:
Newton's iteration for q and derivatives by the implicit function theorem, and the initial problem for i.

pump_probed: a plant of the library, with units, display units, bounds, nominal values and probes. In the run-time
system: Rodas5P on stiff equations, sparse dependencies, many inputs.

Assertions of level error, constraints between states and equations without a solution have models of their own in
`tests/contracts`, since they end a run.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from scipy.optimize import brentq


@dataclass(frozen=True)
class Answer:
    """The value a variable has at a time (s), and how far the FMU may be off: integration and rounding."""

    variable: str
    time: float
    value: float
    tolerance: float


@dataclass(frozen=True)
class Case:
    """One model: Modelica text or a class of our library.

    Args:
        class_name: full name of the class to build.
        text: Modelica text that holds it; empty for a class of HydraulicTestBench.
        stop: end of a run that shows everything, s.
        settings: start values to set before each run, beside those of the model.
        probes: variables whose equation gets a further input.
        answers: of that run.
        has_delay: whether it uses delay(). Partial derivatives hold the delayed values fixed.
    """

    name: str
    class_name: str
    text: str = ""
    stop: float = 1.0
    settings: Mapping[str, float] = field(default_factory=dict)
    probes: tuple[str, ...] = ()
    answers: tuple[Answer, ...] = ()
    has_delay: bool = False


BALL = """model Ball "Bounces on a slope, and rests once it is slow"
  parameter Real e(min=0, max=1) = 0.7 "Restitution";
  parameter Real g(unit="m/s2") = 10;
  parameter Real slope = 0.6 "Sine of its angle";
  parameter Real a(unit="m/s2") = g*sqrt(1 - slope^2) "Towards the slope";
  output Real h(start=1, fixed=true, unit="m");
  output Real v(start=0, fixed=true, unit="m/s");
  output Real along(start=0, fixed=true, unit="m/s") "Speed along the slope";
  output Boolean flying(start=true, fixed=true);
  output Integer bounces(start=0, fixed=true);
equation
  der(h) = v;
  der(v) = if flying then -a else 0;
  der(along) = g*slope;
  when h < 0 then
    flying = pre(flying) and abs(v) > 0.01;
    bounces = pre(bounces) + 1;
    reinit(v, if flying then -e*pre(v) else 0);
  end when;
end Ball;
"""


def _ball_contact(number: int) -> float:
    """Time of the ball's n-th contact: fall from 1 m at 10 m/s2 times 0.8, restitution 0.7."""
    fall = math.sqrt(2 / 8)
    return fall + sum(2 * fall * 0.7**k for k in range(1, number))


SAMPLED = """model Sampled "First-order plant under a sampled controller, its output measured late"
  type Mode = enumeration(Slow, Fast);
  parameter Mode mode = Mode.Fast;
  parameter Real T(unit="s") = 0.1;
  parameter Real gain = 1;
  input Real r(start=1);
  output Real y(start=0, fixed=true);
  output Real u(start=0, fixed=true);
  output Real late;
  output Real soon "Delayed by less than an importer's step";
  output Integer ticks(start=0, fixed=true);
  output Boolean halved(start=false, fixed=true);
equation
  when sample(0, T) then
    u = pre(u) + T*(if mode == Mode.Fast then 2 else 1)*(r - y);
    ticks = pre(ticks) + 1;
  end when;
  when time >= 0.5 then
    halved = true;
  end when;
  der(y) = gain*u - y;
  late = delay(y, 0.15);
  soon = delay(y, 0.003);
  assert(y < 10, "y is too large", AssertionLevel.warning);
  when y > 20 then
    terminate("y is much too large");
  end when;
end Sampled;
"""
_FIRST_SAMPLE = 0.2 * (1 - math.exp(-0.1))  # y after the first interval, in which u = 0.2

IMPLICIT = """model Implicit "A reservoir that empties through a laminar and a turbulent resistance in series"
  parameter Real a = 0.5;
  parameter Real rate(fixed=false, start=1);
  input Real u(start=0);
  output Real x(start=2, fixed=true);
  output Real q;
  Real k(start=1);
initial equation
  x*rate^2 = 8;
  k^3 = 2*a;
equation
  q + a*q^3 = x + u;
  der(x) = -rate*k*q;
  der(k) = 0;
end Implicit;
"""


def _implicit_start() -> float:
    """q at time 0: q + a q^3 = 2, a = 0.5."""
    return brentq(lambda q: q + 0.5 * q**3 - 2, 0, 2, xtol=1e-14)


def _implicit_decay(time: float) -> float:
    """x: q' (1 + 3 a q^2) = -rate k q integrates to ln q + 3/2 a q^2 = const - 2 t, as rate = 2 and k = 1."""

    def integral(q: float) -> float:
        return math.log(q) + 0.75 * q**2

    q = brentq(lambda q: integral(q) - integral(_implicit_start()) + 2 * time, 1e-6, 2, xtol=1e-14)
    return q + 0.5 * q**3


CASES = (
    Case(
        name="ball",
        class_name="Ball",
        text=BALL,
        stop=1.7,
        answers=(
            Answer("h", 0.3, 1 - 8 / 2 * 0.3**2, 1e-7),
            # halfway between two contacts it is highest: e^2 of the height before
            Answer("h", (_ball_contact(1) + _ball_contact(2)) / 2, 0.49, 1e-5),
            Answer("h", (_ball_contact(2) + _ball_contact(3)) / 2, 0.49**2, 1e-5),
            Answer("bounces", (_ball_contact(2) + _ball_contact(3)) / 2, 2, 0),
            Answer("v", _ball_contact(2) + 1e-4, 0.49 * math.sqrt(2 * 8) - 8e-4, 1e-5),
            Answer("along", 0.5, 3.0, 1e-9),
        ),
    ),
    Case(
        name="sampled",
        class_name="Sampled",
        text=SAMPLED,
        has_delay=True,
        answers=(
            Answer("ticks", 0.55, 6, 0),
            Answer("halved", 0.49, 0, 0),
            Answer("halved", 0.5, 1, 0),
            Answer("u", 0.05, 0.2, 1e-12),
            Answer("y", 0.1, _FIRST_SAMPLE, 1e-8),
            Answer("u", 0.15, 0.2 + 0.2 * (1 - _FIRST_SAMPLE), 1e-8),
            Answer("late", 0.1, 0.0, 0.0),
            Answer("late", 0.25, _FIRST_SAMPLE, 1e-8),
            Answer("soon", 0.1, 0.2 * (1 - math.exp(-0.097)), 1e-8),
        ),
    ),
    Case(
        name="implicit",
        class_name="Implicit",
        text=IMPLICIT,
        answers=(
            Answer("q", 0.0, _implicit_start(), 1e-9),
            Answer("rate", 0.0, 2.0, 1e-9),
            Answer("k", 1.0, 1.0, 1e-9),
            Answer("x", 0.5, _implicit_decay(0.5), 1e-5),
        ),
    ),
    Case(
        name="pump_probed",
        class_name="HydraulicTestBench.Pump.FreeGreyBox",
        stop=0.1,
        settings={"alphaCMD": 10.0, "probe.pistonForce.f": 100.0, "probe.spool.u": 0.1, "probe.linkage.y": 1e-4},
        probes=("pistonForce.f", "spool.u", "linkage.y", "supply.dp", "oil.kappa1"),
    ),
)
BY_NAME = {case.name: case for case in CASES}
