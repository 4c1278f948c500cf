"""Candidates: the base model with effects and sensor errors added, their free parameters and their compiled models.

Stepped sines are compared by the model's periodic orbit, or "transient": simulated over time as the bench ran them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.session import Session
from pysim.effects import makes_events
from pysim.identify.greybox import Nuisance, Parameter, Point, Problem, Simulation, WeightedResiduals
from pysim.identify.greybox.objective import NOISE
from pysim.identify.greybox.parameters import ParameterSpace, parameter_space
from pysim.identify.greybox.problem import beside
from pysim.identify.greybox.residuals import Carried
from pysim.types import BadInput, Effect, EffectParameter, Model, Note, NoteCode
from pysim.types._frozen import FrozenMapping

Array = NDArray[np.float64]

# Key of a free parameter: its name in the base model, or the names of the effect and of the effect's parameter.
Key = str | tuple[str, str]
Values = Mapping[Key, float]


@dataclass(frozen=True)
class Candidate:
    """The base model with some effects and sensor errors: one hypothesis about what is missing.

    Args:
        effects: in the order in which they were added; empty for the base model.
        nuisances: sensor errors (gain, offset, delay, drift) whose sizes are free.
        problem: the model, its free parameters and the measurements.
        places: effect name -> prefix of its parameters' names in the model.
        transient: whether stepped sines are simulated over time, since the model may have no periodic orbit.
        has_events: whether a law of its effects makes events; its Jacobian then comes from secants.
        precision: (n, n) precision matrix of a Gaussian prior of the search variables x; None without a prior.
        law: label of a learned law in the model; "" without one.
        watch: called with the candidate's FinalFit at every iteration of its refit.
    """

    effects: tuple[Effect, ...]
    nuisances: tuple[Nuisance, ...]
    problem: Problem = field(repr=False)
    places: Mapping[str, str] = field(default_factory=dict)
    transient: bool = False
    has_events: bool = False
    precision: Array | None = field(default=None, repr=False)
    law: str = ""
    watch: Callable[[Any], object] | None = field(default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "places", FrozenMapping(self.places))

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the effects and sensor errors that were added to the base model."""
        return (*(effect.name for effect in self.effects), *map(sensor_name, self.nuisances))

    @property
    def labels(self) -> tuple[str, ...]:
        """Unique names of them: sensor errors with their data set and signal."""
        return (*(e.name for e in self.effects), *(f"{sensor_name(n)} {n.dataset}.{n.signal}" for n in self.nuisances))

    @property
    def parts(self) -> dict[str, Effect | Nuisance]:
        """Label -> effect or sensor error."""
        return dict(zip(self.labels, (*self.effects, *self.nuisances), strict=True))

    @property
    def model(self) -> Model:
        """The compiled model; it may hold more effects than these, switched off."""
        return self.problem.model

    @property
    def space(self) -> ParameterSpace:
        """The free parameters and their scaling: those of the base model, then those of the effects."""
        return self.problem.space

    @property
    def size(self) -> int:
        """Number of free parameters, the sizes of sensor errors included."""
        return self.space.size + len(self.nuisances)

    @property
    def keys(self) -> tuple[Key, ...]:
        """Key of each free parameter, in the order of `space`."""
        own = {f"{self.places[e.name]}.{p.name}": (e.name, p.name) for e in self.effects for p in e.parameters}
        return tuple(own.get(key, key) for key in self.space.keys)

    def keeps_state(self, name: str) -> bool:
        """Whether the law of the effect `name` has a state of its own, as hysteresis has."""
        return any(state.startswith(f"{self.places[name]}.") for state in self.model.abilities.states)

    def residuals(self, simulation: Simulation, use: str = "fit") -> WeightedResiduals:
        """Residuals over their levels of the logs of one use, "fit" or "validate", with the sensor errors free."""
        return replace(self.problem.residuals(NOISE, simulation, use=use), nuisances=self.nuisances)

    def values(self, x: Array) -> dict[Key, float]:
        """Key -> value in the model's units of each free parameter at x (n,), the search variables."""
        return dict(zip(self.keys, self.space.to_model(x).tolist(), strict=True))

    def at(self, values: Values) -> Array:
        """Search variables x (n,) of these values, clipped to the bounds; other parameters get their start values."""
        start = zip(self.keys, self.space.start.tolist(), strict=True)
        p = np.array([values.get(key, own) for key, own in start])
        return self.space.to_search(np.clip(p, self.space.lower, self.space.upper))

    def held(self, values: Values) -> ParameterSpace:
        """Without free parameters: these values and those of `space.fixed`, all others as the model declares."""
        named = {key if isinstance(key, str) else f"{self.places[key[0]]}.{key[1]}": v for key, v in values.items()}
        return ParameterSpace.held({**self.space.fixed, **named})

    def levels(self, residuals: WeightedResiduals, point: Point) -> Array:
        """(n_r,) level (standard deviation of the residual) of each row's channel; 1 for priors and known levels."""
        level = dict(zip(residuals.channels, point.levels.tolist(), strict=True))
        sizes = [1.0 if name is None else level[one.dataset, name] for one, name in residuals.series]
        return np.array([1.0, *sizes])[point.series + 1]

    def slopes(self, simulation: Simulation, point: Point) -> dict[Key, Array]:
        """Key -> (n_r,) derivative of the measured rows' residual in the channels' units; empty without a Jacobian."""
        own = point.series >= 0
        size = self.levels(self.residuals(simulation), point)[own]
        return {key: point.jacobian[own, j] * size for j, key in enumerate(self.keys)} if point.jacobian.size else {}

    def carried(self, other: Candidate, point: Point) -> Carried:
        """Initial states and sensor errors at another candidate's point, matched by name to those of this one."""
        mine, its = self.model.abilities.states, other.model.abilities.states
        states: list[Array | None] = []
        runs = (one.residuals(Simulation()).runs for one in (self, other))
        for run, its_run, old in zip(*runs, point.carried.states, strict=True):
            if run.free.size:
                of_name = {} if old is None else dict(zip([its[i] for i in its_run.free.tolist()], old, strict=True))
                states.append(np.array([of_name.get(mine[i], 0.0) for i in run.free.tolist()]))
            else:
                states.append(old if mine == its else None)
        sizes = dict(zip(other.nuisances, point.carried.nuisances.tolist(), strict=False))
        return Carried(tuple(states), np.array([sizes.get(one, 0.0) for one in self.nuisances]))


def sensor_name(nuisance: Nuisance) -> str:
    """Name of a sensor error in the answer, such as "sensor.gain"."""
    return f"sensor.{nuisance.kind.value}"


class Refused(NamedTuple):
    """Why an effect could not be tried, and the labels of what the model had already, beside which it could not."""

    reason: str
    beside: tuple[str, ...] = ()

    def note(self, effect: str) -> Note:
        """The same of an effect, for people to read."""
        beside = {"beside": " + ".join(self.beside)} if self.beside else {}
        return Note(NoteCode.NOT_TRIED, {"effect": effect, "reason": self.reason} | beside)


class Models:
    """Makes candidates and compiles each model once.

    Effects without events are compiled together into one model, or into several models if that fails. An effect with
    events, or one that no value makes_events off (`bypass`), gets a model of its own. The search uses smooth forms.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        self._built: dict[tuple[str, ...], tuple[Model, Mapping[str, str]]] = {}
        self._problems: dict[tuple[tuple[str, ...], bool], Problem] = {}
        smooth = tuple(e for e in map(searched, session.catalogue) if not (e.bypass or makes_events(e)))
        self._together = [smooth] if smooth else []
        self.refused: dict[str, Refused] = {}
        self.watch: Callable[[Any], object] | None = None

    def of(
        self, effects: Sequence[Effect], nuisances: Sequence[Nuisance] = (), *, transient: bool = False
    ) -> Candidate:
        """The candidate with these effects, in a compiled model that may hold more of them, switched off.

        Args:
            transient: whether to simulate stepped sines over time; with events that is always done.
        Raises:
            BadInput: the model cannot be compiled.
        """
        laws = tuple(map(searched, effects))
        made = self._made(effects, nuisances, laws, self._with_others(laws), transient)
        return replace(made, watch=self.watch)

    def of_parts(self, parts: Sequence[Effect | Nuisance], *, transient: bool = False) -> Candidate:
        """Like `of`, for effects and sensor errors in one list."""
        effects = [part for part in parts if isinstance(part, Effect)]
        return self.of(effects, [part for part in parts if isinstance(part, Nuisance)], transient=transient)

    def amounts(self, effects: Sequence[Effect], nuisances: Sequence[Nuisance] = ()) -> Iterator[Candidate]:
        """Candidates with these effects and further amounts: effects without events whose strength is not a limit.
        Those compiled together share a candidate, but an effect whose law has a state gets a candidate of its own."""
        groups: dict[tuple[int, str], list[Effect]] = {}
        for effect in self.session.catalogue:
            if effect.limit or effect in effects:
                continue
            try:
                alone = self.of((*effects, effect), nuisances)
            except BadInput:
                continue
            if not alone.has_events:
                own = effect.name if alone.keeps_state(effect.name) else ""
                groups.setdefault((id(alone.model), own), []).append(effect)
        for more in groups.values():
            yield self.of((*effects, *more), nuisances)

    def alone(
        self, effects: Sequence[Effect], nuisances: Sequence[Nuisance] = (), *, transient: bool = False
    ) -> Candidate:
        """The candidate whose model holds these effects in their true form, not the smooth one, and no others.

        Raises:
            BadInput: the model cannot be compiled.
        """
        return self._made(effects, nuisances, tuple(effects), tuple(effects), transient)

    def _made(
        self,
        effects: Sequence[Effect],
        nuisances: Sequence[Nuisance],
        laws: tuple[Effect, ...],
        built: tuple[Effect, ...],
        transient: bool,
    ) -> Candidate:
        """The candidate whose effects have these laws, in a model that is compiled with others too."""
        has_events = any(map(makes_events, laws))
        transient |= has_events or self.all_transient
        model, places = self._variant(built)
        problem = self._problem(built, transient)
        own = [parameter(places[e.name], p) for e in effects for p in e.parameters]
        space = parameter_space(model, [*self.session.parameters, *own])
        kept = {effect.name: places[effect.name] for effect in effects}
        return Candidate(tuple(effects), tuple(nuisances), replace(problem, space=space), kept, transient, has_events)

    @cached_property
    def all_transient(self) -> bool:
        """Whether every candidate simulates its stepped sines over time, since in some log the plant had not settled.
        The search sets it too, where the model's own transient has not died away when a log ends."""
        counts = [sum(one.domain == "time" for one in self._problem((), t).observations) for t in (False, True)]
        return counts[0] != counts[1]

    def _with_others(self, effects: tuple[Effect, ...]) -> tuple[Effect, ...]:
        """The effects to compile with these: the whole group that is compiled together with the last one, if any."""
        group = next((g for g in self._together if effects and effects[-1] in g), None)
        if group is None:
            return effects
        whole = (*(e for e in effects if e not in group), *group)
        try:
            self._variant(whole)
        except BadInput:
            self._together = [g for g in self._together if g is not group] + list(_split(group))
            return self._with_others(effects)
        return whole

    def _variant(self, effects: tuple[Effect, ...]) -> tuple[Model, Mapping[str, str]]:
        if not effects:
            return self.session.model, {}
        key = tuple(effect.class_name for effect in effects)
        if key not in self._built:
            if self.session.build is None:
                raise BadInput("no effect can be added: the model's Modelica class is not at hand; name its library")
            self._built[key] = self.session.build(effects)
        return self._built[key]

    def _problem(self, effects: tuple[Effect, ...], transient: bool) -> Problem:
        key = tuple(effect.class_name for effect in effects), transient
        if key not in self._problems:
            model, places = self._variant(effects)
            own = [parameter(places[e.name], p) for e in effects for p in e.parameters]
            self._problems[key] = beside(self.session.problems[transient], model, [*self.session.parameters, *own])
        return self._problems[key]


def _split(group: tuple[Effect, ...]) -> Iterator[tuple[Effect, ...]]:
    """Smaller groups of one that does not compile, one effect of each slot in each; none if it was such a group."""
    slots: dict[str, list[Effect]] = {}
    for effect in group:
        slots.setdefault(effect.slot, []).append(effect)
    longest = max(map(len, slots.values()))
    if longest == 1:
        return
    for k in range(longest):
        yield tuple(own[k] for own in slots.values() if k < len(own))


def parameter(place: str, p: EffectParameter) -> Parameter:
    """An effect's parameter as a free one; strengths are searched on a linear scale, since they may be 0 (off)."""
    return Parameter(f"{place}.{p.name}", p.default, p.min, p.max, log=None if p.off is None else False)


def searched(effect: Effect) -> Effect:
    """The form in which an effect is searched: its smooth one if it has one."""
    return effect.smooth or effect
