"""A mass on a spring and a damper with a slot for a force, effects for it, and measurements with known truth."""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

from fmu_build import build
from pysim.effects import read_catalogue, variant
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Effect, Experiment, MeasuredRecord, MeasuredSignal, Model, Record, Signal
from pysim.workflow import Variants

TEXT = """
package Toy
  partial model PartialForce "What acts on the mass besides spring and damper"
    input Real x(unit="m");
    input Real v(unit="m/s");
    output Real f(unit="N");
  end PartialForce;
  model NoForce extends PartialForce; equation f = 0; end NoForce;
  model Rubbing "Dry friction"
    extends PartialForce;
    parameter Real F_c(unit="N", min=0, max=5, nominal=0.3) = 0 "0 = off";
  equation
    f = -F_c*tanh(v/0.02);
    annotation(__HydraulicTestBench(effect="toy.friction", slot="force"));
  end Rubbing;
  model Falling "Dry friction that falls with speed"
    extends PartialForce;
    parameter Real F_c(unit="N", min=0, max=5, nominal=0.3) = 0 "At speed, 0 = off";
    parameter Real F_d(unit="N", min=0, max=5, nominal=0.3) = 0 "More near standstill, 0 = off";
  equation
    f = -tanh(v/0.02)*(F_c + F_d*exp(-abs(v)/0.1));
    annotation(__HydraulicTestBench(effect="toy.falling", slot="force"));
  end Falling;
  model Twin "Dry friction, hardly another"
    extends PartialForce;
    parameter Real F_t(unit="N", min=0, max=5, nominal=0.3) = 0 "0 = off";
  equation
    f = -F_t*tanh(v/0.01999);
    annotation(__HydraulicTestBench(effect="toy.twin", slot="force"));
  end Twin;
  model Hardening "Cubic spring"
    extends PartialForce;
    parameter Real k_3(unit="N/m3", min=0, max=100, nominal=5) = 0 "0 = off";
  equation
    f = -k_3*x^3;
    annotation(__HydraulicTestBench(effect="toy.hardening", slot="force"));
  end Hardening;
  model Bias "Constant force"
    extends PartialForce;
    parameter Real F_b(unit="N", min=-5, max=5, nominal=0.3) = 0 "0 = off";
  equation
    f = F_b;
    annotation(__HydraulicTestBench(effect="toy.bias", slot="force"));
  end Bias;
  model Relaxing "A spring in series with a damper"
    extends PartialForce;
    parameter Real T_r(unit="s", min=0, max=5, nominal=0.2) = 0 "0 = off";
    Real z(unit="m", start=0, fixed=true);
  equation
    T_r*der(z) = x - z;
    f = -10*(x - z);
    annotation(__HydraulicTestBench(effect="toy.relaxing", slot="force", bypass=true));
  end Relaxing;
  model Stop "End stops"
    extends PartialForce;
    parameter Real inverse_x_m(unit="1/m", min=0, max=50, nominal=5) = 0 "0 = off"
      annotation(__HydraulicTestBench(inverse="x_m", limits="x"));
  equation
    f = if x*inverse_x_m > 1 then -500*(x - 1/inverse_x_m)
      elseif x*inverse_x_m < -1 then -500*(x + 1/inverse_x_m) else 0;
    annotation(__HydraulicTestBench(effect="toy.stop", slot="force"));
  end Stop;
  model Both "Two forces at once"
    extends PartialForce;
    replaceable NoForce first constrainedby PartialForce;
    replaceable NoForce second constrainedby PartialForce;
  equation
    first.x = x;
    first.v = v;
    second.x = x;
    second.v = v;
    f = first.f + second.f;
    annotation(__HydraulicTestBench(pair="force"));
  end Both;
  model Mass
    parameter Real m(unit="kg", min=0.5, max=5, nominal=1) = 1;
    parameter Real d(unit="N.s/m", min=0, max=10, nominal=1) = 0.8;
    parameter Real k(unit="N/m", min=1, max=100, nominal=10) = 20;
    input Real F(unit="N", start=0);
    output Real x(unit="m", start=0, fixed=true);
    output Real v(unit="m/s", start=0, fixed=true);
    replaceable NoForce force constrainedby PartialForce;
  equation
    force.x = x;
    force.v = v;
    der(x) = v;
    m*der(v) = F - d*v - k*x + force.f;
  end Mass;
end Toy;
"""
NOISE = 1e-3  # m
_HOLD = 1.0  # s that the mass stands still before its logs


@cache
def library() -> Path:
    """The package in a file of its own."""
    path = Path(mkdtemp(prefix="toy-")) / "Toy.mo"
    path.write_text(TEXT)
    return path


def with_term(variants: Variants, text: str, effects: Sequence[Effect] = ()) -> tuple[Model, dict[str, str]]:
    """The model with these effects, and behind them the effects that a text declares, such as one of `law_class`."""
    source = Path(mkdtemp(prefix="term-")) / "Term.mo"
    source.write_text(text)
    wider = Variants(variants.class_name, (*variants.libraries, source))
    return wider.build([*effects, *read_catalogue(source)])


CATALOGUE = {effect.name: effect for effect in read_catalogue(library())}


@cache
def _built(names: tuple[str, ...]) -> tuple[Model, Mapping[str, str]]:
    made = variant("Toy.Mass", [CATALOGUE[name] for name in names], [library()], name="ToyVariant")
    source = Path(mkdtemp(prefix="toy-")) / "ToyVariant.mo"
    source.write_text(made.text)
    return read_model(build("ToyVariant", libraries=[library(), source])), made.places


def base() -> Model:
    return read_model(build("Toy.Mass", libraries=[library()]))


def measured(seed: int, *effects: str, noise: float = NOISE, seconds: float = 12.0, **values: float) -> Dataset:
    """Two waves, one held out, of a mass whose parameters differ from the model's by some percent.

    Args:
        noise: of the sensor, m; the data set states NOISE.
    """
    rng = np.random.default_rng(seed)
    model, places = _built(effects) if effects else (base(), {})
    records = []
    for source, use in (("a.txt", "fit"), ("b.txt", "validate")):
        knots = np.arange(0.0, seconds + 0.01, 0.4)
        push = 6 * rng.standard_normal(knots.size)
        push[0] = 0.0
        command, times = Signal.through(knots, push), np.arange(0.0, seconds, 0.02)
        run = Experiment(times, ("x",), {"F": command}, start=-_HOLD).override(m=1.05, d=0.75, k=21.0)
        for effect in (CATALOGUE[name] for name in effects):
            own = {p.name: values[p.name] for p in effect.parameters}
            run = effect.on(run, place=places[effect.name], **own)
        clean = simulate(model, run, solver=Rodas(rtol=1e-8, atol=1e-8))["x"]
        read = clean + noise * rng.standard_normal(times.size)
        log = Record(times, np.column_stack([command.value(times), read]), ("F", "x"), ("N", "m"))
        records.append(MeasuredRecord(source, "stochastic", use, log))
    signals = (
        MeasuredSignal("F", "input", "N", "F", "F"),
        MeasuredSignal("x", "output", "m", "x", "x", noise=NOISE),
    )
    return Dataset("toy", "one command, one sensor", "toy", signals, tuple(records))
