"""How the states at the start of runs depend on parameters."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._foreign import Opened
from pysim.simulate._found import Found
from pysim.simulate._request import Request
from pysim.simulate._variation import Directions
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.sensitivity.probe import START_STEP, Offer, at_rest, both_sides, points, value_of
from pysim.types import Experiment

Array = NDArray[np.float64]


def start_slopes(
    library: Opened,
    experiments: Sequence[Experiment],
    solver: Esdirk,
    offers: dict[tuple[str, ...], Offer],
    count: int,
) -> list[Array | None]:
    """Per experiment d x / d p (n_x, n_p) at the start, by differences of initialisations; zero where nothing moves.

    None where the FMU offers no derivatives, or cannot be initialised beside the experiment's own values. Experiments
    that begin alike share it.
    """
    first: dict[_Start, int] = {}
    own = [first.setdefault(_start_of(e), i) for i, e in enumerate(experiments)]
    leading = [i for i in first.values() if offers[experiments[i].record].outputs]
    requests: list[Request] = []
    distances: list[float] = []
    for i in leading:
        once = at_rest(experiments[i])
        offer = offers[once.record]
        fixed = (name for name in offer.parameters if name not in offer.starts)
        once = once.override(**{name: value_of(library.model, once, name) for name in fixed})
        for name in offers[once.record].parameters:
            up, down, distance = both_sides(library.model, once, name, START_STEP)
            requests += [Request(up), Request(down)]
            distances.append(distance)
    ends = points(library, solver, Directions(outputs=False), requests, workers=count)
    by: dict[int, Array | None] = {}
    for i in leading:
        columns = len(offers[experiments[i].record].parameters)
        pairs, ends = ends[: 2 * columns], ends[2 * columns :]
        steps, distances = distances[:columns], distances[columns:]
        by[i] = _start_by(pairs, steps, len(library.model.abilities.states))
    return [by.get(i) for i in own]


def _start_by(ends: Sequence[Found], distances: Sequence[float], n: int) -> Array | None:
    if not all(end.done for end in ends):
        return None
    result = np.zeros((n, len(distances)))
    for p, distance in enumerate(distances):
        result[:, p] = (ends[2 * p].array("state") - ends[2 * p + 1].array("state")) / distance
    return result


# What is recorded, what is set, and how the inputs begin.
_Start = tuple[tuple[str, ...], tuple[tuple[str, float], ...], float, tuple[tuple[str, float, float], ...]]


def _start_of(experiment: Experiment) -> _Start:
    t = np.array(experiment.start)
    begun = [(name, float(s.value(t)), float(s.derivative(t))) for name, s in sorted(experiment.inputs.items())]
    return experiment.record, tuple(sorted(experiment.overrides.items())), experiment.start, tuple(begun)
