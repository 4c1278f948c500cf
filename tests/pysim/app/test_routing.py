"""Lines over a grid: around boxes, straight where that can be, shared within a net, crossed rather than covered."""

from itertools import pairwise

import pytest

pytest.importorskip("nicegui", reason="the extra app is not installed")

from pysim.app.routing import CELL, Grid

Points = tuple[tuple[float, float], ...]


def cells(points: Points) -> set[tuple[int, int]]:
    """Those that a line covers."""
    found = set()
    for (x0, y0), (x1, y1) in pairwise(points):
        for k in range(101):
            x, y = x0 + (x1 - x0) * k / 100, y0 + (y1 - y0) * k / 100
            found.add((int(x // CELL), int(y // CELL)))
    return found


def test_two_boxes_beside_each_other_are_joined_straight() -> None:
    grid = Grid(30, 12)
    one, other = (2, 2, 8, 7), (16, 2, 22, 7)
    grid.block(one)
    grid.block(other)
    assert grid.route(one, other, "a", free=False) == ((8 * CELL, 4.5 * CELL), (16 * CELL, 4.5 * CELL))
    assert grid.dots() == ()


def test_a_box_between_them_is_gone_around() -> None:
    grid = Grid(40, 20)
    boxes = [(2, 8, 8, 13), (14, 6, 20, 15), (26, 8, 32, 13)]
    for box in boxes:
        grid.block(box)
    points = grid.route(boxes[0], boxes[2], "a", free=False)
    inside = {(x, y) for x in range(14, 20) for y in range(6, 15)}
    assert len(points) == 4  # out above, along, and in from above
    assert not cells(points) & inside


def test_lines_of_one_net_share_their_way_and_part_at_a_dot() -> None:
    grid = Grid(40, 24)
    source, up, down = (2, 10, 8, 15), (26, 4, 32, 9), (26, 16, 32, 21)
    for box in (source, up, down):
        grid.block(box)
    one, other = grid.route(source, up, "a", free=False), grid.route(source, down, "a", free=False)
    assert len(cells(one) & cells(other)) > 8
    assert len(grid.dots()) == 1


def test_lines_of_two_nets_do_not_cover_each_other() -> None:
    grid = Grid(40, 24)
    source, up, down = (2, 10, 8, 15), (26, 4, 32, 9), (26, 16, 32, 21)
    for box in (source, up, down):
        grid.block(box)
    one, other = grid.route(source, up, "a", free=False), grid.route(source, down, "b", free=False)
    assert not cells(one) & cells(other)
    assert grid.dots() == ()


def test_what_is_walled_in_has_no_line() -> None:
    grid = Grid(20, 9)
    one, wall, other = (0, 0, 5, 9), (5, 0, 10, 9), (12, 2, 17, 7)
    for box in (one, wall, other):
        grid.block(box)
    assert grid.route(one, other, "a", free=True) == ()
