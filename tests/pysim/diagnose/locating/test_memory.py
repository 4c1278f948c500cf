"""A sensor that lags is found at the sensor, though no table over one variable is a lag."""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

from fmu_build import build
from pysim.diagnose import Subject, subject
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import Term, wrapped
from pysim.diagnose.locating.locate import locate
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.effects import read_catalogue, slots, variant
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Effect, Experiment, Missing, Model, Signal
from tests.pysim.diagnose.bench import Bench

TEXT = """
package Seen
  partial model PartialSensor
    input Real s(unit="m");
    input Real s_t(unit="m/s");
    output Real y(unit="m");
    output Real y_t(unit="m/s");
  end PartialSensor;
  model Ideal extends PartialSensor; equation y = s; y_t = s_t; end Ideal;
  model Lag "The sensor lags"
    extends PartialSensor(y(start=0, fixed=true));
    parameter Real T(unit="s", min=0, max=1, nominal=0.05) = 0 "0 = off";
  equation
    y_t = (s - y)/max(T, 1e-5);
    der(y) = y_t;
    annotation(__HydraulicTestBench(effect="seen.lag", slot="sensor", bypass=true));
  end Lag;
  model Mass "On a spring, held by a controller that sees it through a sensor"
    parameter Real m(unit="kg", min=0.5, max=5, nominal=1) = 1;
    parameter Real d(unit="N.s/m", min=0, max=10, nominal=1) = 2;
    parameter Real k(unit="N/m", min=1, max=100, nominal=10) = 20;
    input Real r(unit="m", start=0);
    output Real x(unit="m", start=0, fixed=true);
    output Real z(unit="m");
    Real v(unit="m/s", start=0, fixed=true);
    replaceable Ideal sensor constrainedby PartialSensor;
  equation
    sensor.s = x;
    sensor.s_t = v;
    z = sensor.y;
    der(x) = v;
    m*der(v) = 30*(r - sensor.y) - d*v - k*x;
  end Mass;
end Seen;
"""
LAG, NOISE = 0.06, 1e-3


@cache
def library() -> Path:
    path = Path(mkdtemp(prefix="seen-")) / "Seen.mo"
    path.write_text(TEXT)
    return path


def build_variant(effects: Sequence[Effect]) -> tuple[Model, Mapping[str, str]]:
    made = variant("Seen.Mass", effects, [library()], name="SeenVariant")
    source = Path(mkdtemp(prefix="seen-")) / "SeenVariant.mo"
    source.write_text(made.text)
    return read_model(build("SeenVariant", libraries=[library(), source])), made.places


def probed(effects: Sequence[Effect], law: Term) -> Model:
    source = Path(mkdtemp(prefix="seen-")) / "Located.mo"
    source.write_text(wrapped("Seen.Mass", law, "Located"))
    return read_model(build("Located", libraries=[library(), source], probes=law.probes))


def lagging() -> Subject:
    rng, catalogue = np.random.default_rng(1), read_catalogue(library())
    model, places = build_variant(catalogue)
    knots, times = np.arange(0.0, 12.01, 0.3), np.arange(0.0, 12.0, 0.02)
    command = Signal.through(knots, np.append(0.0, rng.standard_normal(knots.size - 1)))
    run = Experiment(times, ("z",), {"r": command}).override(m=1.05, d=1.9, k=21.0)
    run = catalogue[0].on(run, place=places["seen.lag"], T=LAG)
    clean = simulate(model, run, solver=Rodas(rtol=1e-8, atol=1e-8))["z"]
    bench = Bench(("r", "m"), ("z", "m"), NOISE)
    data = bench.dataset(bench.log(times, command, clean, rng))
    return subject(read_model(build("Seen.Mass", libraries=[library()])), data, catalogue, build_variant)


@cache
def found() -> tuple[Missing, ...]:
    given = lagging()
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    first = ruler.evaluation(what, what.space.to_search(what.space.start))
    current = Fitted(what, refit(ruler, what, first, rounds=5))
    return locate(given, ruler, current, slots=slots("Seen.Mass", [library()]), probed=probed)


def test_the_place_and_what_is_there() -> None:
    first = found()[0]
    assert first.slot == "sensor"
    assert first.share > 0.95
    assert first.formula.startswith("seen.lag, T = 0.0")
    assert abs(float(first.formula.split("=")[1].split()[0]) - LAG) < 0.1 * LAG


def test_it_is_drawn_over_the_rate_with_the_reach_of_its_memory() -> None:
    first = found()[0]
    assert first.depends_on == "sensor.s_t"
    inner = slice(20, 61)  # where the tests go often
    truth = -LAG * first.shape.argument[inner]
    assert np.mean((first.shape.low[inner] <= truth) & (truth <= first.shape.high[inner])) > 0.9
    slope = np.polyfit(first.shape.argument[inner], first.shape.value[inner], 1)[0]
    assert -1.1 * LAG < slope < -0.7 * LAG
