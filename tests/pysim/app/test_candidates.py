"""The page Candidates in a real browser, on a ranking whose numbers are known."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.app.project import Project
from tests.pysim.app.browser import Show, Shown, Tab, artefacts
from tests.pysim.app.made import description

EMPTY: dict[str, Any] = {key: [] for key in ("added", "confusable", "error", "missing", "notes")}


def ranked(folder: Path, **scores: tuple[float, bool]) -> Path:
    """A project whose only result is a ranking: score of a candidate, and whether it was refitted."""
    (folder / "data").mkdir(parents=True)
    (folder / "data/dataset.toml").write_text(description("a.txt"))
    (folder / "data/a.txt").write_text("\n".join(f"{k / 10} {k % 7} {k % 5}" for k in range(50)))
    (folder / "project.toml").write_text('model = ""\n')
    place = folder / "results/rank"
    place.mkdir(parents=True)
    about = np.frombuffer(json.dumps({"form": 3, "stages": []}).encode(), dtype=np.uint8)
    np.savez(place / "records.npz", about=about)
    rows = [
        {"effect": name, "round": 1, "score": score, "refitted": refitted, "explained": max(score, 0) / 100}
        | {"parameters": {"F_c": 0.4}}
        for name, (score, refitted) in scores.items()
    ]
    answer = EMPTY | {"ranking": rows, "reason": "", "verdict": "none", "next_test": None, "files": {}}
    (place / "answer.json").write_text(json.dumps(answer))
    job = {"work": {"name": "rank", "title": "Rank", "words": ["diagnose"], "effects": []}, "state": "done"}
    job |= {"begun": 1.0, "ended": 2.0, "fingerprint": Project(folder).fingerprint(), "message": ""}
    (place / "job.json").write_text(json.dumps(job))
    return folder


def rows(tab: Tab) -> list[tuple[str, bool, float]]:
    """Per candidate its rank, whether it is marked as the first, and the width of its bar in percent."""
    look = """(all) => all.map((one) => [one.querySelector(".rank").textContent, one.classList.contains("first"),
        parseFloat(one.querySelector(".bar i").style.width)])"""
    return [tuple(one) for one in tab.page.locator(".candidate").evaluate_all(look)]


def test_only_a_candidate_that_gains_something_has_a_rank(shown: Shown, show: Show, tmp_path: Path) -> None:
    some = ranked(
        tmp_path / "some", **{"toy.friction": (90.0, True), "toy.bias": (45.0, False), "toy.stop": (-3, True)}
    )
    tab = Tab(shown, show(some, idle=True), artefacts())
    tab.go("Candidates")
    tab.see("explains 90.0 % of the misfit (refitted)")
    assert rows(tab) == [("1", True, 100.0), ("2", False, 50.0), ("·", False, 0.0)]
    tab.shot("candidates-some")
    none = ranked(tmp_path / "none", **{"toy.bias": (-1.0, False), "toy.stop": (-3.0, True)})
    tab = Tab(shown, show(none, idle=True), artefacts())
    tab.go("Candidates")
    tab.page.locator(".candidate").nth(1).wait_for()
    assert rows(tab) == [("·", False, 0.0)] * 2
    assert "toy.bias" not in tab.page.locator(".rail").inner_text()  # no best one is named there
    assert tab.errors == []


@pytest.mark.parametrize("width", [420, 800])
def test_its_numbers_are_to_be_seen_on_a_narrow_screen(width: int, shown: Shown, show: Show, tmp_path: Path) -> None:
    project = ranked(tmp_path / "project", **{"toy.friction": (90.0, True), "toy.bias": (-1.0, False)})
    tab = Tab(shown, show(project, idle=True), artefacts())
    tab.page.set_viewport_size({"width": width, "height": 800})
    tab.page.locator(".rail a[href='/candidates']").click()
    tab.see("explains 90.0 % of the misfit (refitted)")
    for gain in tab.page.locator(".gain").all():
        place, name = gain.bounding_box(), gain.locator("..").locator("h3").bounding_box()
        assert place["width"] > 150
        assert place["x"] + place["width"] <= width
        assert place["y"] >= name["y"] + name["height"]
    tab.page.get_by_text("F_c 0.4").first.wait_for()
    tab.shot(f"candidates-{width}")
    assert tab.errors == []
