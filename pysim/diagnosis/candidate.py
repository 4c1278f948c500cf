"""A model with effects and sensor errors: what is free in it, and how numbers go from one such model to another."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.session import Session
from pysim.identify.greybox import Nuisance, Parameter, Point, Problem, Simulation, WeightedResiduals
from pysim.identify.greybox.objective import NOISE
from pysim.identify.greybox.parameters import ParameterSpace, parameter_space
from pysim.identify.greybox.residuals import Carried
from pysim.types import BadInput, Effect, EffectParameter, Model
from pysim.types._frozen import FrozenMapping

Array = NDArray[np.float64]

# A parameter of the base model by its name; one of an effect by the effect's name and its own.
Key = str | tuple[str, str]
Values = Mapping[Key, float]

# What only a model with events can say.
_SWITCHES = re.compile(r"\b(when|pre|sample|reinit|edge|change)\b|[<>]")
_NO_EVENT = re.compile(r"noEvent\s*\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)")


@dataclass(frozen=True)
class Candidate:
    """Effects and sensor errors in a model.

    Args:
        effects: in the order in which they were added; none for the base model.
        nuisances: sensor errors that are free.
        problem: the model, its free numbers and the measurements beside it.
        places: effect name -> name ahead of its parameters in the model.
    """

    effects: tuple[Effect, ...]
    nuisances: tuple[Nuisance, ...]
    problem: Problem = field(repr=False)
    places: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "places", FrozenMapping(self.places))

    @property
    def names(self) -> tuple[str, ...]:
        """Of all that the base model lacks."""
        return (*(effect.name for effect in self.effects), *map(sensor_name, self.nuisances))

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

    def carried(self, other: Candidate, point: Point) -> Carried:
        """What a point of another model carries along, for this one: states by name, sensor errors by what they are."""
        mine, its = self.model.abilities.states, other.model.abilities.states
        states: list[Array | None] = []
        for run, old in zip(self.residuals(Simulation()).runs, point.carried.states, strict=True):
            if run.free.size:
                of_name = {} if old is None else dict(zip([its[i] for i in _free(other, run.record)], old, strict=True))
                states.append(np.array([of_name.get(mine[i], 0.0) for i in run.free.tolist()]))
            else:
                states.append(old if mine == its else None)
        sizes = dict(zip(other.nuisances, point.carried.nuisances.tolist(), strict=False))
        return Carried(tuple(states), np.array([sizes.get(one, 0.0) for one in self.nuisances]))


def _free(candidate: Candidate, record: str) -> list[int]:
    """Places of the states that are free at the start of a log."""
    runs = candidate.residuals(Simulation()).runs
    return next((run.free.tolist() for run in runs if run.record == record and run.free.size), [])


def sensor_name(nuisance: Nuisance) -> str:
    """As the answer calls a sensor's error."""
    return f"sensor.{nuisance.kind.value}"


class Models:
    """Makes candidates, each model built once.

    Effects without events are built into one model together; each of the others, and what cannot be built together or
    disturbs the others, into one of its own.

    Args:
        session: whose models these are.
    """

    def __init__(self, session: Session) -> None:
        self.session, self.builds = session, 0
        self._problems: dict[tuple[str, ...], tuple[Problem, Mapping[str, str]]] = {}
        self._smooth: tuple[Effect, ...] = tuple(e for e in session.catalogue if not (e.bypass or switches(e)))
        self.refused: dict[str, str] = {}

    def base(self) -> Candidate:
        """The model as it is."""
        return Candidate((), (), self._problem(())[0])

    def of(self, effects: Sequence[Effect], nuisances: Sequence[Nuisance] = ()) -> Candidate:
        """The model with these effects, in one that has more where there is one.

        Raises:
            BadInput: it cannot be made.
        """
        effects, together = tuple(effects), self._together(effects)
        problem, places = self._problem(together)
        own = [parameter(places[e.name], p) for e in effects for p in e.parameters]
        space = parameter_space(problem.model, [*self.session.parameters, *own])
        kept = {effect.name: places[effect.name] for effect in effects}
        return Candidate(effects, tuple(nuisances), replace(problem, space=space), kept)

    def alone(self, effects: Sequence[Effect], nuisances: Sequence[Nuisance] = ()) -> Candidate:
        """The model with these effects and no others.

        Raises:
            BadInput: it cannot be made.
        """
        problem, places = self._problem(tuple(effects))
        return Candidate(tuple(effects), tuple(nuisances), problem, places)

    def are_together(self, effects: Sequence[Effect]) -> bool:
        """Whether the effects are in a model with others."""
        return len(self._together(tuple(effects))) > len(effects)

    def _together(self, effects: tuple[Effect, ...]) -> tuple[Effect, ...]:
        """The effects that are built with these: all smooth ones where the last of these is smooth too."""
        if not effects or effects[-1] not in self._smooth:
            return effects
        others = tuple(e for e in effects if e not in self._smooth)
        whole = (*others, *self._smooth)
        try:
            self._problem(whole)
        except BadInput:
            self._smooth = ()
            return effects
        return whole

    def _problem(self, effects: tuple[Effect, ...]) -> tuple[Problem, Mapping[str, str]]:
        key = tuple(effect.name for effect in effects)
        if key in self._problems:
            return self._problems[key]
        model, places = self.session.model, {}
        if effects:
            if self.session.build is None:
                raise BadInput("no effect can be added: the model's Modelica class is not at hand; name its library")
            model, places = self.session.build(effects)
            self.builds += 1
        own = [parameter(places[e.name], p) for e in effects for p in e.parameters]
        self._problems[key] = found = self.session.problem(model, own), dict(places)
        return found


def parameter(place: str, p: EffectParameter) -> Parameter:
    """A free parameter of an effect; its strengths are searched on a linear scale, since they may be off."""
    return Parameter(f"{place}.{p.name}", p.default, p.min, p.max, log=None if p.off is None else False)


def switches(effect: Effect) -> bool:
    """Whether the effect's law has events."""
    return bool(_SWITCHES.search(_NO_EVENT.sub("", effect.law)))
