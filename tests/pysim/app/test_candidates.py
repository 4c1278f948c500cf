"""The page Candidates in a real browser, on a ranking whose numbers are known."""

import io
import json
import shutil
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.app.project import Project, Settings
from pysim.bench import read_plan
from pysim.io import write_dataset
from tests.known_answers.plants import PLANTS
from tests.pysim.app.browser import Show, Shown, Tab, artefacts
from tests.pysim.app.made import description
from tests.pysim.diagnosis.plants import measured

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
    assert rows(tab) == [("1", True, 90.0), ("2", False, 45.0), ("·", False, 0.0)]  # shares of the misfit
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
    for name in tab.page.locator(".rail .name").all():  # of each page, not its number alone
        place = name.bounding_box()
        assert place["width"] > 15
        assert place["x"] + place["width"] <= tab.page.locator(".rail").bounding_box()["width"]
    tab.shot(f"candidates-{width}")
    assert tab.errors == []


@pytest.mark.slow
def test_a_tie_comes_with_the_test_that_separates_it_and_its_command(shown: Shown, show: Show, tmp_path: Path) -> None:
    """1.5 s of a mass that rubs: friction explains the log, and so does a constant force."""
    plant, project = PLANTS["mass"], Project.at(tmp_path / "project")
    rubs, truth = {"mass.friction": {"F_c": 0.2}}, {"m": 1.0, "d": 1.9, "k": 40.0}
    write_dataset(project.data, measured("mass", rubs, truth, fit=(1,), validate=(), length=1.5))
    project.models.mkdir()
    shutil.copy(plant.library, project.models)
    project.save(Settings(model=plant.model, libraries=(f"model/{plant.library.name}",)))
    tab = Tab(shown, show(project.folder), artefacts())
    tab.see("effects that fit")
    tab.go("Candidates")
    tab.page.get_by_role("button", name="Find what is missing", disabled=False).click()
    tab.see("Undo mass.friction")  # the page Add
    tab.go("Candidates")
    tab.see("These data cannot tell mass.friction, mass.bias")
    tied = tab.page.locator(".candidate.tied h3 + .chip").all_text_contents()
    assert {*tied} >= {"mass.bias", "mass.friction"}  # dry friction that also sticks may be a third
    tab.see("It separates mass.friction from mass.bias")
    tab.shot("candidates-tie")
    with tab.page.expect_download() as download:
        tab.page.get_by_role("link", name="Download its commands as CSV").click()
    assert download.value.suggested_filename == "next_test.zip"
    (plan,) = (project.folder / "results/diagnose").rglob("next_test.toml")
    (sine,) = read_plan(plan).tests
    ((offset, amplitude),) = sine.points
    tab.see(f"a sine of {sine.frequencies[0]:.3g} Hz and {amplitude:.3g} N around {offset:.3g} N")
    with zipfile.ZipFile(io.BytesIO(Path(download.value.path()).read_bytes())) as archive:
        assert any(name.endswith("dataset.toml") for name in archive.namelist())
        (run,) = (name for name in archive.namelist() if name.endswith("Hz.csv"))
        head, *rows = archive.read(run).decode().splitlines()
    assert "F" in head
    values = np.array([[float(one) for one in row.split(",")] for row in rows])
    assert np.allclose(np.diff(values[:, 0]), values[1, 0] - values[0, 0], rtol=1e-6)
    ends = values[:, 1].min(), values[:, 1].max()  # it begins and ends at 0
    assert ends == pytest.approx((offset - amplitude, offset + amplitude), rel=0.02)
    assert tab.errors == []
