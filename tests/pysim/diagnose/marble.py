"""A marble in one of two hollows: how far it is pushed decides in which one it comes to rest."""

from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
from numpy.typing import NDArray

from fmu_build import build
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended, Subject, extended, subject
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, MeasuredRecord, Model, Signal
from tests.pysim.diagnose.bench import REST, Bench

Array = NDArray[np.float64]

TEXT = """
model Marble
  parameter Real g(unit="m/N", min=0.5, max=2, nominal=1) = 1;
  parameter Real tau(unit="s", min=0.1, max=2, nominal=0.5) = 0.5;
  input Real F(unit="N", start=0);
  output Real x(unit="m", start=-1, fixed=true);
equation
  tau*der(x) = g*F + (if x > 0 then 1 - x else -1 - x);
end Marble;
"""
TRUTH = {"g": 1.0, "tau": 0.5}
BENCH = Bench(("F", "N"), ("x", "m"), 1e-3)
LAST = "to the ridge.txt"


@cache
def marble() -> Model:
    source = Path(mkdtemp(prefix="marble-")) / "Marble.mo"
    source.write_text(TEXT)
    return read_model(build("Marble", libraries=[source]))


def pushed(over: float, seed: int) -> tuple[Ruler, Extended]:
    """What counts the residuals of `measured`, and the model."""
    given = measured(over, seed)
    return Ruler(given.targets), extended(given, ())


def measured(over: float, seed: int) -> Subject:
    """Five waves in one hollow, and a push of 1 s that ends this share of its way beyond the ridge."""
    rng, logs = np.random.default_rng(seed), []
    for k in range(5):
        knots = np.arange(0.0, 6.01, 0.5)
        logs.append(_log(f"{k}.txt", knots, np.where(knots > 0.5, 0.5 * rng.random(knots.size), 0.0), rng))
    knots, shape = np.array([0.0, 1.0, 1.1, 2.0, 2.1, 4.0]), np.array([0.0, 0.0, 1.0, 1.0, 0.0, 0.0])
    reach = float(_answer(knots, 0.5 * shape).max()) + 1.0
    logs.append(_log(LAST, knots, 0.5 * (1 + over) / reach * shape, rng))
    return subject(marble(), BENCH.dataset(*logs), (), None, rest=REST)


def _log(source: str, knots: Array, force: Array, rng: np.random.Generator) -> MeasuredRecord:
    return BENCH.log(_times(knots), Signal.lines(knots, force), _answer(knots, force), rng, source=source)


def _answer(knots: Array, force: Array) -> Array:
    """Where the marble is at its true parameters, (n_t,) m."""
    run = Experiment(_times(knots), ("x",), {"F": Signal.lines(knots, force)}, TRUTH)
    return simulate(marble(), run, solver=Rodas(rtol=1e-9, atol=1e-9))["x"]


def _times(knots: Array) -> Array:
    return np.arange(0.0, knots[-1], 0.02)
