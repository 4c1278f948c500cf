import casadi
import numpy as np
import pytest
from scipy.optimize import linprog, lsq_linear

from pysim.identify.greybox.interior_point import InteriorPoint, _Barrier
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.search import search
from pysim.types import BadInput, FitOutcome
from tests.pysim.identify.greybox.functions import evaluating, linear, rosenbrock, rosenbrock_slopes, space


def sizes_by_linear_programme(a: np.ndarray, b: np.ndarray, low: float, high: float) -> tuple[np.ndarray, float]:
    """min sum |a x - b| within bounds, the slacks as further variables."""
    m, n = a.shape
    rows = np.block([[a, -np.eye(m)], [-a, -np.eye(m)]])
    bounds = [(low, high)] * n + [(0, None)] * m
    found = linprog(np.r_[np.zeros(n), np.ones(m)], rows, np.r_[b, -b], bounds=bounds, method="highs")
    return found.x[:n], float(found.fun)


def test_the_smallest_sum_of_sizes_is_the_median() -> None:
    values = np.array([3.0, -1.0, 7.0, 4.0, 100.0])
    s = space([0.5])
    evaluate = evaluating(lambda x: values - x, lambda x: -np.ones((5, 1)), squares=False)
    state = search(evaluate, InteriorPoint(tolerance=1e-8), s, s.start, squares=False)
    assert state.outcome is FitOutcome.CONVERGED
    assert state.best.x == pytest.approx([4.0], abs=1e-5)


@pytest.mark.parametrize(("low", "high"), [(-10.0, 10.0), (-0.05, 0.1)])
def test_a_sum_of_sizes_agrees_with_a_linear_programme(low: float, high: float) -> None:
    a, b = linear(3, 60, 5)
    s = space([0.0] * 5, [low] * 5, [high] * 5)
    state = search(
        evaluating(lambda x: a @ x - b, lambda x: a, squares=False),
        InteriorPoint(tolerance=1e-8),
        s,
        s.start,
        squares=False,
    )
    x, cost = sizes_by_linear_programme(a, b, low, high)
    assert state.outcome is FitOutcome.CONVERGED
    assert state.best.cost == pytest.approx(cost, rel=1e-7)
    assert state.best.x == pytest.approx(x, abs=1e-4)


def test_a_sum_of_squares_with_bounds_agrees_with_an_active_set() -> None:
    a, b = linear(2, 30, 5)
    low, high = [-0.02] * 5, [0.1] * 5
    s = space([0.0] * 5, low, high)
    evaluate = evaluating(lambda x: a @ x - b, lambda x: a)
    state = search(evaluate, InteriorPoint(tolerance=1e-8), s, s.start, squares=True)
    assert state.best.x == pytest.approx(lsq_linear(a, b, (low, high), tol=1e-14).x, abs=1e-5)


def test_a_bent_sum_of_sizes_agrees_with_ipopt() -> None:
    """y = p0 exp(-p1 t) with outliers; Ipopt solves the same problem with slacks and exact derivatives."""
    rng = np.random.default_rng(7)
    t = np.linspace(0, 4, 40)
    y = 2 * np.exp(-0.8 * t) + 0.02 * rng.normal(size=40)
    y[::9] += 1.0

    def slopes(x: np.ndarray) -> np.ndarray:
        return -np.column_stack([np.exp(-x[1] * t), -x[0] * t * np.exp(-x[1] * t)])

    s = space([0.5, 0.2], [0.0, 0.0], [10.0, 5.0])
    evaluate = evaluating(lambda x: y - x[0] * np.exp(-x[1] * t), slopes, squares=False)
    state = search(evaluate, InteriorPoint(tolerance=1e-7), s, s.start, squares=False)

    p, slack = casadi.SX.sym("p", 2), casadi.SX.sym("s", 40)
    r = y - p[0] * casadi.exp(-p[1] * t)
    nlp = {"x": casadi.vertcat(p, slack), "f": casadi.sum1(slack), "g": casadi.vertcat(slack - r, slack + r)}
    solver = casadi.nlpsol("solver", "ipopt", nlp, {"ipopt.print_level": 0, "print_time": False, "ipopt.tol": 1e-10})
    found = solver(x0=[0.5, 0.2] + [1.0] * 40, lbx=[0, 0] + [0] * 40, ubx=[10, 5] + [np.inf] * 40, lbg=0)
    assert state.outcome is FitOutcome.CONVERGED
    assert state.best.cost == pytest.approx(float(found["f"]), rel=1e-6)
    assert state.best.x == pytest.approx(np.array(found["x"]).ravel()[:2], abs=1e-4)


def test_a_start_on_a_bound_is_moved_inside_and_bad_points_are_survived() -> None:
    s = space([-2.0, 1.0], [-2.0, -2.0], [2.0, 2.0])
    met = []

    def bad(x: np.ndarray) -> bool:
        met.append(bool(-1.5 < x[0] < -0.5 and x[1] < 0.4))
        return met[-1]

    evaluate = evaluating(rosenbrock, rosenbrock_slopes, squares=False, bad=bad)
    state = search(evaluate, InteriorPoint(tolerance=1e-6, max_iterations=500), s, s.start, squares=False)
    assert state.best.x == pytest.approx([1.0, 1.0], abs=1e-2)
    assert state.best.cost < 1e-2


@pytest.mark.parametrize("wanted", [-4.0, 0.2, 5.0])
def test_a_step_is_the_minimum_of_equation_2_23(wanted: float) -> None:
    """Of (x - c)^2 / 2 - mu (ln(U - x) + ln(x - L)): its slope there is that of a cubic's root."""
    low, high, mu = -1.0, 2.0, 0.3
    evaluate = evaluating(lambda x: x - wanted, lambda x: np.ones((1, 1)))
    start = evaluate(np.array([0.5]), {})
    found = 0.5 + _Barrier(Bounds(np.array([low]), np.array([high])), mu, True).step(start, 0.0)[0]
    # (x - c) (U - x) (x - L) + mu (x - L) - mu (U - x) = 0
    cubic = np.polyadd(
        np.polymul(np.polymul([1, -wanted], [-1, high]), [1, -low]),
        np.polyadd([mu, -mu * low], [mu, -mu * high]),
    )
    inside = [root.real for root in np.roots(cubic) if abs(root.imag) < 1e-9 and low < root.real < high]
    assert found == pytest.approx(inside[0], abs=1e-6)


def test_settings_out_of_range_are_refused() -> None:
    with pytest.raises(BadInput, match="reduction"):
        InteriorPoint(reduction=1.0)
