"""Lines around boxes: the cheapest way over a grid, where bends, crossings and running along another line cost."""

from __future__ import annotations

from collections.abc import Iterator
from heapq import heapify, heappop, heappush

CELL = 7  # px
_BEND, _CROSS, _ALONG, _NEAR, _OWN = 9.0, 5.0, 40.0, 0.6, 0.25
_SIDE, _BACK, _OFF = 5.0, 12.0, 0.7  # a pin above or below, one against the signal, one beside the middle of its side
_HOPE = 0.9  # of what a cell costs, for the way that is left: a line finds home sooner, and hardly ever a worse way
_MOVES = ((1, 0), (-1, 0), (0, 1), (0, -1))  # the last bit turns one round

Cell = tuple[int, int]
Span = tuple[int, int, int, int]
_Place = tuple[Cell, int]  # a cell, and the move into it


class Grid:
    """Cells, which of them boxes cover, and which lines go through each.

    Args:
        columns, rows: number of cells.
    """

    def __init__(self, columns: int, rows: int) -> None:
        self._columns, self._rows = columns, rows
        self._blocked: set[Cell] = set()
        self._near: set[Cell] = set()
        self._used: dict[Cell, dict[str, set[int]]] = {}  # cell -> net -> moves into and out of it

    def block(self, box: Span) -> None:
        """No line goes through a box."""
        a, b, c, d = box
        self._blocked |= {(x, y) for x in range(a, c) for y in range(b, d)}
        self._near |= {(x, y) for x in range(a - 1, c + 1) for y in range(b - 1, d + 1)}

    def route(self, one: Span, other: Span, net: str, *, free: bool) -> tuple[tuple[float, float], ...]:
        """Corners of a line from box to box, px; lines of one net share what they can.

        Args:
            free: whether it may leave and enter at any side; else to the right and from the left where that can be.
        """
        ends = {cell: (move, cost) for cell, move, cost in _pins(other, free, entering=True)}
        starts = {(cell, move): cost for cell, move, cost in _pins(one, free, entering=False) if self._open(cell)}
        came: dict[_Place, _Place] = {}
        end, last = self._cheapest(starts, ends, other, net, came)
        return () if end is None else self._kept(_way(end, came), last, net)

    def _cheapest(
        self,
        starts: dict[_Place, float],
        ends: dict[Cell, tuple[int, float]],
        other: Span,
        net: str,
        came: dict[_Place, _Place],
    ) -> tuple[_Place | None, int]:
        """Where the cheapest way ends and with which move it enters; `came` tells the place before each."""
        best = dict(starts)
        queue = [(cost + _HOPE * _far(cell, other), cost, cell, move) for (cell, move), cost in starts.items()]
        heapify(queue)
        least, end, last = float("inf"), None, 0
        while queue and queue[0][0] < least:
            _, cost, cell, move = heappop(queue)
            if cost > best[cell, move]:
                continue
            if cell in ends:
                total = cost + ends[cell][1] + (_BEND if ends[cell][0] != move else 0.0)
                if total < least:
                    least, end, last = total, (cell, move), ends[cell][0]
            for there, turn in self._around(cell, move):
                price = cost + self._price(there, turn, net) + (_BEND if turn != move else 0.0)
                if price < best.get((there, turn), float("inf")):
                    best[there, turn] = price
                    came[there, turn] = (cell, move)
                    heappush(queue, (price + _HOPE * _far(there, other), price, there, turn))
        return end, last

    def _around(self, cell: Cell, move: int) -> Iterator[_Place]:
        """Free cells beside one, but for where the line comes from."""
        for turn, (dx, dy) in enumerate(_MOVES):
            there = (cell[0] + dx, cell[1] + dy)
            if turn != move ^ 1 and self._open(there):
                yield there, turn

    def dots(self) -> tuple[tuple[float, float], ...]:
        """Where lines of one net part."""
        found = [cell for cell, nets in self._used.items() if any(len(moves) > 2 for moves in nets.values())]
        return tuple(_middle(cell) for cell in found)

    def _open(self, cell: Cell) -> bool:
        return 0 <= cell[0] < self._columns and 0 <= cell[1] < self._rows and cell not in self._blocked

    def _price(self, cell: Cell, turn: int, net: str) -> float:
        used = self._used.get(cell)
        if used is None:
            return 1.0 + (_NEAR if cell in self._near else 0.0)
        if net in used:
            return _OWN
        along = any(side >> 1 == turn >> 1 for moves in used.values() for side in moves)
        bent = any(len({side >> 1 for side in moves}) > 1 for moves in used.values())
        return 1.0 + (_ALONG if along or bent else _CROSS)

    def _kept(self, way: list[_Place], last: int, net: str) -> tuple[tuple[float, float], ...]:
        """Remember a line, and give its corners; both ends reach the edge of their box."""
        for k, (cell, move) in enumerate(way):
            out = way[k + 1][1] if k + 1 < len(way) else last
            self._used.setdefault(cell, {}).setdefault(net, set()).update((move ^ 1, out))
        (first, begin), (end, _) = way[0], way[-1]
        points = [_edge(first, begin ^ 1), *(_middle(cell) for cell, _ in way), _edge(end, last)]
        return tuple(_corners(points))


def _pins(box: Span, free: bool, *, entering: bool) -> Iterator[tuple[Cell, int, float]]:
    """Cells around a box, the move that leaves (or enters) it there, and what that costs."""
    a, b, c, d = box
    x, y = (a + c - 1) / 2, (b + d - 1) / 2
    for move in range(len(_MOVES)):
        side = move ^ 1 if entering else move
        across = side < 2
        wanted = side == (1 if entering else 0)
        cost = 0.0 if free or wanted else _BACK if across else _SIDE
        if across:
            cells = [(c if side == 0 else a - 1, row) for row in range(b + 1, d - 1)]
        else:
            cells = [(column, d if side == 2 else b - 1) for column in range(a + 1, c - 1)]
        for cell in cells:
            yield cell, move, cost + _OFF * (abs(cell[1] - y) if across else abs(cell[0] - x))


def _far(cell: Cell, box: Span) -> float:
    """Cells to a box at least."""
    a, b, c, d = box
    return float(max(a - 1 - cell[0], cell[0] - c, 0) + max(b - 1 - cell[1], cell[1] - d, 0))


def _way(end: _Place, came: dict[_Place, _Place]) -> list[_Place]:
    way = [end]
    while way[-1] in came:
        way.append(came[way[-1]])
    return way[::-1]


def _middle(cell: Cell) -> tuple[float, float]:
    return (cell[0] + 0.5) * CELL, (cell[1] + 0.5) * CELL


def _edge(cell: Cell, move: int) -> tuple[float, float]:
    """Middle of the cell's side in a direction."""
    x, y = _middle(cell)
    return x + _MOVES[move][0] * CELL / 2, y + _MOVES[move][1] * CELL / 2


def _corners(points: list[tuple[float, float]]) -> Iterator[tuple[float, float]]:
    """Without what lies on a straight line."""
    yield points[0]
    for before, here, after in zip(points, points[1:], points[2:], strict=False):
        if (here[0] - before[0]) * (after[1] - here[1]) != (here[1] - before[1]) * (after[0] - here[0]):
            yield here
    yield points[-1]
