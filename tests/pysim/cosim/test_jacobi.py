"""Jacobi by hand: two integrators that drive each other."""

from collections.abc import Sequence

import numpy as np
import pytest

from pysim.cosim import Connection, Jacobi, Sampled, System, cosimulate
from pysim.types import Experiment, Port, Record
from tests.cosim_parts import Linear


def turning(lines: bool) -> Record:
    """da/dt = b, db/dt = -a, released from (1, 0), with steps of 0.1 s."""
    a, b = (
        Linear(name, (Port("u"),), (Port("y"),), A=[[0.0]], B=[[sign]], C=[[1.0]], x0=[start])
        for name, sign, start in (("a", 1.0, 1.0), ("b", -1.0, 0.0))
    )
    system = System((a, b), (Connection("a.y", "b.u"), Connection("b.y", "a.u")))
    experiment = Experiment(np.linspace(0, 0.3, 4), ("a.y", "b.y"))
    return cosimulate(system, experiment, step=0.1, order=Jacobi(lines=lines))


def test_held_inputs_are_the_explicit_euler_method() -> None:
    rows = [np.array([1.0, 0.0])]
    for _ in range(3):
        rows.append(rows[-1] + 0.1 * np.array([rows[-1][1], -rows[-1][0]]))
    assert turning(lines=False).values == pytest.approx(np.array(rows), rel=1e-12)


def test_lines_are_the_second_adams_bashforth_method() -> None:
    slopes = [np.array([0.0, -1.0])]
    rows = [np.array([1.0, 0.0]), np.array([1.0, -0.1])]  # its first step is Euler's
    for _ in range(2):
        slopes.append(np.array([rows[-1][1], -rows[-1][0]]))
        rows.append(rows[-1] + 0.1 * (1.5 * slopes[-1] - 0.5 * slopes[-2]))
    assert turning(lines=True).values == pytest.approx(np.array(rows), rel=1e-12)


class Switch:
    """On from 0.3 s."""

    inputs, outputs = (), (Port("y"),)

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        return (float(time > 0.29),)


def test_no_line_is_drawn_from_a_stretch_of_rounding() -> None:
    """An event one rounding step ahead of a communication point, at which the input jumps."""
    steps = 0.1 * np.arange(7)
    event = 0.3
    assert 0 < steps[3] - event < 1e-16
    jumping = Linear("j", (Port("u"),), (Port("y"),), A=[[0.0]], B=[[0.0]], C=[[0.0]], D=[[1.0]], breaks=(event,))
    after = Linear("a", (Port("u"),), (Port("y"),), A=[[0.0]], B=[[1.0]], C=[[1.0]])
    wires = (Connection("switch.y", "j.u"), Connection("j.y", "a.u"))
    system = System((Sampled("switch", Switch(), 0.1), jumping, after), wires)
    record = cosimulate(system, Experiment(steps, ("a.y",)), step=0.1, order=Jacobi(lines=True))
    assert record.statistics["events"] == 1
    assert record["a.y"] == pytest.approx(np.maximum(steps - 0.3, 0), abs=1e-12)
