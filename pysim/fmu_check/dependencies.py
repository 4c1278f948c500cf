"""What the description says an unknown depends on, against what moves it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pysim.fmu_check.instance import opened
from pysim.fmu_check.points import Points
from pysim.fmu_check.result import DOUBTFUL, CheckResult, none_of, skipped
from pysim.fmu_check.subject import MODEL_EXCHANGE, Subject

NAME = "dependencies"
_SHARES = (1e-3, 0.05, 0.5)  # of a known's size: how far points are off the start, and how far a known is then moved
_CONSTANT = ("constant", "fixed")
_SAME_SLOPE = 1e-5  # relative: central differences of a term that is linear


def check_dependencies(subject: Subject) -> Iterator[CheckResult]:
    """Every derivative and output, moved by every state and input at points near and far."""
    claim = "nothing moves an unknown but what its dependencies name"
    listed = {u.variable.name: u for u in (*subject.description.derivatives, *subject.description.outputs)}
    told = {name: u for name, u in listed.items() if u.dependencies is not None}
    if MODEL_EXCHANGE not in subject.kinds or not told:
        yield skipped(NAME, claim, "the FMU has no model exchange, or declares no dependencies")
        return
    with opened(subject, MODEL_EXCHANGE) as instance:
        points = Points(subject, instance.start())
        moves = _measured(points)
        undeclared, idle = [], []
        for i, unknown in enumerate(points.unknowns):
            if unknown.name not in told:
                continue
            names = {v.name for v in told[unknown.name].dependencies}
            for k, known in enumerate(points.knowns):
                if moves[i, k] and known.name not in names:
                    undeclared.append(f"{unknown.name} moves with {known.name}")
                if not moves[i, k] and known.name in names:
                    idle.append(f"{unknown.name} on {known.name}")
        yield none_of(NAME, claim, undeclared, note=f"{moves.size} pairs tried")
        yield none_of(NAME, "every declared dependency is there at some point tried", idle, otherwise=DOUBTFUL)
        yield none_of(NAME, "dependencies declared constant or fixed are linear", _bent(points, told))


def _measured(points: Points) -> np.ndarray:
    """Whether known k moves unknown i at some point, (n_unknowns, n_knowns)."""
    moves = np.zeros((len(points.unknowns), len(points.knowns)), dtype=bool)
    for share in _SHARES:
        for at in (points.home, *points.around(2, share)):
            before = points.values(at)
            for k in range(len(points.knowns)):
                other = at.copy()
                other[k] += share * points.sizes[k]
                after = points.values(other)
                moves[:, k] |= (after != before) & ~(np.isnan(after) & np.isnan(before))
    return moves


def _bent(points: Points, told: dict) -> list[str]:
    """Pairs whose slope changes from point to point though their kind promises that it does not."""
    places = {known.name: k for k, known in enumerate(points.knowns)}
    promised = [
        (i, places[known.name])
        for i, unknown in enumerate(points.unknowns)
        if unknown.name in told and told[unknown.name].dependenciesKind is not None
        for known, kind in zip(told[unknown.name].dependencies, told[unknown.name].dependenciesKind, strict=False)
        if kind in _CONSTANT and known.name in places
    ]
    found = []
    first, second = points.home, points.around(1, _SHARES[1])[0]
    for k in sorted({k for _, k in promised}):
        a, b = points.slope(first, k, 1e-3), points.slope(second, k, 1e-3)
        rounding = 1e-9 * np.abs(points.values(second)) / (1e-3 * points.sizes[k])
        for i in (i for i, j in promised if j == k):
            if abs(a[i] - b[i]) > _SAME_SLOPE * max(abs(a[i]), abs(b[i])) + rounding[i]:
                found.append(f"{points.unknowns[i].name} with {points.knowns[k].name}")
    return found
