"""Derivatives: a function of time, states and inputs alone, and their directional derivatives those of differences."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pysim.fmu_check.instance import opened
from pysim.fmu_check.points import Points
from pysim.fmu_check.result import DOUBTFUL, CheckResult, none_of, skipped
from pysim.fmu_check.subject import MODEL_EXCHANGE, Subject, references
from pysim.io import read_model

Array = NDArray[np.float64]
NAME = "derivatives"
_SHARES = (1e-2, 0.2)  # how far off the start values points are
_STEPS = (1e-5, 1e-6)  # of a known's size; the differences have to agree with each other before they judge
_LIMIT, _SURE = 1e-4, 1e-3  # relative: what a slope may be off, and what differences may differ by among themselves
_ROUNDING = 1e-8  # of an unknown over the size of a known: hundred times what the smaller step makes of the last bit


def check_derivatives(subject: Subject) -> Iterator[CheckResult]:
    """Only model exchange shows them."""
    claim = "derivatives depend on nothing but time, states, inputs and parameters"
    if MODEL_EXCHANGE not in subject.kinds:
        yield skipped(NAME, claim, "the FMU has no model exchange")
        return
    with opened(subject, MODEL_EXCHANGE) as instance:
        points = Points(subject, instance.start())
        yield none_of(NAME, claim, _remembering(points))
        names = [state.name for state in subject.states]
        yield none_of(NAME, "der(x) as a variable is what the call for derivatives gives", _unlike(points, names))
        yield from _directional(subject, points)


def _remembering(points: Points) -> list[str]:
    """Unknowns whose value at a point changes when another point has been visited."""
    names = [*(v.name for v in points.unknowns[: points.instance.x.size]), *(v.name for v in points.unknowns)]
    changed = np.zeros(len(names), dtype=bool)
    first, *others = points.around(4, _SHARES[0])
    before = _both(points, first)
    for other in others:
        _both(points, other)
        after = _both(points, first)
        changed |= (after != before) & ~(np.isnan(after) & np.isnan(before))
    points.put(points.home)
    return list(dict.fromkeys(name for name, moved in zip(names, changed, strict=True) if moved))


def _both(points: Points, at: Array) -> Array:
    """Derivatives by their own call, then every unknown as a variable."""
    points.put(at)
    called = points.instance.dx
    return np.concatenate([called, points.values(at)])


def _unlike(points: Points, names: list[str]) -> list[str]:
    values, called = points.values(points.home)[: len(names)], points.instance.dx
    return [f"der({name})" for name, a, b in zip(names, values, called, strict=True) if a != b]


def _directional(subject: Subject, points: Points) -> Iterator[CheckResult]:
    claim = "directional derivatives agree with differences"
    if not read_model(subject.path, faulty=True).abilities.directional_derivatives:
        yield skipped(NAME, claim, "the FMU provides none")
        return
    if not points.knowns or not points.unknowns:
        yield skipped(NAME, claim, "no states and inputs, or no derivatives and outputs")
        return
    wrong: dict[str, float] = {}
    unsure = tried = 0
    for at in (points.home, *(points.around(1, share)[0] for share in _SHARES)):
        off, sure = _judged(points, at)
        unsure, tried = unsure + int((~sure).sum()), tried + sure.size
        for i, k in zip(*np.nonzero(sure & ~(off <= _LIMIT)), strict=True):
            wrong[f"d {points.unknowns[i].name} / d {points.knowns[k].name}"] = float(off[i, k])
    named = [f"{name} off by {100 * value:.2g} %" for name, value in sorted(wrong.items(), key=lambda item: -item[1])]
    yield none_of(NAME, claim, named, note=f"{tried} slopes tried")
    if unsure > tried / 2:
        detail = f"{unsure} of {tried} do not: steps, kinks or events are near"
        yield CheckResult(NAME, "differences settle", DOUBTFUL, detail)


def _judged(points: Points, at: Array) -> tuple[Array, NDArray[np.bool_]]:
    """By how much each slope (n_unknowns, n_knowns) is off, relatively, and whether differences can tell.

    They cannot beside a kink, where they differ from one side to the other, and where rounding is larger than they are.
    """
    rows, count = references(points.unknowns), range(len(points.knowns))
    value = points.values(at)
    sides = np.array([[points.side(at, value, k, sign * step) for step in _STEPS for sign in (1, -1)] for k in count])
    forward, backward = sides[:, 2].T, sides[:, 3].T  # by the smaller step
    coarse, fine = (sides[:, 0] + sides[:, 1]).T / 2, (forward + backward) / 2
    points.put(at)
    exact = np.array([points.instance.directional(rows, points.rows([k]), [1.0]) for k in count]).T
    size = np.maximum(np.abs(exact), np.abs(fine))
    rounding = _ROUNDING * np.abs(value)[:, None] / points.sizes
    doubt = np.maximum(np.abs(coarse - fine), np.abs(forward - backward))
    off = np.maximum(np.abs(exact - fine) - rounding, 0.0)
    return off / np.maximum(size, np.finfo(float).tiny), doubt <= _SURE * size + rounding
