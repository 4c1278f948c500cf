"""Steps are made finer where their error shows beside the noise, and not where no step would help."""

from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.steps import as_fine, fine_enough, integration_error, with_tolerance
from pysim.diagnose.subject import extended
from pysim.simulate import Esdirk, Rk4, Rodas
from pysim.types import Signal
from tests.pysim.diagnose.bench import Bench
from tests.pysim.diagnose.toy import measured, toy_subject
from tests.pysim.simulate.text_models import text_model

LORENZ = """
model Lorenz "Two runs that begin a hair apart are strangers after ten seconds"
  parameter Real r(min=1, max=50, nominal=28) = 28;
  input Real push(start=0);
  output Real x(start=1, fixed=true);
  Real y(start=1, fixed=true);
  Real z(start=20, fixed=true);
equation
  der(x) = 10*(y - x) + push;
  der(y) = x*(r - z) - y;
  der(z) = x*y - 8/3*z;
end Lorenz;
"""


def mass(tolerance: float) -> tuple[Ruler, Fitted]:
    """The toy at its own parameters, integrated that roughly."""
    given = toy_subject(measured(3))
    ruler = rulers(given.targets)[0].with_other(solver=Rodas(rtol=tolerance, atol=tolerance))
    what = extended(given, ())
    return ruler, Fitted(what, ruler.evaluation(what, what.space.to_search(what.space.start)))


def chaos() -> tuple[Ruler, Fitted]:
    """A run of eighty seconds of a plant without memory of its start."""
    model = text_model(LORENZ, Path(mkdtemp()))
    times = np.arange(0.0, 80.0, 0.02)
    push = Signal.lines([0.0, 1.0, 2.0, 80.0], [0.0, 0.0, 1.0, 0.0])
    ruler, what = Bench(("push", "1"), ("x", "1"), 0.1).measured(model, times, push)
    return ruler, Fitted(what, ruler.evaluation(what, what.space.to_search(what.space.start)))


def test_rough_steps_are_made_fine() -> None:
    rough, at = mass(0.05)
    assert integration_error(rough, at.what, at.point.x, at.point.residual) > 1
    fine, point, left = fine_enough(rough, at)
    assert left == 0
    residual = fine.at(at.what, at.point.x)
    assert point.residual == pytest.approx(residual)
    exact = rough.with_other(solver=Rodas(rtol=1e-10, atol=1e-10)).at(at.what, at.point.x)
    assert residual is not None
    assert exact is not None
    assert np.sum((residual - exact) ** 2) < 1


def test_fine_steps_stay() -> None:
    ruler, at = mass(1e-6)
    same, point, left = fine_enough(ruler, at)
    assert (same, left) == (ruler, 0.0)
    assert point is at.point


def test_no_step_is_fine_enough_for_chaos() -> None:
    ruler, at = chaos()
    _, _, left = fine_enough(ruler, at)
    assert left > 10


def test_tolerances_go_along_and_methods_stay() -> None:
    ruler, _ = mass(1e-5)
    fine = with_tolerance(ruler, 0.01).solver
    assert isinstance(fine, Rodas)
    assert (fine.rtol, fine.atol) == pytest.approx((1e-7, 1e-7))
    other = as_fine(ruler.with_other(solver=Esdirk(rtol=1e-3, atol=1e-9)), with_tolerance(ruler)).solver
    assert isinstance(other, Esdirk)
    assert (other.rtol, other.atol) == pytest.approx((1e-6, 1e-9))
    steady = ruler.with_other(solver=Rk4(1e-3))
    assert with_tolerance(steady) is steady
    assert as_fine(steady, ruler) is steady
