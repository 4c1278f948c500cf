"""Two FMUs that are coupled oscillators, against their closed form."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

import fmu_build
from pysim.cosim import Bond, Connection, GaussSeidel, Iterated, Jacobi, Order, System, cosimulate
from pysim.cosim.members import Fmu
from pysim.io import read_model
from pysim.simulate import Rodas
from pysim.types import Experiment
from validation.findings import Finding

Array = NDArray[np.float64]

ORDERS: dict[str, Order] = {
    "Jacobi": Jacobi(),
    "Gauss-Seidel": GaussSeidel(),
    "Jacobi, lines": Jacobi(lines=True),
    "Gauss-Seidel, lines": GaussSeidel(lines=True),
    "iterated": Iterated(),
}
STEPS = (8e-3, 4e-3, 2e-3, 1e-3)  # s
TIMES = np.linspace(0, 2, 26)  # s
SOLVER = Rodas(rtol=1e-10, atol=1e-10)  # of the members: their own error is out of sight
_LIBRARY = Path(__file__).with_name("Oscillators.mo")


def system(fmi: int = 2, interface: str = "model-exchange") -> System:
    """Both FMUs, wired, with their power bond."""
    members = [
        Fmu(name.lower(), read_model(fmu_build.build(f"Oscillators.{name}", libraries=[_LIBRARY], fmi=fmi)),
            interface=interface, solver=SOLVER)
        for name in ("Left", "Right")
    ]  # fmt: skip
    wires = (
        Connection("left.x", "right.x_l"),
        Connection("left.v", "right.v_l"),
        Connection("right.F", "left.F"),
    )
    return System(tuple(members), wires, (Bond("between", effort="left.F", flow="right.v_l"),))


def closed_form(times: Array) -> Array:
    """Positions of both masses (n_t, 2), by the matrix exponential of the whole, with the numbers of Oscillators.mo."""
    whole = np.array([[0, 1, 0, 0], [-40, -0.6, 30, 0.5], [0, 0, 0, 1], [15, 0.25, -35, -0.4]])
    return np.array([(expm(whole * t) @ [1.0, 0, 0, 0])[[0, 2]] for t in times])


@cache
def errors() -> dict[str, tuple[Array, Array]]:
    """Largest error of a position (m) and size of the energy that the coupling made (J), (n_steps) each, by order."""
    known, experiment, both = closed_form(TIMES), Experiment(TIMES, ("left.x", "right.x")), system()
    found = {}
    for name, order in ORDERS.items():
        records = [cosimulate(both, experiment, step=step, order=order) for step in STEPS]
        found[name] = (
            np.array([np.abs(record.values[:, :2] - known).max() for record in records]),
            np.array([abs(record["between.residual"][-1]) for record in records]),
        )
    return found


def findings() -> Iterator[Finding]:
    """The order of convergence of each, from the last two steps, and errors at the smallest."""
    for name, (error, energy) in errors().items():
        claimed = ORDERS[name].accuracy
        slope = float(np.log2(error[-2] / error[-1]))
        text = f"oscillators, {name}: order {slope:.2f} short of the claimed {claimed}"
        yield Finding(text, claimed - slope, 0.1, "")
        limit = 2e-2 if claimed == 1 else 3e-5
        yield Finding(f"oscillators, {name}: largest error at 1 ms of the closed form", float(error[-1]), limit, "m")
        if name != "iterated":
            shrinks = float(np.log2(energy[-2] / energy[-1]))
            yield Finding(
                f"oscillators, {name}: energy residual shrinks with order {shrinks:.2f}, short of {claimed}",
                claimed - shrinks, 0.2, "",
            )  # fmt: skip
    known = closed_form(TIMES)
    for fmi in (2, 3):
        experiment = Experiment(TIMES, ("left.x", "right.x"))
        record = cosimulate(system(fmi, "co-simulation"), experiment, step=2e-3, order=Iterated())
        worst = float(np.abs(record.values[:, :2] - known).max())
        claim = f"oscillators, iterated, FMI {fmi} co-simulation put back at each step: largest error at 2 ms"
        yield Finding(claim, worst, 1e-4, "m")
    residual = float(errors()["iterated"][1][-1])
    yield Finding("oscillators, iterated: energy made by the coupling, of 20 J in it", residual, 1e-6, "J")
