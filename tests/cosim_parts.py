"""Members of co-simulations whose solution is known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.linalg import expm

from pysim.cosim import Bond, Connection, MemberFailed, Setup, System
from pysim.types import BadInput, Outcome, Port


@dataclass
class Linear:
    """dx/dt = A x + B u, y = C x + D u, exact for inputs that are held or run as lines.

    Args:
        breaks: times at which a step ends early, with an event that adds `kick` to the state.
        fails: from this time on a step fails; `bad` puts out nan instead.
    """

    name: str
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    A: Any
    B: Any
    C: Any
    D: Any = None
    x0: Any = None
    takes_rates: bool = False
    can_rollback: bool = True
    can_vary_step: bool = True
    breaks: tuple[float, ...] = ()
    kick: float = 0.0
    fails: float = np.inf
    bad: float = np.inf
    event: bool = False
    closed: int = 0
    _sizes: dict[float, Any] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        self.A, self.B, self.C = (np.atleast_2d(np.array(m, dtype=float)) for m in (self.A, self.B, self.C))
        n_y, n_u = len(self.outputs), len(self.inputs)
        self.D = np.zeros((n_y, n_u)) if self.D is None else np.array(self.D, dtype=float).reshape(n_y, n_u)
        self.B = self.B.reshape(len(self.A), n_u)
        self.may_return_early = bool(self.breaks)

    @property
    def feedthrough(self) -> Mapping[str, frozenset[str]]:
        return {
            out.name: frozenset(p.name for p, d in zip(self.inputs, row, strict=True) if d)
            for out, row in zip(self.outputs, self.D, strict=True)
        }

    def start(self, setup: Setup) -> None:
        if set(setup.overrides) - {"x0"}:
            raise BadInput(f"{self.name} has no {min(setup.overrides)}")
        self._setup, self.event = setup, False
        start = np.zeros(len(self.A)) if self.x0 is None else np.array(self.x0, dtype=float)
        self.x = np.full(len(self.A), setup.overrides["x0"]) if "x0" in setup.overrides else start
        self._put()

    def begin(self) -> None:
        self._put()

    def update(self) -> None:
        if self.event:
            self.x, self.event = self.x + self.kick, False
        self._setup.rates[:] = 0.0
        self._put()

    def step(self, time: float, end: float) -> float:
        if end > self.fails:
            raise MemberFailed("the model divided by zero", Outcome.MODEL_ERROR)
        reached = min([b for b in self.breaks if time < b < end], default=end)
        whole, of_input, of_rate = self._matrices(reached - time)
        self.x = whole @ self.x + of_input @ self._setup.inputs + of_rate @ self._setup.rates
        self.event = reached in self.breaks
        self._put(reached - time)
        if end > self.bad:
            self._setup.outputs[-1] = np.nan
        return reached

    def save(self, into: Any = None) -> Any:
        return self.x.copy(), self.event

    def restore(self, state: Any) -> None:
        self.x, self.event = state[0].copy(), state[1]

    def close(self) -> None:
        self.closed += 1

    def _put(self, size: float = 0.0) -> None:
        self._setup.outputs[:] = self.C @ self.x + self.D @ (self._setup.inputs + size * self._setup.rates)

    def _matrices(self, size: float) -> Any:
        """x, u and du/dt at a step's begin to x at its end, by one matrix exponential."""
        if size not in self._sizes:
            n_x, n_u = self.B.shape
            big = np.zeros((n_x + 2 * n_u, n_x + 2 * n_u))
            big[:n_x, :n_x], big[:n_x, n_x : n_x + n_u] = self.A, self.B
            big[n_x : n_x + n_u, n_x + n_u :] = np.eye(n_u)
            result = expm(big * size)[:n_x]
            self._sizes[size] = result[:, :n_x], result[:, n_x : n_x + n_u], result[:, n_x + n_u :]
        return self._sizes[size]


def mass(name: str, m: float, k: float, d: float, x: float, **more: Any) -> Linear:
    """A mass on its own spring and damper: force in (N), position (m) and velocity (m/s) out."""
    return Linear(
        name,
        (Port("F", "N"),),
        (Port("x", "m"), Port("v", "m/s")),
        A=[[0, 1], [-k / m, -d / m]],
        B=[[0], [1 / m]],
        C=np.eye(2),
        x0=[x, 0.0],
        **more,
    )


def spring(name: str, k: float, d: float, **more: Any) -> Linear:
    """A spring and damper between two masses, without a state: force on either side (N) from x (m) and v (m/s)."""
    return Linear(
        name,
        (Port("x_a", "m"), Port("v_a", "m/s"), Port("x_b", "m"), Port("v_b", "m/s")),
        (Port("F_a", "N"), Port("F_b", "N")),
        A=np.zeros((1, 1)),
        B=np.zeros((1, 4)),
        C=np.zeros((2, 1)),
        D=[[-k, -d, k, d], [k, d, -k, -d]],
        **more,
    )


STIFFNESS, DAMPING = (10.0, 40.0, 30.0), (0.1, 0.3, 0.5)  # left, right, between; N/m and N.s/m
MASSES = (1.0, 2.0)  # kg


def oscillators(**more: Any) -> System:
    """Two masses on springs, with a spring and damper between them that belongs to the right one.

    The left takes a force and gives position and velocity; the right takes those and gives the force, at once.
    """
    (_, k, c), (_, d, b), (_, m) = STIFFNESS, DAMPING, MASSES
    left = mass("left", MASSES[0], STIFFNESS[0], DAMPING[0], 1.0, **more)
    right = Linear(
        "right",
        (Port("x", "m"), Port("v", "m/s")),
        (Port("F", "N"), Port("x_r", "m")),
        A=[[0, 1], [-(k + c) / m, -(d + b) / m]],
        B=[[0, 0], [c / m, b / m]],
        C=[[c, b], [1, 0]],
        D=[[-c, -b], [0, 0]],
        **more,
    )
    wires = (Connection("left.x", "right.x"), Connection("left.v", "right.v"), Connection("right.F", "left.F"))
    return System((left, right), wires, (Bond("between", effort="left.F", flow="right.v"),))


def oscillation(times: Any) -> Any:
    """Position of the left and of the right mass (n_t, 2) at times (n_t,) s, in closed form."""
    (k_l, k_r, c), (d_l, d_r, b), (m_l, m_r) = STIFFNESS, DAMPING, MASSES
    whole = np.array(
        [
            [0, 1, 0, 0],
            [-(k_l + c) / m_l, -(d_l + b) / m_l, c / m_l, b / m_l],
            [0, 0, 0, 1],
            [c / m_r, b / m_r, -(k_r + c) / m_r, -(d_r + b) / m_r],
        ]
    )
    return np.array([(expm(whole * t) @ [1.0, 0, 0, 0])[[0, 2]] for t in times])
