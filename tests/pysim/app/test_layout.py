"""Drawings: as the class' diagram where it has one, along the signal where not; no box on another, every line there."""

from dataclasses import asdict
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the extra app is not installed")

from pysim.app.layout import HIGH, WIDE, Layout, layout
from pysim.app.pages.locate import broken
from pysim.effects import STANDARD_LIBRARY
from pysim.effects.structure import structure
from tests.pysim.diagnose.toy import library


def drawn(name: str, *libraries: Path) -> tuple[dict[str, Any], Layout]:
    """A class' parts and its drawing."""
    parts = asdict(structure(name, [STANDARD_LIBRARY, *libraries]))
    return parts, layout(parts["nodes"], parts["links"])


@pytest.mark.parametrize(
    "name", ["HydraulicTestBench.Pump.FreeGreyBox", "HydraulicTestBench.LoadCircuit.OpenTestBench"]
)
def test_boxes_are_apart_and_every_link_has_its_line(name: str) -> None:
    parts, found = drawn(name)
    assert {box.name for box in found.boxes} == {node["name"] for node in parts["nodes"]}
    for one, other in combinations(found.boxes, 2):
        assert abs(one.x - other.x) >= WIDE or abs(one.y - other.y) >= HIGH, (one, other)
    at = {box.name: (box.x, box.y) for box in found.boxes}
    for link, points in zip(parts["links"], found.lines, strict=True):
        for name_, point in ((link["source"], points[0]), (link["target"], points[-1])):
            x, y = at[name_]
            assert max(abs(point[0] - x) / (WIDE / 2), abs(point[1] - y) / (HIGH / 2)) == pytest.approx(1)
        assert all(a[0] == b[0] or a[1] == b[1] for a, b in pairwise(points))
        for box in found.boxes:  # through none
            for (x0, y0), (x1, y1) in pairwise(points):
                across = min(x0, x1) < box.x + WIDE / 2 and max(x0, x1) > box.x - WIDE / 2
                assert not (across and min(y0, y1) < box.y + HIGH / 2 and max(y0, y1) > box.y - HIGH / 2)


def test_a_diagram_keeps_its_order() -> None:
    _, found = drawn("HydraulicTestBench.Pump.FreeGreyBox")
    at = {box.name: box for box in found.boxes}
    chain = ("angleError", "card", "cardOutput", "spoolCommand", "deadTime", "spool", "spoolOpening")
    assert len({at[name].y for name in chain}) == 1
    steps = {after - before for before, after in pairwise([at[name].x for name in chain])}
    assert len(steps) == 1
    assert at["alphaCMD"].x < min(at[name].x for name in chain)
    assert at["chamber1"].y < at["oil"].y < at["chamber2"].y


def test_without_a_diagram_it_runs_from_the_input_on() -> None:
    _, found = drawn("Toy.Mass", library())
    at = {box.name: box.x for box in found.boxes}
    assert at["F"] < at["v"] < at["force"]
    assert at["v"] < at["x"]


def test_long_names_are_parted_where_a_word_begins() -> None:
    assert broken("spool") == ["spool"]
    assert broken("spoolOpening") == ["spool", "Opening"]
    assert broken("alphaCMD_t") == ["alpha", "CMD_t"]
    assert broken("x" * 40) == ["x" * 9 + "…", "x" * 9 + "…"]
