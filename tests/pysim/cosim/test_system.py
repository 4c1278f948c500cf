"""What a system refuses, and what it says of it."""

import numpy as np
import pytest

from pysim.control import PI, Gain
from pysim.cosim import Connection, Iterated, Sampled, System, cosimulate
from pysim.types import BadInput, Experiment, Port, Signal
from tests.cosim_parts import Linear, mass, oscillators, spring

PARTS = (mass("a", 1, 1, 1, 0.0), mass("b", 1, 1, 1, 0.0), spring("s", 1.0, 1.0))


@pytest.mark.parametrize(
    ("wires", "words"),
    [
        ([("a.y", "b.F")], "there is no output 'a.y'; near it: a.x, a.v; outputs of a: a.x, a.v"),
        ([("a.F", "b.F")], "there is no output 'a.F'; it is an input; outputs of a: a.x, a.v"),
        ([("s.F_a", "a.x")], "there is no input 'a.x'; it is an output; inputs of a: a.F"),
        ([("s.Fa", "a.F")], "there is no output 's.Fa'; near it: s.F_a, .*outputs of s: s.F_a, s.F_b"),
        ([("c.x", "s.x_a")], "there is no output 'c.x'; members: a, b, s"),
        ([("a", "s.x_a")], "there is no output 'a'"),
        ([("a.x", "b.F")], "the output is in 'm', the input in 'N'"),
        (
            [("a.x", "s.x_a"), ("b.x", "s.x_a")],
            r"s.x_a is driven by a.x and by b.x; remove one \(inputs still free: a.F",
        ),
    ],
)
def test_wrong_wires_are_refused(wires: list[tuple[str, str]], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        System(PARTS, tuple(Connection(*wire) for wire in wires))


def test_wrong_members_are_refused() -> None:
    with pytest.raises(BadInput, match="no members"):
        System(())
    with pytest.raises(BadInput, match="'a' is there twice"):
        System((PARTS[0], PARTS[0]))
    with pytest.raises(BadInput, match=r"'a\.b'; give a name without a dot"):
        System((mass("a.b", 1, 1, 1, 0.0),))
    with pytest.raises(BadInput, match=r"has no 'name'.*Sampled\(name, block"):
        System((PI(1.0, 1.0, 1.0),))  # type: ignore[arg-type]
    with pytest.raises(BadInput, match="members is 'abc'"):
        System("abc")  # type: ignore[arg-type]
    with pytest.raises(BadInput, match="is no Connection"):
        System(PARTS, (("a.x", "s.x_a"),))  # type: ignore[arg-type]
    with pytest.raises(BadInput, match="outputs of c: 'y' is there twice"):
        System((Linear("c", (), (Port("y"), Port("y")), A=[[0]], B=np.zeros((1, 0)), C=[[1], [1]]),))


def test_feedthrough_has_to_exist() -> None:
    class Wrong(Linear):
        feedthrough = {"x": frozenset({"y"})}  # noqa: RUF012

    with pytest.raises(BadInput, match="the feedthrough of w names 'y'"):
        System((Wrong("w", (Port("F"),), (Port("x"),), A=[[0]], B=[[1]], C=[[1]]),))


def through(name: str, gain: float, start: float | None = None) -> Linear:
    """y = gain u, at once."""
    return Linear(name, (Port("u", start=start),), (Port("y"),), A=[[0]], B=[[0]], C=[[1]], D=[[gain]], x0=[1.0])


def test_algebraic_loops_are_found_and_named() -> None:
    wires = (Connection("p.y", "q.u"), Connection("q.y", "p.u"))
    system = System((through("p", 0.5), through("q", -3.0), through("r", 1.0, start=0.0)), wires)
    assert system.loops == (("p.y", "q.y", "p.y"),)
    assert oscillators().loops == ()
    experiment = Experiment(np.linspace(0, 1, 3), ("p.y", "q.y", "r.y"))
    with pytest.raises(BadInput, match=r"algebraic loop p.y -> q.y -> p.y; give .* a delay, .* order=Iterated\(\)"):
        cosimulate(system, experiment, step=0.5)
    # p = 1 + q/2, q = 1 - 3p; plain iteration would run away
    record = cosimulate(system, experiment, step=0.5, order=Iterated())
    assert record["p.y"] == pytest.approx(np.full(3, 0.6), rel=1e-9)
    assert record["q.y"] == pytest.approx(np.full(3, -0.8), rel=1e-9)
    assert record["r.y"] == pytest.approx(np.ones(3))
    assert record.statistics["loop_evaluations"] > 0


def test_a_sampled_block_in_a_loop_is_stepped_once() -> None:
    plant = through("p", 2.0)
    wires = (Connection("p.y", "c.measured"), Connection("c.u", "p.u"))
    system = System((plant, Sampled("c", PI(0.1, 0.5, 0.1), 0.1)), wires)
    assert system.loops == (("p.y", "c", "p.y"),)
    times = np.linspace(0, 1, 11)
    drive = {"c.reference": Signal.constant(3.0)}
    record = cosimulate(system, Experiment(times, ("p.y", "c.u"), drive), step=0.1, order=Iterated())
    # u_k = u_{k-1} + K (e_k - e_{k-1}) + K dt/T e_{k-1} with e_k = 3 - y_k and y_k = 1 + 2 u_k, solved for u_k; the
    # first sample adds the integral of its own error only.
    u = 0.02 * 2.0 / (1 + 0.02 * 2.0)
    known = [u]
    for _ in times[1:]:
        error = 2.0 - 2.0 * u
        u = (u + 0.1 * (2.0 - error) + 0.02 * error) / (1 + 0.1 * 2.0)
        known.append(u)
    assert record["c.u"] == pytest.approx(np.array(known), rel=1e-8)


def test_a_delay_opens_a_loop() -> None:
    wires = (Connection("p.y", "c.u"), Connection("c.y", "p.u"))
    parts = (through("p", 2.0), Sampled("c", Gain(0.1), 0.1, delay=0.1))
    assert System(parts, wires).loops == ()
