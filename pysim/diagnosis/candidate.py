"""A model with effects and sensor errors: what is free in it, and how numbers go from one such model to another."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.session import Session
from pysim.identify.greybox import Nuisance, Parameter, Point, Problem, Simulation, WeightedResiduals
from pysim.identify.greybox.objective import NOISE
from pysim.identify.greybox.parameters import ParameterSpace, parameter_space
from pysim.identify.greybox.problem import beside
from pysim.identify.greybox.residuals import Carried
from pysim.types import BadInput, Effect, EffectParameter, Model
from pysim.types._frozen import FrozenMapping

Array = NDArray[np.float64]

# A parameter of the base model by its name; one of an effect by the effect's name and its own.
Key = str | tuple[str, str]
Values = Mapping[Key, float]

# What only a model with events can say, what keeps relations from being events, and what is for readers alone.
_SWITCHES = re.compile(r"\b(when|pre|sample|reinit|edge|change|div|mod|rem|ceil|floor|integer)\b|[<>]")
_NO_EVENT = re.compile(r"\b(noEvent|smooth)\s*\(")
_WORDS = re.compile(r'"(?:[^"\\]|\\.)*"|//[^\n]*|/\*.*?\*/', re.DOTALL)


@dataclass(frozen=True)
class Candidate:
    """Effects and sensor errors in a model.

    Args:
        effects: in the order in which they were added; none for the base model.
        nuisances: sensor errors that are free.
        problem: the model, its free numbers and the measurements beside it.
        places: effect name -> name ahead of its parameters in the model.
        transient: whether stepped sines run as the bench ran them, since the model may have no periodic orbit.
        has_events: whether a law in the model has: its slopes are then those of secants.
        precision: (n, n) of a prior of the free parameters, in the search's numbers; none where None.
        law: label of a learned law that is in it too; "" without one.
        watch: gets its FinalFit at every point of its search.
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
        """Of all that the base model lacks."""
        return (*(effect.name for effect in self.effects), *map(sensor_name, self.nuisances))

    @property
    def labels(self) -> tuple[str, ...]:
        """The same, each of them named apart from all others: sensor errors with their signal."""
        return (*(e.name for e in self.effects), *(f"{sensor_name(n)} {n.dataset}.{n.signal}" for n in self.nuisances))

    @property
    def parts(self) -> dict[str, Effect | Nuisance]:
        """Effects and sensor errors by their labels."""
        return dict(zip(self.labels, (*self.effects, *self.nuisances), strict=True))

    @property
    def model(self) -> Model:
        """With the effects in it."""
        return self.problem.model

    @property
    def space(self) -> ParameterSpace:
        """Of the search: the base model's parameters, then the effects' own."""
        return self.problem.space

    @property
    def size(self) -> int:
        """How many numbers are free, those of the sensors too."""
        return self.space.size + len(self.nuisances)

    @property
    def keys(self) -> tuple[Key, ...]:
        """Of the free parameters, in the order of the space."""
        own = {f"{self.places[e.name]}.{p.name}": (e.name, p.name) for e in self.effects for p in e.parameters}
        return tuple(own.get(key, key) for key in self.space.keys)

    def keeps_state(self, name: str) -> bool:
        """Whether an effect's law has a state of its own."""
        return any(state.startswith(f"{self.places[name]}.") for state in self.model.abilities.states)

    def residuals(self, simulation: Simulation, use: str = "fit") -> WeightedResiduals:
        """What is counted of the records of one use."""
        return replace(self.problem.residuals(NOISE, simulation, use=use), nuisances=self.nuisances)

    def values(self, x: Array) -> dict[Key, float]:
        """The free parameters at x (n,)."""
        return dict(zip(self.keys, self.space.to_model(x).tolist(), strict=True))

    def at(self, values: Values) -> Array:
        """x (n,) with these values, within the bounds; parameters that are not named as they start."""
        start = zip(self.keys, self.space.start.tolist(), strict=True)
        p = np.array([values.get(key, own) for key, own in start])
        return self.space.to_search(np.clip(p, self.space.lower, self.space.upper))

    def held(self, values: Values) -> ParameterSpace:
        """Nothing free: every parameter of the model at these values, effects that are not named as declared."""
        named = {key if isinstance(key, str) else f"{self.places[key[0]]}.{key[1]}": v for key, v in values.items()}
        return ParameterSpace.held(named)

    def levels(self, residuals: WeightedResiduals, point: Point) -> Array:
        """(n_r,) level of each row of a good point; 1 of priors and of what has a known one."""
        level = dict(zip(residuals.channels, point.levels.tolist(), strict=True))
        sizes = [1.0 if name is None else level[one.dataset, name] for one, name in residuals.series]
        return np.array([1.0, *sizes])[point.series + 1]

    def slopes(self, simulation: Simulation, point: Point) -> dict[Key, Array]:
        """(n_r,) of the measurements' rows by each free parameter, in the units of the channels."""
        own = point.series >= 0
        size = self.levels(self.residuals(simulation), point)[own]
        return {key: point.jacobian[own, j] * size for j, key in enumerate(self.keys)} if point.jacobian.size else {}

    def carried(self, other: Candidate, point: Point) -> Carried:
        """What a point of another model carries along, for this one: states by name, sensor errors by what they are."""
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
    """As the answer calls a sensor's error."""
    return f"sensor.{nuisance.kind.value}"


class Models:
    """Makes candidates, each model built once.

    Effects without events are built into one model together; each of the others, and what cannot be built together or
    disturbs the others, into one of its own. An effect that has a smooth form is searched for in that form.

    Args:
        session: whose models these are.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        self._built: dict[tuple[str, ...], tuple[Model, Mapping[str, str]]] = {}
        self._problems: dict[tuple[tuple[str, ...], bool], Problem] = {}
        smooth = tuple(e for e in map(searched, session.catalogue) if not (e.bypass or switches(e)))
        self._together = [smooth] if smooth else []
        self.refused: dict[str, str] = {}
        self.watch: Callable[[Any], object] | None = None

    def of(
        self, effects: Sequence[Effect], nuisances: Sequence[Nuisance] = (), *, transient: bool = False
    ) -> Candidate:
        """The model with these effects, in one that has more where there is one.

        Args:
            transient: as models with events are compared in any case.
        Raises:
            BadInput: it cannot be made.
        """
        effects = tuple(effects)
        laws = tuple(map(searched, effects))
        built, has_events = self._with_others(laws), any(map(switches, laws))
        transient |= has_events or self.all_transient
        model, places = self._variant(built)
        problem = self._problem(built, transient)
        own = [parameter(places[e.name], p) for e in effects for p in e.parameters]
        space = parameter_space(model, [*self.session.parameters, *own])
        kept = {effect.name: places[effect.name] for effect in effects}
        problem = replace(problem, space=space)
        return Candidate(effects, tuple(nuisances), problem, kept, transient, has_events, watch=self.watch)

    def of_parts(self, parts: Sequence[Effect | Nuisance], *, transient: bool = False) -> Candidate:
        """As `of`, of effects and sensor errors in one list."""
        effects = [part for part in parts if isinstance(part, Effect)]
        return self.of(effects, [part for part in parts if isinstance(part, Nuisance)], transient=transient)

    def amounts(self, effects: Sequence[Effect], nuisances: Sequence[Nuisance] = ()) -> Iterator[Candidate]:
        """The model with these effects and amounts of others: in one all that are built together and keep no state,
        each of the others alone; none that are limits, or would be beside events."""
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
        """The model with these effects themselves and no others.

        Raises:
            BadInput: it cannot be made.
        """
        effects = tuple(effects)
        has_events = any(map(switches, effects))
        transient |= has_events or self.all_transient
        _, places = self._variant(effects)
        return Candidate(effects, tuple(nuisances), self._problem(effects, transient), places, transient, has_events)

    @cached_property
    def all_transient(self) -> bool:
        """Whether some stepped sine is compared sample by sample, since the plant had not settled; or a search says so
        of all, where the model had not."""
        counts = [sum(one.domain == "time" for one in self._problem((), t).observations) for t in (False, True)]
        return counts[0] != counts[1]

    def _with_others(self, effects: tuple[Effect, ...]) -> tuple[Effect, ...]:
        """The effects that are built with these: a group of smooth ones where the last of these is smooth too."""
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
    """Groups of a group that cannot be built: one effect of each slot in each; each alone where that was so already."""
    slots: dict[str, list[Effect]] = {}
    for effect in group:
        slots.setdefault(effect.slot, []).append(effect)
    longest = max(map(len, slots.values()))
    if longest == 1:
        return
    for k in range(longest):
        yield tuple(own[k] for own in slots.values() if k < len(own))


def parameter(place: str, p: EffectParameter) -> Parameter:
    """A free parameter of an effect; its strengths are searched on a linear scale, since they may be off."""
    return Parameter(f"{place}.{p.name}", p.default, p.min, p.max, log=None if p.off is None else False)


def searched(effect: Effect) -> Effect:
    """The form in which an effect is searched for."""
    return effect.smooth or effect


def switches(effect: Effect) -> bool:
    """Whether the effect's law has events."""
    law = _WORDS.sub("", effect.law)
    while found := _NO_EVENT.search(law):
        depth, end = 1, found.end()
        while depth and end < len(law):
            depth += {"(": 1, ")": -1}.get(law[end], 0)
            end += 1
        law = law[: found.start()] + law[end:]
    return bool(_SWITCHES.search(law))
