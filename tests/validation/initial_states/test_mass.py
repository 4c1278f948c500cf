"""The closed form of the mass on a spring, against an integrator and its undriven decay."""

import numpy as np
from scipy.integrate import solve_ivp

from validation.initial_states.mass import TRUTH, force, motion

TIME = np.linspace(0.0, 2.0, 401)


def test_undriven_it_decays_as_the_formula_says() -> None:
    m, d, c = TRUTH["m"], TRUTH["d"], TRUTH["c"]
    sigma, omega = d / (2 * m), np.sqrt(c / m - (d / (2 * m)) ** 2)
    x0, v0 = 0.05, -0.2
    expected = np.exp(-sigma * TIME) * (x0 * np.cos(omega * TIME) + (v0 + sigma * x0) / omega * np.sin(omega * TIME))
    found = motion(TIME, np.zeros(TIME.size), (x0, v0))
    np.testing.assert_allclose(found[:, 0], expected, atol=1e-12)


def test_pushed_it_moves_as_an_integrator_says() -> None:
    pushed = force(TIME, seed=7)

    def rates(t: float, y: np.ndarray) -> list[float]:
        return [y[1], (np.interp(t, TIME, pushed) - TRUTH["d"] * y[1] - TRUTH["c"] * y[0]) / TRUTH["m"]]

    step = TIME[1] - TIME[0]  # the force has a kink at every sample
    run = solve_ivp(rates, (0.0, 2.0), [0.05, -0.2], t_eval=TIME, rtol=1e-9, atol=1e-12, max_step=step)
    np.testing.assert_allclose(motion(TIME, pushed, (0.05, -0.2)), run.y.T, atol=1e-6)
