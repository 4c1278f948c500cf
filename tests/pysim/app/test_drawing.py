"""The model as a flowchart: its text, in which nothing of a name is markup, and what a browser makes of it."""

import re
from pathlib import Path

import pytest

pytest.importorskip("nicegui", reason="the extra app is not installed")

from pysim.app.flowchart import flowchart
from tests.pysim.app.browser import Show, Shown, Tab, artefacts
from tests.toy import TEXT


def test_places_have_shapes_and_links_have_arrows() -> None:
    nodes = [
        {"name": "u", "kind": "input", "rows": ["u"]},
        {"name": "axis", "kind": "slot seen first", "rows": ["axis", "97.3 %"]},
        {"name": "v", "kind": "term", "rows": ["v"]},
        {"name": "m", "kind": "part", "rows": ["m"]},
    ]
    links = [
        {"source": "u", "target": "axis", "kind": "to"},
        {"source": "v", "target": "axis", "kind": "both"},
        {"source": "axis", "target": "m", "kind": "joint"},
    ]
    assert flowchart(nodes, links).splitlines() == [
        "flowchart LR", '  n0(["u"])', '  n1["axis<br/>97.3 %"]', '  n2("v")', '  n3["m"]',
        "  n0 --> n1", "  n2 <--> n1", "  n1 === n3",
    ]  # fmt: skip


def test_nothing_of_a_name_is_markup() -> None:
    name = '\'"]; click n0 href "x" <img src=x onerror=alert(1)> `**b**` #quot; %%{init}%%'
    (_, line) = flowchart([{"name": name, "kind": "part", "rows": [name]}], []).splitlines()
    inside = re.fullmatch(r'  n0\["(.*)"\]', line)
    assert inside is not None
    assert len(inside[1]) == len(name)
    assert set(inside[1]) - set("abcdefghijklmnopqrstuvwxyz01 .%\N{MIDDLE DOT}") == set()
    assert "%%" not in line


def test_slots_are_buttons_for_mouse_and_keyboard(show: Show, shown: Shown, tmp_path: Path) -> None:
    (tmp_path / "Toy.mo").write_text(TEXT)
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.drop("files", tmp_path / "Toy.mo")
    tab.see("Libraries of yours: model/Toy.mo")
    tab.page.get_by_label("Modelica class").fill("Toy.Mass")
    tab.press("Use this model")
    tab.see("effects that fit")
    tab.go("Locate")
    places = tab.page.locator(".drawing g.node")
    places.first.wait_for()
    assert sorted(places.evaluate_all("(all) => all.map((g) => g.dataset.name)")) == ["F", "force", "v", "x"]
    written = places.evaluate_all("(all) => all.map((g) => g.querySelector('text').textContent.trim())")
    assert sorted(written) == ["F", "force", "v", "x"]
    slot = tab.page.get_by_role("button", name=re.compile("^force"))
    slot.focus()
    tab.page.keyboard.press("Enter")
    tab.see("Effects that fit here")
    assert slot.get_attribute("aria-pressed") == "true"
    tab.shot("drawing")
    assert (
        tab.page.evaluate("getComputedStyle(document.body).overflowY") == "hidden"
    )  # the page scrolls, and that alone
    assert tab.errors == []
    assert tab.foreign() == []
