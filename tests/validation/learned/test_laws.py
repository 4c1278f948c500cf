"""Each law of the plant against its closed form: what it adds to the rates of the pump without it."""

import math
from typing import Any

import numpy as np
import pytest

from validation.blind.plant import Parameters, Strengths
from validation.blind.plant.equations import flow
from validation.blind.plant.quantities import STEP
from validation.learned import laws
from validation.learned.laws import Laws

P = Parameters()
STATE = (0.02, 0.3, 6e-3, 0.05, 9e6, 7e6, 0.0, 0.0, 0.0, 0.0)  # u, u_t, x, v, p1, p2 and what is off
U, X, V, P1, P2 = STATE[0], *STATE[2:6]
T = 40.0


def added(law: Laws, memory: tuple[float, float] = (0.0, 0.0)) -> tuple[dict[str, float], Any]:
    """Rates of spool's speed, piston's speed and pressures, beside those of the pump without a law; of the memories."""
    plain = flow.py_func(T, 0.01, X, STATE, P, Strengths())
    rates, kept = laws._flowing.py_func(T, 0.01, X, STATE, memory, P, Strengths(), law)
    names = ("u", "u_t", "x", "v", "p1", "p2", "drop", "felt", "swing", "swing_t")
    return {n: a - b for n, a, b in zip(names, rates, plain, strict=True) if a != b}, kept


@pytest.mark.parametrize(
    ("law", "force"),
    [
        ({"damping__b": 5e3}, -5e3 * 0.09 * V),
        ({"drift__share": 0.3}, 0.3 * P.b * (1 - math.exp(-T / 60)) * V),
        ({"pressure_friction__c": 4e-5}, -80.0),
        ({"bump__F": 100.0}, -100 * math.exp(-0.16)),
        ({"cushion__k": 1e7}, 0.0),
    ],
)
def test_forces(law: dict[str, float], force: float) -> None:
    found, _ = added(Laws(**law))
    assert set(found) <= {"v"}
    assert P.m_eff * found.get("v", 0.0) == pytest.approx(force, rel=1e-6, abs=1e-9)


def test_the_cushion_acts_near_the_end_alone() -> None:
    end = 0.985 * P.L / 2
    near = (0.0, 0.0, -end - 1e-4, 0.0, *STATE[4:])
    assert laws._force.py_func(T, near, 0.0, P, Laws(cushion__k=1e6)) == pytest.approx(100.0)


def test_a_bristle_ends_at_the_sliding_friction() -> None:
    for law, right in ((Laws(dahl__F=100.0), 100.0), (Laws(lugre__F=100.0), 100 * (1 + 0.6 * math.exp(-4)))):
        z, v = 0.0, 1e-2
        for _ in range(20000):  # 0.2 m of way at 1 cm/s
            z += 1e-3 * laws._bristle.py_func(v, z, law)
        state = (0.0, 0.0, 0.0, v, *STATE[4:])
        assert -laws._force.py_func(T, state, z, P, law) == pytest.approx(right, rel=1e-6)
        _, kept = added(law, (z, 0.0))
        assert kept[0] == pytest.approx(laws._bristle.py_func(V, z, law))


def test_the_flow_force_pulls_the_spool_back_with_the_pressure_over_its_edge() -> None:
    found, _ = added(Laws(flow_force__share=0.2))
    assert found == {"u_t": pytest.approx(-0.2 * P.omega_v**2 * U * (P.p_P - P1) / 1e7)}


def test_the_supply_falls_and_the_edges_see_less() -> None:
    found, _ = added(Laws(supply__r=1e4))
    area = P.k1 * U**3 + P.k2 * U**2 + P.k3 * U
    jets = [area * math.sqrt(2 * (p - P1) / P.rho) for p in (P.p_P, P.p_P - 1e4 * T)]
    assert found == {"p1": pytest.approx(P.beta / (P.V_0 + P.A_p * X) * (jets[1] - jets[0]), rel=1e-6)}


def test_the_notch_takes_a_share_of_a_small_opening() -> None:
    found, _ = added(Laws(notch__share=0.5))
    w = U * (1 - 0.5 * math.exp(-((U / 0.03) ** 2)))
    areas = [P.k1 * o**3 + P.k2 * o**2 + P.k3 * o for o in (U, w)]
    jet = math.sqrt(2 * P2 / P.rho)
    assert found["p2"] == pytest.approx(P.beta / (P.V_0 - P.A_p * X) * (areas[0] - areas[1]) * jet, rel=1e-6)


def test_both_chambers_lose_oil_to_the_tank() -> None:
    found, _ = added(Laws(turbulent__K=1e-7))
    for name, p, volume in (("p1", P1, P.V_0 + P.A_p * X), ("p2", P2, P.V_0 - P.A_p * X)):
        assert found[name] == pytest.approx(-P.beta / volume * 1e-7 * math.sqrt(2 * p / P.rho), rel=1e-6)


def test_edges_follow_the_spool_once_their_play_is_used_up() -> None:
    edge, seen = 0.0, []
    for u in 0.05 * np.sin(np.linspace(0, 4 * math.pi, 4000)):
        state = (float(u), *STATE[1:])
        for _ in range(20):
            edge += (
                STEP
                * laws._flowing.py_func(T, 0.0, X, state, (0.0, edge), P, Strengths(), Laws(edge_play__h=0.01))[1][1]
            )
        seen.append(edge)
    assert max(seen[2000:]) == pytest.approx(0.04, abs=2e-4)
    assert min(seen[2000:]) == pytest.approx(-0.04, abs=2e-4)


def test_a_compliant_play_reaches_the_contact_with_its_lag() -> None:
    behind, law = 0.0, Laws(compliant__d=1e-4)
    for _ in range(round(6e-3 / STEP)):
        behind, _ = laws._followed.py_func(behind, STATE, (0.0, 0.0), P, Strengths(), law)
    assert behind == pytest.approx((X - 1e-4) * (1 - math.exp(-2)), rel=0.01)
    assert laws._followed.py_func(0.0, STATE, (0.0, 0.0), P, Strengths(), Laws()) == (X, V)
