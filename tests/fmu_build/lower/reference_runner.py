"""A small runner of `OdeModel` that spells out its semantics; independent of the generated C and its runtime."""

from collections.abc import Callable, Mapping
from dataclasses import fields

import casadi as ca
import numpy as np
from scipy.integrate import DOP853

from fmu_build.lower import OdeModel

RESULTS = (
    "derivatives", "outputs", "residual", "updates_d", "updates_b", "updates_x",
    "calculated", "start_x", "start_d", "start_q", "initial_residual", "guess_i",
)  # fmt: skip


class Compiled:
    """An expression of a model as a function of all its symbols, called without a conversion of each of them."""

    def __init__(self, name: str, symbols: ca.SX, value: ca.SX) -> None:
        function = ca.Function(name, [symbols], [ca.densify(value)])
        self.arguments, self.result = np.zeros(symbols.numel()), np.zeros(value.numel())
        self.buffer, self.evaluate = function.buffer()
        self.buffer.set_arg(0, memoryview(self.arguments))
        self.buffer.set_res(0, memoryview(self.result))

    def __call__(self, values: np.ndarray) -> np.ndarray:
        """Column by column, as one vector."""
        self.arguments[:] = values
        self.evaluate()
        return self.result.copy()


class Runner:
    """One run of a model; `at(name)` reads a variable at the present time.

    Args:
        parameters: values by name.
        start: start values of states and discrete variables by name.
        inputs: time -> values of u.
    """

    def __init__(
        self,
        model: OdeModel,
        parameters: Mapping[str, float] | None = None,
        start: Mapping[str, float] | None = None,
        inputs: Callable[[float], list[float]] = lambda t: [],
    ) -> None:
        self.model, self.inputs = model, inputs
        self.names = [field.name for field in fields(model.symbols)]
        symbols = ca.vertcat(*(ca.vec(getattr(model.symbols, name)) for name in self.names))
        expressions = {name: getattr(model, name) for name in RESULTS}
        expressions["indicators"] = ca.vertcat(ca.SX(0, 1), *(r.value for r in model.relations))
        expressions["instants"] = ca.vertcat(
            ca.SX(0, 1), *(r.instant for r in model.relations if r.instant is not None)
        )
        expressions["clocks"] = ca.vertcat(
            ca.SX(0, 1), *(part for s in model.samples for part in (s.start, s.interval))
        )
        expressions["sources"] = ca.vertcat(ca.SX(0, 1), *(delay.source for delay in model.delays))
        expressions["delays"] = ca.vertcat(ca.SX(0, 1), *(delay.time for delay in model.delays))
        expressions["checks"] = ca.vertcat(ca.SX(0, 1), *(check.condition for check in model.checks))
        expressions["terminations"] = ca.vertcat(ca.SX(0, 1), *(check.condition for check in model.terminations))
        s = model.symbols
        expressions["dgdq"] = ca.jacobian(model.residual, s.q)
        expressions["dgdi"] = ca.jacobian(model.initial_residual, s.i)
        self.functions = {name: Compiled(name, symbols, value) for name, value in expressions.items()}
        self.values = {name: np.zeros(getattr(s, name).numel()) for name in self.names}
        for vector in ("p", "x", "d", "u"):
            for variable in model.variables:
                if variable.vector == vector and variable.start is not None:
                    self.values[vector][variable.index] = variable.start
        for name, value in {**(parameters or {}), **(start or {})}.items():
            variable = self.variable(name)
            self.values[variable.vector][variable.index] = value
        self.time, self.history, self.terminated, self.failed = 0.0, [], False, []
        self._initialise()

    def variable(self, name: str):
        return next(variable for variable in self.model.variables if variable.name == name)

    def at(self, name: str) -> float:
        variable = self.variable(name)
        if variable.vector == "w":
            return float(self.get("outputs")[variable.index])
        if variable.vector == "dx":
            return float(self.get("derivatives")[variable.index])
        return float(self.values[variable.vector][variable.index])

    def get(self, name: str) -> np.ndarray:
        self.values["t"] = np.array([self.time])
        return self.functions[name](np.concatenate([self.values[key] for key in self.names]))

    def run(self, stop: float) -> "Runner":
        """Integrate to `stop` with every event on the way."""
        if self.time == 0.0:
            self._event()
        while self.time < stop - 1e-12 and not self.terminated:
            next_time = min([stop, *self._time_events()])
            self._integrate(next_time)
            self._event()
        return self

    # Initialisation: parameters, initial equations, start values, then the event iteration with initial() on.
    def _initialise(self) -> None:
        user_x, user_d = self.values["x"].copy(), self.values["d"].copy()
        self.values["u"] = np.array(self.inputs(0.0) or self.values["u"], dtype=float)
        self.values["c"] = self.get("calculated")
        self.values["i"] = self.get("guess_i")
        for _ in range(10):
            self._newton("i", "initial_residual", "dgdi")
            self.values["x"], self.values["d"] = user_x, user_d
            x, d, q = self.get("start_x"), self.get("start_d"), self.get("start_q")
            self.values |= {"x": x, "d": d, "q": q, "pre_d": d.copy()}
            self._solve()
            self.values["v"] = self.get("sources")
            self._relations(at_start=True)
        self.values["pre_b"] = self.get("updates_b")
        self._iterate(0)

    def _newton(self, unknown: str, residual: str, jacobian: str) -> None:
        if self.values[unknown].size == 0:
            return
        for _ in range(50):
            if unknown == "i":
                self.values["c"] = self.get("calculated")
            g = self.get(residual)
            matrix = self.get(jacobian).reshape((g.size, -1), order="F")
            step = np.linalg.solve(matrix, g)
            self.values[unknown] = self.values[unknown] - step
            if np.max(np.abs(step)) < 1e-13 * (1 + np.max(np.abs(self.values[unknown]))):
                break
        self.values["c"] = self.get("calculated")

    def _solve(self) -> None:
        self._newton("q", "residual", "dgdq")
        if self.values["i"].size == 0:
            self.values["c"] = self.get("calculated")

    def _relations(self, at_start: bool = False) -> None:
        strict = np.array([relation.strict for relation in self.model.relations], dtype=bool)
        of_time = np.array([relation.instant is not None for relation in self.model.relations], dtype=bool)
        z, now = self.get("indicators"), self.time
        self.time = now + (0.0 if at_start else 1e-11)  # after a time event the interval counts that begins there
        z, self.time = np.where(of_time, self.get("indicators"), z), now
        self.values["r"] = np.where(strict, z > 0, z >= 0).astype(float)

    # Passes until nothing changes: relations, then discrete variables, when-conditions and states at once.
    def _iterate(self, flag: int | None, ticks: tuple[int, ...] = ()) -> None:
        for k in (*ticks, *([] if flag is None else [flag])):
            self.values["e"][k] = 1.0
        for _ in range(50):
            self._solve()
            self._relations(at_start=flag == 0)
            self.values["pre_d"] = self.values["d"].copy()
            new = {key: self.get(f"updates_{key}") for key in ("d", "b", "x")}
            self.terminated = self.terminated or bool(np.any(self.get("terminations")))
            before = [self.values[key] for key in ("d", "pre_b", "x")]
            same = all(np.array_equal(a, b) for a, b in zip(before, new.values(), strict=True))
            self.values |= {"d": new["d"], "pre_b": new["b"], "x": new["x"]}
            if same:
                break
        else:
            raise AssertionError("event iteration does not come to rest")
        self.values["e"] = np.zeros_like(self.values["e"])
        self._solve()
        self.values["pre_b"] = self.get("updates_b")
        self.failed += [c.message for c, ok in zip(self.model.checks, self.get("checks"), strict=True) if not ok]

    def _time_events(self) -> list[float]:
        instants = [t for t in self.get("instants") if t > self.time + 1e-12]
        clocks = self.get("clocks").reshape(-1, 2)
        return instants + [s + max(0, np.floor((self.time - s) / h + 1e-9) + 1) * h for s, h in clocks]

    def _event(self) -> None:
        clocks = self.get("clocks").reshape(-1, 2)
        turns = [(self.time - s) / h for s, h in clocks]
        ticks = tuple(2 + k for k, turn in enumerate(turns) if turn > -1e-9 and abs(turn - round(turn)) < 1e-9)
        self._iterate(None, ticks)

    def _rate(self, t: float, x: np.ndarray) -> np.ndarray:
        self._move(t, x)
        return self.get("derivatives")

    def _move(self, t: float, x: np.ndarray) -> None:
        self.time, self.values["x"] = t, x
        if self.values["u"].size:
            self.values["u"] = np.array(self.inputs(t) or self.values["u"], dtype=float)
        self._delays()
        self._solve()

    def _delays(self) -> None:
        if not self.model.delays:
            return
        now, x = self.time, self.values["x"]
        delayed = []
        for k, past in enumerate(now - self.get("delays")):
            piece = next((p for p in self.history if p[0] <= past <= p[1]), None)
            self.time = max(past, 0.0)
            self.values["x"] = x if piece is None and not self.history else (piece or self.history[0])[2](self.time)
            if self.values["u"].size:
                self.values["u"] = np.array(self.inputs(self.time), dtype=float)
            delayed.append(self.get("sources")[k])
        self.time, self.values["x"], self.values["v"] = now, x, np.array(delayed)
        if self.values["u"].size:
            self.values["u"] = np.array(self.inputs(now), dtype=float)

    def _integrate(self, stop: float) -> None:
        if self.values["x"].size == 0 or stop - self.time < 1e-13:
            self._move(stop, self.values["x"])
            return
        watched = np.array([relation.instant is None for relation in self.model.relations], dtype=bool)
        held = self.get("indicators")[watched]
        shortest = min([*(self.get("delays") / 2), np.inf])
        solver = DOP853(
            self._rate, self.time, self.values["x"], stop, rtol=1e-11, atol=1e-13, max_step=min(shortest, 0.05)
        )
        while solver.status == "running":
            begin = solver.t
            solver.step()
            dense = solver.dense_output()
            self._move(solver.t, solver.y)
            z = self.get("indicators")[watched]
            self.history.append((begin, solver.t, dense))
            if np.any((z > 0) != (held > 0)):
                self._locate(begin, solver.t, dense, held, watched)
                return
            held = z

    def _locate(self, low: float, high: float, dense, held: np.ndarray, watched: np.ndarray) -> None:
        while high - low > 1e-14 * max(1.0, abs(high)):
            middle = 0.5 * (low + high)
            if middle in (low, high):
                break
            self._move(middle, dense(middle))
            crossed = np.any((self.get("indicators")[watched] > 0) != (held > 0))
            low, high = (low, middle) if crossed else (middle, high)
        self._move(high, dense(high))
