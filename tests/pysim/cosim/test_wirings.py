"""Two hundred random wirings: each runs, or is refused with one clear line."""

import re

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from pysim.control import PI, Gain, ZeroSwitch
from pysim.cosim import Connection, Doubling, GaussSeidel, Iterated, Jacobi, Sampled, System, cosimulate
from pysim.types import BadInput, Experiment, Outcome, Port, Signal
from tests.cosim_parts import Linear

UNITS = ("1", "Pa", "bar", "m")
TIMES = np.linspace(0.0, 0.4, 5)
NAMES = "abcde"


def lag(name: str, unit: str, **more: bool) -> Linear:
    """A first-order lag with two inputs; its second output follows an input at once."""
    ports = (Port("u", unit), Port("w", unit, 0.25)), (Port("y", unit), Port("z", unit))
    return Linear(name, *ports, A=[[-2.0]], B=[[1.0, 0.5]], C=[[1.0], [0.3]], D=[[0, 0], [0.4, 0]], x0=[0.5], **more)


def make(name: str, kind: str, unit: str) -> object:
    """A member of one of several kinds."""
    if kind == "lag":
        return lag(name, unit)
    if kind == "stubborn":
        return lag(name, unit, can_rollback=False, can_vary_step=False)
    if kind == "eventful":
        member = lag(name, unit)
        member.breaks, member.kick, member.may_return_early = (0.13, 0.2), 0.5, True
        return member
    if kind == "gain":
        return Sampled(name, Gain(0.5, unit, unit), every=0.1)
    if kind == "late":
        return Sampled(name, Gain(0.5, unit, unit), every=0.2, delay=0.1, hold=1)
    if kind == "pi":
        return Sampled(name, PI(0.5, 1.0, 0.1, unit, unit), every=0.1)
    return Sampled(name, ZeroSwitch(0.2, unit), every=0.1)


KINDS = ("lag", "lag", "stubborn", "eventful", "gain", "late", "pi", "switch")
PORTS = ("u", "w", "y", "z", "reference", "measured", "speed")
wiring = st.tuples(
    st.lists(st.tuples(st.sampled_from(KINDS), st.sampled_from(UNITS)), min_size=1, max_size=5),
    st.lists(
        st.tuples(
            st.sampled_from(NAMES),
            st.sampled_from(PORTS),
            st.sampled_from(NAMES),
            st.sampled_from(PORTS),
            st.integers(0, 29),
        ),
        max_size=12,
    ),
    st.sampled_from((Jacobi(), Jacobi(lines=True), GaussSeidel(), GaussSeidel(lines=True), Iterated())),
    st.sampled_from((None, None, None, Doubling(rtol=0.1, halvings=20))),
    st.sampled_from((True, True, False)),
)


def sensible(members: list, wires: list) -> list[tuple[str, str]]:
    """The wires drawn, most of them bent to ports that exist; the rest as wrong as they were drawn."""
    bent = []
    for one, out, other, into, luck in wires:
        source, target = (members[NAMES.index(n) % len(members)] for n in (one, other))
        if luck:
            out = source.outputs[PORTS.index(out) % len(source.outputs)].name
            into = target.inputs[PORTS.index(into) % len(target.inputs)].name
            bent.append((f"{source.name}.{out}", f"{target.name}.{into}"))
        else:
            bent.append((f"{one}.{out}", f"{other}.{into}"))
    return bent


@settings(max_examples=200, derandomize=True, database=None, suppress_health_check=list(HealthCheck))
@given(wiring)
def test_every_wiring_runs_or_is_refused_in_one_line(drawn: tuple) -> None:
    kinds, wires, order, doubling, fill = drawn
    units = [unit if number and not fill else kinds[0][1] for number, (_, unit) in enumerate(kinds)]
    members = [make(NAMES[i], kind, unit) for i, ((kind, _), unit) in enumerate(zip(kinds, units, strict=True))]
    pairs = sensible(members, wires)
    if fill:  # one wire per input, and a signal where there is none
        pairs = list({target: (source, target) for source, target in pairs}.values())
    try:
        system = System(members, tuple(Connection(*pair) for pair in pairs))
        driven = system.drivers if fill else {**system.drivers, **system.inputs}
        inputs = {name: Signal.constant(1.0) for name in system.inputs if name not in driven}
        record = cosimulate(
            system,
            Experiment(TIMES, tuple(system.outputs), inputs),
            step=0.1,
            order=order,
            doubling=doubling,
            check=False,
        )
    except BadInput as error:
        text = str(error)
        assert "\n" not in text
        assert re.search(r"[;(]", text), f"no cure: {text}"
        outcomes["refused"] += 1
        return
    if record.outcome is Outcome.DONE:
        assert record.time.size == TIMES.size
        assert np.isfinite(record.values).all()
        outcomes["done"] += 1
    else:
        assert record.outcome in (Outcome.NOT_CONVERGED, Outcome.STEP_TOO_SMALL), record.message
        assert "\n" not in record.message
        outcomes["stopped"] += 1


outcomes = {"done": 0, "refused": 0, "stopped": 0}


def test_both_happened_often() -> None:
    """Of the wirings above; else they would prove little."""
    assert outcomes["done"] > 20
    assert outcomes["refused"] > 20
    assert outcomes["stopped"] < 5
