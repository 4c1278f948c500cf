"""Slopes of a model with events: what nothing depends on is seen to move nothing."""

from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest

from pysim.diagnose.residuals import Ruler
from pysim.diagnose.secants import with_secants
from pysim.diagnose.subject import Extended
from pysim.simulate import Rodas
from pysim.types import Signal
from tests.pysim.diagnose.bench import Bench
from tests.pysim.simulate.text_models import text_model

STOP = """
model Stop "A mass that meets a second spring: multiplying all four parameters changes nothing"
  parameter Real m(min=0.1, max=50, nominal=1) = 1;
  parameter Real d(min=0.01, max=50, nominal=1) = 0.8;
  parameter Real k(min=0.1, max=500, nominal=10) = 20;
  parameter Real s(min=0.1, max=20, nominal=1) = 1;
  input Real F(unit="N", start=0);
  output Real x(unit="m", start=0, fixed=true);
  Real v(start=0, fixed=true);
equation
  der(x) = v;
  m*der(v) = s*F - d*v - k*x - (if x > 0.1 then 5*k*(x - 0.1) else 0);
end Stop;
"""
KEYS = ("m", "d", "k", "s")


@cache
def met(**bounds: tuple[float, float]) -> tuple[Ruler, Extended]:
    """A wave that drives the mass into the second spring again and again."""
    model = text_model(STOP, Path(mkdtemp()))
    times = np.arange(0.0, 20.0, 0.02)
    waves = [(2.5, 0.0, 2.1, 0.0), (2.0, 0.0, 5.3, 0.0), (1.5, 0.0, 8.9, 0.0)]
    command = Signal(np.zeros(1), np.zeros((1, 4)), np.array([waves]))
    bench = Bench(("F", "N"), ("x", "m"), 1e-3)
    ruler, what = bench.measured(model, times, command, fine=1e-9, free=KEYS, bounds=bounds)
    return ruler.with_other(solver=Rodas(rtol=1e-4, atol=1e-4)), what


def along(rows: np.ndarray, direction: np.ndarray) -> float:
    return float(np.linalg.norm(rows[:, 1:] @ direction))


def test_what_scales_everything_moves_nothing() -> None:
    ruler, what = met()
    x = what.space.to_search(what.space.start)
    assert ruler.has_events(what, x)
    short = ruler.whole(ruler.evaluation(what, x))
    long = with_secants(ruler, what, x, short)
    null = np.full(4, 0.5)
    assert along(short, null) > 1
    assert along(long, null) < 0.05 * along(short, null)


def test_what_moves_much_stays_as_it_is() -> None:
    ruler, what = met()
    x = what.space.to_search(what.space.start)
    long = with_secants(ruler, what, x, ruler.whole(ruler.evaluation(what, x)))
    tight = ruler.with_other(solver=Rodas(rtol=1e-9, atol=1e-9))
    for j in range(4):
        h = 1e-3 * np.eye(4)[j]
        up, down = tight.at(what, x + h), tight.at(what, x - h)
        assert up is not None
        assert down is not None
        assert np.linalg.norm(long[:, 1 + j] - (up - down) / 2e-3) < 0.03 * np.linalg.norm(up - down) / 2e-3


def test_from_a_bound_it_goes_one_way() -> None:
    ruler, what = met(s=(1.0, 20.0))
    x = what.space.to_search(what.space.start)
    assert x[3] == pytest.approx(what.space.bounds()[0][3])
    long = with_secants(ruler, what, x, ruler.whole(ruler.evaluation(what, x)))
    assert along(long, np.full(4, 0.5)) < 1
