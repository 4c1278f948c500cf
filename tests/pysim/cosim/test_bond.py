"""Power bonds: what is one, and what the balance shows."""

import numpy as np
import pytest

from pysim.cosim import Bond, Connection, GaussSeidel, Jacobi, System, cosimulate
from pysim.types import BadInput, Experiment
from tests.cosim_parts import DAMPING, STIFFNESS, Linear, oscillators


def with_bond(bond: Bond) -> System:
    system = oscillators()
    return System(system.members, system.connections, (bond,))


@pytest.mark.parametrize(
    ("bond", "words"),
    [
        (Bond("b", "left.F", "right.w"), "there is no input 'right.w'"),
        (Bond("b", "left.F", "right.x"), "N times m is no power in W; pair Pa with m3/s"),
        (Bond("b", "left.F", "left.F"), "do not go to and fro between two members"),
    ],
)
def test_what_is_no_bond_is_refused(bond: Bond, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        with_bond(bond)


def test_a_bond_needs_its_wires() -> None:
    system = oscillators()
    with pytest.raises(BadInput, match=r"bond b: nothing is connected to right\.v"):
        System(system.members, system.connections[::2], (Bond("b", "left.F", "right.v"),))


def test_a_bond_has_no_offset() -> None:
    system = oscillators()
    wires = (*system.connections[:2], Connection("right.F", "left.F", offset=1.0))
    with pytest.raises(BadInput, match=r"bond between: right\.F -> left\.F adds an offset"):
        System(system.members, wires, system.bonds)


def test_power_and_residual_of_held_inputs() -> None:
    h, times = 1e-3, np.arange(0, 401) * 1e-3
    record = cosimulate(oscillators(), Experiment(times, ("right.F", "left.v", "left.x")), step=h)
    assert record.names[3:] == ("between.power", "between.residual")
    assert record.units[3:] == ("W", "J")
    force, speed, place = record["right.F"], record["left.v"], record["left.x"]
    # The force follows x and v at once, so that within a step, with both held, it ends short of the next point's.
    held = force[1:] + STIFFNESS[2] * np.diff(place) + DAMPING[2] * np.diff(speed)
    given = h * (force[:-1] + held) / 2 * speed[:-1]
    taken = h * force[:-1] * (speed[:-1] + speed[1:]) / 2
    assert record["between.power"][1:] == pytest.approx(given / h, rel=1e-9, abs=1e-9)
    assert record["between.residual"][1:] == pytest.approx(np.cumsum(given - taken), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_factors_do_not_change_the_balance(sign: float) -> None:
    system, plain = oscillators(), oscillators()
    right = system.members[1]
    assert isinstance(right, Linear)
    # The right member gives a quarter of its force, perhaps with the other sign; the wire makes up for it.
    right.C[0], right.D[0] = sign * right.C[0] / 4, sign * right.D[0] / 4
    wires = (*system.connections[:2], Connection("right.F", "left.F", factor=4 * sign))
    scaled = System(system.members, wires, (Bond("between", effort="left.F", flow="right.v"),))
    experiment = Experiment(np.linspace(0, 1, 11), ("left.x",))
    for order in (Jacobi(), GaussSeidel()):
        one, other = (cosimulate(s, experiment, step=0.005, order=order) for s in (plain, scaled))
        assert other["left.x"] == pytest.approx(one["left.x"], rel=1e-12)
        assert 4 * sign * other["between.residual"] == pytest.approx(one["between.residual"], rel=1e-9, abs=1e-12)
