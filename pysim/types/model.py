"""A model: an FMU file and what it says of itself."""

from __future__ import annotations

import difflib
import json
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from pysim.types.dataset import MeasuredSignal
from pysim.types.errors import BadInput
from pysim.types.units import UNITS, conversion

_DIGEST = re.compile(r"[0-9a-f]{32,}(-[0-9a-f]{32,})?")  # names a file in a cache
_LISTED = 20  # names in a message
_STILL_CAUSALITIES = ("parameter", "calculatedParameter", "structuralParameter", "independent")
_STILL_VARIABILITIES = ("constant", "fixed", "tunable")


@dataclass(frozen=True)
class Variable:
    """One variable of a model, from its variable table. Numbers are in `unit`, "1" where the model declares none."""

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

    @property
    def moves(self) -> bool:
        """Whether a sensor may show it: an output, or an input, state or algebraic variable that is not constant."""
        still = self.causality in _STILL_CAUSALITIES or self.variability in _STILL_VARIABILITIES
        return self.causality == "output" or not still


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
    # Per output, names of the states and inputs it depends on; and per variable of the initial problem, names of the
    # parameters and start values behind it. None: unknown.
    output_dependencies: tuple[tuple[str, frozenset[str] | None], ...] = ()
    initial_dependencies: tuple[tuple[str, frozenset[str] | None], ...] = ()
    feedthrough: tuple[tuple[str, frozenset[str] | None], ...] = ()  # output and inputs it depends on; None: unknown
    stepping: CoSimulation | None = None  # None: model exchange only
    # Names of variables that depend on a Real which an event set and which is held until the next, and of those that
    # depend on delayed values. None: unknown.
    held: frozenset[str] | None = None
    delayed: frozenset[str] | None = None


@dataclass(frozen=True)
class Model:
    """An FMU on disk. Holds no instance and no library; `pysim.simulate` opens those for as long as a run lasts."""

    path: Path
    name: str
    token: str  # guid or instantiationToken: changes with the model's content
    variables: tuple[Variable, ...] = field(repr=False)
    abilities: Abilities = field(repr=False)
    stop_time: float | None = None  # s, of the FMU's own default experiment
    declares_units: bool = field(default=True, repr=False)  # of any variable
    stamp: tuple[int, int] = field(default=(0, 0), repr=False, compare=False)  # of the file: modified, ns, and size

    @cached_property
    def _by_name(self) -> dict[str, Variable]:
        return {variable.name: variable for variable in self.variables}

    def __getitem__(self, name: str) -> Variable:
        """The variable of that name."""
        variable = self._by_name.get(name)
        if variable is not None:
            return variable
        near = _near(name, self._by_name)
        hint = f"near it: {', '.join(near)}" if near else f"pysim model {self.label} lists them"
        raise BadInput(f"{self.label} has no variable {name!r}; {hint}")

    @property
    def label(self) -> str:
        """What to call it in a message: its file, or the model itself where a cache has named the file."""
        return self.name if _DIGEST.fullmatch(self.path.stem) else self.path.name

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
            BadInput: no such variable, one that cannot move, a command that is no input of the model, or units that
                differ.
        """
        said, below = f"signal {signal.name!r} of {source}", f"below [signals.{_key(signal.name)}]"
        variable = self._by_name.get(signal.variable)
        if variable is None:
            raise BadInput(f"{said}: {self.label} has no variable {signal.variable!r}; {self._instead(signal, below)}")
        if signal.role == "input" and variable.causality != "input":
            raise BadInput(
                f"{said}: {variable.name} is no input but of causality {variable.causality} in {self.label}; "
                f"{self._instead(signal, below)}"
            )
        if not variable.moves:
            kind, there = "parameter" if "arameter" in variable.causality else "constant", self._instead(signal, below)
            raise BadInput(f"{said}: {variable.name} is a {kind} of {self.label}, so no log shows it; {there}")
        if self.scale(variable, signal.unit) != (1.0, 0.0):
            own = "without a unit" if variable.unit == "1" else f"in {variable.unit!r}"
            cure = _unit_cure(variable.unit, signal.unit, below)
            raise BadInput(f"{said} is in {signal.unit!r}, {variable.name} of {self.label} {own}; {cure}")
        return variable

    def _instead(self, signal: MeasuredSignal, below: str) -> str:
        """What a signal may show in place of a variable that is not there or does not move, and how to say it."""
        one_of = [v.name for v in self.variables if v.moves and (v.causality == "input") == (signal.role == "input")]
        names = [v.name for v in self.variables if v.causality == signal.role]
        near = _near(signal.variable, one_of)
        more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
        there = f"its {signal.role}s: {', '.join(names[:_LISTED]) or '(none)'}{more}"
        likely = (near or (names if len(names) == 1 else ["..."]))[0]
        hint = f"near it: {', '.join(near)}" if near else there
        return (
            f'{hint}; write variables={{"{signal.name}": "{likely}"}} in pysim.load, or variable = "{likely}" {below}'
        )

    def scale(self, variable: Variable, unit: str) -> tuple[float, float] | None:
        """Factor and offset that make a number in the unit of data that of a variable; None: of different quantities.

        A model that declares no units at all counts in those of the data. Where it counts in a unit that is not known,
        data in "1" are its own numbers.
        """
        if not self.declares_units or (variable.unit not in UNITS and unit == "1"):
            return 1.0, 0.0
        return conversion(unit, variable.unit)


def _near(name: str, names: Iterable[str]) -> list[str]:
    return difflib.get_close_matches(name, list(names), n=3)


def _unit_cure(model: str, data: str, below: str) -> str:
    """What to do where the model counts in another unit than the data."""
    if conversion(data, model) is not None:
        return "pysim.io.in_model_units turns the data of a data set into the units of a model"
    if model in UNITS and model != "1":
        return (
            f'write unit = "{model}" {below}, with factor and offset that turn the column into it, or another variable'
        )
    why = "" if model == "1" else "which is no unit that is known: "
    return f'{why}write unit = "1" {below}, with factor and offset that make the column the number of the model'


def _key(name: str) -> str:
    """A name as it stands in the header of a TOML section."""
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)
