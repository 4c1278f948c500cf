"""An FMU of any vendor as a member: it steps by itself, or our own solver steps it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol

from pysim.cosim.member import Setup
from pysim.cosim.members._exchange import Exchange
from pysim.cosim.members._stepping2 import Stepping2
from pysim.cosim.members._stepping3 import Stepping3
from pysim.simulate import Rodas, Solver, can_be_saved, check_override, is_number, is_smooth
from pysim.types import BadInput, Model, Port, Variable

_INTERFACES = ("", "co-simulation", "model-exchange")
_FEEDTHROUGH = ("standard", "declared", "none")
_NOT_READ = frozenset(("Int8", "UInt8", "Int16", "UInt16", "UInt32", "UInt64"))  # by the native loop
_NOTHING: Mapping[str, float] = {}

_alone: dict[Path, str] = {}  # FMUs that can be there only once in a process, and who has them now


class _Run(Protocol):
    """One run of an FMU: the calls of `Member`."""

    event: bool

    def start(self, setup: Setup, overrides: Mapping[str, float]) -> None: ...
    def begin(self) -> None: ...
    def update(self) -> None: ...
    def step(self, time: float, end: float) -> float: ...
    def save(self, into: Any = None) -> Any: ...
    def restore(self, state: Any) -> None: ...
    def close(self) -> None: ...


class Fmu:
    """An FMU in a system; a `Member`.

    Its ports are all inputs and outputs that are single numbers, in the FMU's own units.

    Args:
        name: in the system.
        model: FMI 2.0 or 3.0, of any vendor, from `pysim.io.read_model`.
        parameters: parameter, start value or input -> number, in its unit; an input that is given one here need not be
            connected. The experiment's overrides go before.
        record: further variables to have as outputs, so that they can be recorded; as a step leaves them.
        interface: "co-simulation" (it steps by itself) or "model-exchange" (`solver` steps it); "" takes the first of
            them that it offers.
        solver: for model exchange.
        events: False lets an FMI 3 FMU handle its events alone, at the price of events that others see a step later.
        feedthrough: which outputs follow inputs at once. "standard": as the FMU declares it, and where it does not,
            all inputs; "declared": as it declares it, and no more; "none": outputs are what a step leaves, which is all
            that FMI 2.0 co-simulation asks of an FMU, and what most other masters take.
    Raises:
        BadInput: an unknown name, a value that cannot be set, an interface the FMU does not offer.
    """

    def __init__(
        self,
        name: str,
        model: Model,
        *,
        parameters: Mapping[str, float] = _NOTHING,
        record: tuple[str, ...] = (),
        interface: str = "",
        solver: Solver = Rodas(),  # noqa: B008
        events: bool = True,
        feedthrough: str = "standard",
    ) -> None:
        if not isinstance(model, Model):
            raise BadInput(f"{name}: model is {model!r}; give what pysim.io.read_model makes of an .fmu file")
        self.name, self.model, self.solver, self.events = name, model, solver, events
        self.parameters, self.record = dict(parameters), tuple(record)
        for parameter, value in self.parameters.items():
            _check(model, parameter, value)
        self.interface = _interface(name, model, interface)
        self.inputs = tuple(self._input(v) for v in model.variables if v.causality == "input" and _fits(model, v))
        outputs = [v for v in model.variables if v.causality == "output" and _fits(model, v, self.interface)]
        self.outputs = tuple(_output(v) for v in (*outputs, *_recorded(model, self.record, self.interface)))
        self.feedthrough = self._feedthrough(feedthrough)
        self._names = (tuple(p.name for p in self.inputs), tuple(p.name for p in self.outputs))
        self._run: _Run = _Closed(name)

    def __repr__(self) -> str:
        return f"Fmu({self.name!r}, {self.model.path.name}, {self.interface})"

    def _input(self, variable: Variable) -> Port:
        start = self.parameters.get(variable.name)
        return Port(variable.name, variable.unit, None if start is None else float(start))

    def _feedthrough(self, wanted: str) -> Mapping[str, frozenset[str]]:
        if wanted not in _FEEDTHROUGH:
            raise BadInput(f"{self.name}: feedthrough {wanted!r} is not known; write one of {', '.join(_FEEDTHROUGH)}")
        ports = frozenset(port.name for port in self.inputs)
        told = {} if wanted == "none" else dict(self.model.abilities.feedthrough)
        unknown = ports if wanted == "standard" else frozenset()
        found = {}
        for port in self.outputs:
            depends = told.get(port.name, frozenset())
            found[port.name] = unknown if depends is None else depends & ports
        return {name: inputs for name, inputs in found.items() if inputs}

    @property
    def can_rollback(self) -> bool:
        """Whether `save` and `restore` work."""
        stepping = self.model.abilities.stepping
        if self.interface == "model-exchange" or stepping is None:
            return can_be_saved(self.model)
        return stepping.state_handling

    @property
    def can_vary_step(self) -> bool:
        """Whether steps may differ in size."""
        stepping = self.model.abilities.stepping
        return self.interface == "model-exchange" or stepping is None or stepping.variable_step

    @property
    def takes_rates(self) -> bool:
        """Whether inputs may be straight lines within a step: where our own solver steps, and all are continuous."""
        return self.interface == "model-exchange" and all(is_smooth(self.model, port.name) for port in self.inputs)

    @property
    def may_return_early(self) -> bool:
        """Whether a step may end at an event."""
        stepping = self.model.abilities.stepping
        return (
            self.interface == "co-simulation"
            and stepping is not None
            and self.events
            and (stepping.event_mode or stepping.early_return)
        )

    @property
    def event(self) -> bool:
        """Whether the step that just ended left an event."""
        return self._run.event

    def start(self, setup: Setup) -> None:
        """See Member."""
        self.close()
        for name, value in setup.overrides.items():
            check_override(self.model, name, value)
            if self.model[name].causality == "input":
                raise BadInput(f"experiment: {self.name}.{name} is an input; give it a signal instead of an override")
        inputs, _ = self._names
        own = {name: value for name, value in self.parameters.items() if name not in inputs}
        self._claim()
        self._run = self._new_run()
        self._run.start(setup, {**own, **setup.overrides})

    def _claim(self) -> None:
        """Some FMUs can be there only once in a process.

        Raises:
            BadInput: it is there already.
        """
        stepping, abilities = self.model.abilities.stepping, self.model.abilities
        steps_itself = self.interface == "co-simulation" and stepping is not None
        if not (stepping if steps_itself else abilities).single_instance:  # type: ignore[union-attr]
            return
        other = _alone.get(self.model.path)
        if other is not None:
            raise BadInput(
                f"{self.name}: {self.model.path.name} allows one instance per process, and {other} is it; put one of "
                "them into a process of its own, Isolated(...)"
            )
        _alone[self.model.path] = self.name

    def _new_run(self) -> _Run:
        stepping = self.model.abilities.stepping
        if self.interface == "model-exchange" or stepping is None:
            return Exchange(self.model, self.solver, self._names)
        if self.model.abilities.fmi == 2:
            return Stepping2(self.name, self.model, stepping, self._names)
        return Stepping3(self.name, self.model, stepping, self._names, self.events)

    def begin(self) -> None:
        """See Member."""
        self._run.begin()

    def update(self) -> None:
        """See Member."""
        self._run.update()

    def step(self, time: float, end: float) -> float:
        """See Member."""
        return self._run.step(time, end)

    def save(self, into: Any = None) -> Any:
        """See Member."""
        return self._run.save(into)

    def restore(self, state: Any) -> None:
        """See Member."""
        self._run.restore(state)

    def close(self) -> None:
        """See Member."""
        run, self._run = self._run, _Closed(self.name)
        run.close()
        if _alone.get(self.model.path) == self.name:
            del _alone[self.model.path]


class _Closed:
    """Between two runs."""

    event = False

    def __init__(self, name: str) -> None:
        self._name = name

    def start(self, setup: Setup, overrides: Mapping[str, float]) -> None:
        self._refuse()

    def begin(self) -> None:
        self._refuse()

    def update(self) -> None:
        self._refuse()

    def step(self, time: float, end: float) -> float:
        return self._refuse()

    def save(self, into: Any = None) -> Any:
        self._refuse()

    def restore(self, state: Any) -> None:
        self._refuse()

    def close(self) -> None:
        pass

    def _refuse(self) -> float:
        raise BadInput(f"{self._name} has not been started; call start first")


def _fits(model: Model, variable: Variable, interface: str = "") -> bool:
    """Whether it can be a port: a single number, no clock or text, and of a size that our own loop can read."""
    is_read = interface == "model-exchange" and variable.causality != "input"
    return is_number(model.abilities.fmi, variable.type) and not (is_read and variable.type in _NOT_READ)


def _check(model: Model, name: str, value: float) -> None:
    """Check that a parameter, start value or input can have a value.

    Raises:
        BadInput: it cannot.
    """
    variable = model[name]
    if variable.causality != "input":
        check_override(model, name, value)
    elif not _fits(model, variable):
        raise BadInput(f"{model.path.name}: {name} is {variable.type}, no single number; leave it at its start")
    elif not math.isfinite(value):
        raise BadInput(f"{model.path.name}: {name} cannot be set to {value}; give a finite number")


def _output(variable: Variable) -> Port:
    return Port(variable.name, variable.unit, variable.start)


def _recorded(model: Model, names: tuple[str, ...], interface: str) -> list[Variable]:
    """Variables that are no outputs yet.

    Raises:
        BadInput: an unknown name, or no single number.
    """
    for name in names:
        if not _fits(model, model[name], interface):
            raise BadInput(f"{model.path.name}: {name} is {model[name].type} and cannot be recorded; record a number")
    return [model[name] for name in names if model[name].causality != "output"]


def _interface(name: str, model: Model, wanted: str) -> str:
    offered = [kind for kind, there in zip(_INTERFACES[1:], _offers(model), strict=True) if there]
    if wanted not in _INTERFACES:
        raise BadInput(f"{name}: interface {wanted!r} is not known; write one of {', '.join(offered)}")
    if wanted and wanted not in offered:
        raise BadInput(f"{name}: {model.path.name} does not offer {wanted}; it offers {', '.join(offered)}")
    return wanted or offered[0]


def _offers(model: Model) -> tuple[bool, bool]:
    return model.abilities.stepping is not None, model.abilities.model_exchange
