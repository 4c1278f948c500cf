"""A model: an FMU file and what it says of itself."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from pysim.types.dataset import MeasuredSignal
from pysim.types.errors import BadInput


@dataclass(frozen=True)
class Variable:
    """One variable of a model, from its variable table. Numbers are in `unit`, which is an SI unit or "1" or "%"."""

    name: str
    reference: int
    type: str  # "Real" | "Integer" | "Boolean" | ...; an array of FMI 3 has its size behind it, "Float64[3]"
    causality: str  # as in FMI: "parameter" | "calculatedParameter" | "input" | "output" | "local" | "independent"
    variability: str  # as in FMI
    start: float | None
    unit: str
    display_unit: str | None
    description: str
    min: float | None
    max: float | None
    nominal: float | None
    derivative_of: str | None


@dataclass(frozen=True)
class CoSimulation:
    """What the FMU says of its own way to step."""

    library: str  # modelIdentifier of the shared library
    variable_step: bool = False  # communication steps may differ in size
    state_handling: bool = False
    event_mode: bool = False  # FMI 3: its events can be handled by the importer
    early_return: bool = False  # FMI 3: a step may end before its end
    single_instance: bool = False  # at most one instance per process


@dataclass(frozen=True)
class Abilities:
    """What the FMU says it can do."""

    fmi: int  # 2 | 3
    model_exchange: bool
    co_simulation: bool
    directional_derivatives: bool
    state_handling: bool
    event_indicators: int
    states: tuple[str, ...]  # names, in the order of the state vector
    derivatives: tuple[str, ...]  # names, same order
    library: str = ""  # modelIdentifier of the shared library
    needs_completed_step: bool = True  # wants to be told of every accepted step
    single_instance: bool = False  # at most one instance per process
    dependencies: tuple[frozenset[str] | None, ...] = ()  # per derivative, names of what it depends on; None: unknown
    feedthrough: tuple[tuple[str, frozenset[str] | None], ...] = ()  # output and inputs it depends on; None: unknown
    stepping: CoSimulation | None = None  # None: model exchange only


@dataclass(frozen=True)
class Model:
    """An FMU on disk. Holds no instance and no library; `pysim.simulate` opens those for as long as a run lasts."""

    path: Path
    name: str
    token: str  # guid or instantiationToken: changes with the model's content
    variables: tuple[Variable, ...] = field(repr=False)
    abilities: Abilities = field(repr=False)
    stop_time: float | None = None  # s, of the FMU's own default experiment

    @cached_property
    def _by_name(self) -> dict[str, Variable]:
        return {variable.name: variable for variable in self.variables}

    def __getitem__(self, name: str) -> Variable:
        """The variable of that name."""
        variable = self._by_name.get(name)
        if variable is not None:
            return variable
        near = difflib.get_close_matches(name, list(self._by_name), n=3)
        hint = f"; near it: {', '.join(near)}" if near else ""
        raise BadInput(f"{self.path.name} has no variable {name!r}{hint}")

    def rate_input(self, command: str) -> str | None:
        """The input that wants the command's derivative, by the naming of thesis Appendix F (u, u_t, u_tt)."""
        variable = self._by_name.get(f"{command}_t")
        return variable.name if variable is not None and variable.causality == "input" else None

    def rate_inputs(self, commands: Iterable[str]) -> dict[str, str]:
        """Inputs that take the exact rate of a driven one; input -> command. None where it is driven itself."""
        driven = tuple(commands)
        pairs = ((self.rate_input(name), name) for name in driven)
        return {rate: name for rate, name in pairs if rate is not None and rate not in driven}

    def measured(self, signal: MeasuredSignal, source: str) -> Variable:
        """The variable that a signal shows.

        Args:
            source: where the signal is written, for an error: "data set 'x'" or "the plan".
        Raises:
            BadInput: no such variable, a command that is no input of the model, or units that differ.
        """
        variable = self[signal.variable]
        if signal.role == "input" and variable.causality != "input":
            raise BadInput(
                f"{self.path.name}: {variable.name} is no input but of causality {variable.causality}; name the command"
            )
        if variable.unit != signal.unit:
            raise BadInput(
                f"signal {signal.name!r} of {source} is in {signal.unit!r}, {variable.name} of {self.path.name} in "
                f"{variable.unit!r}; give both the same unit"
            )
        return variable
