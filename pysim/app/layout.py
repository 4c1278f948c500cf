"""Where the boxes of a signal-flow drawing stand, and the lines between them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Any

from pysim.app.routing import CELL, Grid

WIDE, HIGH = 11 * CELL, 9 * CELL  # px, of a box
_GAP, _LANE = 2 * CELL, 4 * CELL  # px, between boxes side by side, and above one another
_ROUNDS = 8  # of putting the boxes of each column in order
_PINNED = ("input", "output")


@dataclass(frozen=True)
class Box:
    """A node by the middle of its box, px to the right and down."""

    name: str
    x: float
    y: float


@dataclass(frozen=True)
class Layout:
    """A drawing.

    Args:
        width, height: px.
        boxes: one per node.
        lines: one per link, its corners (x, y).
        dots: where a line branches.
    """

    width: float
    height: float
    boxes: tuple[Box, ...]
    lines: tuple[tuple[tuple[float, float], ...], ...]
    dots: tuple[tuple[float, float], ...]


def layout(nodes: Sequence[Mapping[str, Any]], links: Sequence[Mapping[str, Any]]) -> Layout:
    """As the class' own diagram has it where every part has a place there, else in columns along the signal.

    Args:
        nodes: `name`, `kind`, and `at`: (x, y) to the right and up, or None.
        links: `source`, `target`, `net`, and `kind`: "to", "both" or "joint".
    """
    inner = [node for node in nodes if node["kind"] not in _PINNED]
    if inner and all(node["at"] is not None for node in inner):
        places = _as_drawn(nodes, inner)
    else:
        places = _in_columns([str(node["name"]) for node in nodes], nodes, links)
    return _routed(places, links)


def _as_drawn(nodes: Sequence[Mapping[str, Any]], inner: Sequence[Mapping[str, Any]]) -> dict[str, tuple[float, float]]:
    """Places of the diagram, stretched until no two boxes touch; inputs stand at the left, outputs at the right."""
    at = {str(node["name"]): (float(node["at"][0]), -float(node["at"][1])) for node in inner}
    pairs = [(abs(p[0] - q[0]), abs(p[1] - q[1])) for p, q in combinations(at.values(), 2)]
    across = max([(WIDE + _GAP) / dx for dx, dy in pairs if dx > 0 and dy < 0.6 * dx], default=1.0)
    down = max([(HIGH + _LANE) / dy for dx, dy in pairs if dy > 0 and dx * across < WIDE + CELL], default=0.0)
    down = max(down, 0.75 * across)
    rows = _rows([y * down for _, y in at.values()])
    places = {name: (x * across, rows[y * down]) for name, (x, y) in at.items()}
    left = min(x for x, _ in places.values()) - WIDE - _GAP
    right = max(x for x, _ in places.values()) + WIDE + _GAP
    for kind, x in zip(_PINNED, (left, right), strict=True):
        own = [node for node in nodes if node["kind"] == kind]
        wanted = [-float(node["at"][1]) * down if node["at"] is not None else 0.0 for node in own]
        for node, y in zip(own, _apart(wanted), strict=True):
            places[str(node["name"])] = (x, y)
    return places


def _rows(heights: Sequence[float]) -> dict[float, float]:
    """Heights that hardly differ become one."""
    found: dict[float, float] = {}
    for y in sorted(set(heights)):
        last = max(found.values(), default=-math.inf)
        found[y] = last if y - last < 0.4 * HIGH else y
    return found


def _apart(wanted: Sequence[float]) -> list[float]:
    """The same heights, moved down where two boxes would touch; in their order from above."""
    order = sorted(range(len(wanted)), key=lambda k: wanted[k])
    found = list(wanted)
    for above, below in pairwise(order):
        found[below] = max(found[below], found[above] + HIGH + CELL)
    return found


# --- columns along the signal ----------------------------------------------------------------------------------------


def _in_columns(
    names: Sequence[str], nodes: Sequence[Mapping[str, Any]], links: Sequence[Mapping[str, Any]]
) -> dict[str, tuple[float, float]]:
    """Each node a column behind the nearest that it depends on, in an order with few crossings."""
    begins = [str(n["name"]) for n in nodes if n["kind"] == "input"] or list(names[:1])
    columns = _columns(names, begins, links)
    ends = [str(n["name"]) for n in nodes if n["kind"] == "output"]
    fed = {str(link["source"]) for link in links}
    last = max(columns.values(), default=0)
    columns |= {name: max(last, 1) for name in ends if name not in fed}
    rows = [[name for name in names if columns[name] == k] for k in range(last + 1)]
    near: dict[str, list[str]] = {name: [] for name in names}
    for link in links:
        near[str(link["source"])].append(str(link["target"]))
        near[str(link["target"])].append(str(link["source"]))
    height = {name: k - len(row) / 2 for row in rows for k, name in enumerate(row)}
    for turn in range(_ROUNDS):
        for row in rows if turn % 2 else reversed(rows):
            mean = {n: sum(height[m] for m in near[n]) / len(near[n]) if near[n] else height[n] for n in row}
            row.sort(key=lambda name: mean[name])
            height |= {name: k - (len(row) - 1) / 2 for k, name in enumerate(row)}
    wide, high = WIDE + 4 * _GAP, HIGH + _LANE
    return {name: (k * wide, height[name] * high) for k, row in enumerate(rows) for name in row}


def _columns(names: Sequence[str], begins: Sequence[str], links: Sequence[Mapping[str, Any]]) -> dict[str, int]:
    """Steps from the inputs, along the signal first; what no input reaches stands beside what it is linked with."""
    found = dict.fromkeys(begins, 0)
    while True:
        ways = [(str(x["source"]), str(x["target"])) for x in links]
        back = [(b, a) for (a, b), x in zip(ways, links, strict=True) if x["kind"] != "to"]
        step = _reached(found, ways + back) or _reached(found, [(b, a) for a, b in ways])
        if not step:
            break
        found |= step
    return {name: found.get(name, 0) for name in names}


def _reached(found: Mapping[str, int], ways: Sequence[tuple[str, str]]) -> dict[str, int]:
    """Nodes one step behind the known ones, of the lowest such column."""
    next_ = [(found[a] + 1, b) for a, b in ways if a in found and b not in found]
    lowest = min((column for column, _ in next_), default=0)
    return {name: column for column, name in next_ if column == lowest}


# --- lines -----------------------------------------------------------------------------------------------------------


def _routed(places: Mapping[str, tuple[float, float]], links: Sequence[Mapping[str, Any]]) -> Layout:
    """Boxes moved onto the grid, and lines around them, the short ones first."""
    left = min((x for x, _ in places.values()), default=0.0) - WIDE / 2 - _LANE
    top = min((y for _, y in places.values()), default=0.0) - HIGH / 2 - _LANE
    moved = {name: (_snapped(x - left, WIDE), _snapped(y - top, HIGH)) for name, (x, y) in places.items()}
    width = max((x for x, _ in moved.values()), default=0.0) + WIDE / 2 + _LANE
    height = max((y for _, y in moved.values()), default=0.0) + HIGH / 2 + _LANE
    grid = Grid(round(width / CELL), round(height / CELL))
    for x, y in moved.values():
        grid.block(_cells(x, y))

    def length(k: int) -> float:
        (a, b), (c, d) = moved[str(links[k]["source"])], moved[str(links[k]["target"])]
        return abs(a - c) + abs(b - d)

    lines: dict[int, tuple[tuple[float, float], ...]] = {}
    for k in sorted(range(len(links)), key=length):
        one, other = (_cells(*moved[str(links[k][end])]) for end in ("source", "target"))
        lines[k] = grid.route(one, other, str(links[k]["net"]), free=links[k]["kind"] != "to")
    boxes = tuple(Box(name, x, y) for name, (x, y) in moved.items())
    return Layout(width, height, boxes, tuple(lines[k] for k in range(len(links))), grid.dots())


def _snapped(middle: float, size: float) -> float:
    """So that the box begins at a cell; equal distances stay equal."""
    return math.floor((middle - size / 2) / CELL + 0.5) * CELL + size / 2


def _cells(x: float, y: float) -> tuple[int, int, int, int]:
    """First and behind the last column and row of cells below a box."""
    a, b = round((x - WIDE / 2) / CELL), round((y - HIGH / 2) / CELL)
    return a, b, a + round(WIDE / CELL), b + round(HIGH / CELL)
