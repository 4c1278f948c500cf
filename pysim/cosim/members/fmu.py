"""An FMU of any vendor as a member: it steps by itself, or our own solver steps it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pysim.cosim.member import Setup
from pysim.cosim.members._exchange import Exchange
from pysim.cosim.members._fmu_ports import check_value, chosen_interface, fits, output_port, recorded
from pysim.cosim.members._fmu_run import Closed, FmuRun
from pysim.cosim.members._stepping2 import Stepping2
from pysim.cosim.members._stepping3 import Stepping3
from pysim.simulate import Rodas, Solver, can_be_saved, check_override, is_smooth
from pysim.types import BadInput, Model, Port, Variable

_FEEDTHROUGH = ("standard", "declared", "none")
_NOTHING: Mapping[str, float] = {}

_alone: dict[Path, Fmu] = {}  # FMUs that can be there only once in a process, and who has them now


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
        events: False lets an FMI 3 FMU handle its events alone; others then see these events a step later.
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
        if isinstance(record, str):
            raise BadInput(f"{name}: record is the text {record!r}; write a tuple of names, ({record!r},)")
        self.parameters, self.record = dict(parameters), tuple(record)
        for parameter, value in self.parameters.items():
            check_value(model, parameter, value)
        self.interface = chosen_interface(name, model, interface)
        self.inputs = tuple(self._input(v) for v in model.variables if v.causality == "input" and fits(model, v))
        outputs = [v for v in model.variables if v.causality == "output" and fits(model, v)]
        self.outputs = tuple(output_port(v) for v in (*outputs, *recorded(model, self.record)))
        self.feedthrough = self._feedthrough(feedthrough)
        self._names = (tuple(p.name for p in self.inputs), tuple(p.name for p in self.outputs))
        self._run: FmuRun = Closed(name)

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
                f"{self.name}: {self.model.path.name} allows one instance per process, and {other.name} is it; put "
                "one of them into a process of its own, Isolated(...)"
            )
        _alone[self.model.path] = self

    def _new_run(self) -> FmuRun:
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
        run, self._run = self._run, Closed(self.name)
        run.close()
        if _alone.get(self.model.path) is self:
            del _alone[self.model.path]
