"""The whole story in a real browser: logs of a plant that rubs are dropped, and its FMU is taken away."""

import re
import time
from pathlib import Path

import pytest

from pysim.io import read_model, write_dataset
from tests.pysim.app.browser import SIZE, Shown, Tab, artefacts, server
from tests.toy import CATALOGUE, TEXT, measured

pytestmark = pytest.mark.slow
PATIENCE = 400.0  # s, on a machine that does other things too
LONG, LONGEST = 120, 259  # characters of a project's path, and of any path on Windows as it comes


@pytest.fixture
def dropped(tmp_path: Path) -> tuple[Path, Path]:
    """A data set with a hidden effect, and the library of the model."""
    write_dataset(tmp_path / "rubbing", measured(1, "toy.friction", F_c=0.4))
    (tmp_path / "Toy.mo").write_text(TEXT)
    return tmp_path / "rubbing", tmp_path / "Toy.mo"


def begun(shown: Shown, address: str, dropped: tuple[Path, Path]) -> Tab:
    """A tab that has data and model."""
    tab = Tab(shown, address, artefacts())
    tab.drop("folder", dropped[0])
    tab.see("2 records, 1 not fitted")
    tab.drop("files", dropped[1])
    tab.see("Libraries of yours: model/Toy.mo")
    tab.page.get_by_label("Modelica class").fill("Toy.Mass")
    tab.press("Use this model")
    tab.see(f"{len(CATALOGUE)} effects that fit", timeout=PATIENCE)
    return tab


def test_from_the_dropped_folder_to_the_downloaded_fmu(
    shown: Shown, dropped: tuple[Path, Path], tmp_path: Path
) -> None:
    project = tmp_path / ("p" * max(LONG - len(str(tmp_path)) - 1, 1))  # where many people keep their work
    assert len(str(project)) >= LONG
    with server(project) as address:
        tab = begun(shown, address, dropped)
        _looked_at(tab, "data")
        tab.press("Compare and refit")
        tab.see("Where the error is", timeout=PATIENCE)
        _a_cell_opens_its_record(tab)
        _looked_at(tab, "compare")
        tab.go("Locate")
        tab.press("Locate")
        tab.see("What force would need", timeout=PATIENCE)
        _a_slot_is_picked_by_keyboard(tab)
        _looked_at(tab, "locate")
        tab.go("Candidates")
        tab.press("Rank the candidates")
        tab.see("of the misfit (refitted)", timeout=PATIENCE)
        first = tab.page.locator(".candidate").first
        assert "Dry friction" in first.inner_text()
        _looked_at(tab, "candidates")
        tab.page.set_viewport_size({"width": 420, "height": 800})
        _looked_at(tab, "candidates-narrow")
        tab.page.set_viewport_size(SIZE)
        tab.page.locator(".candidate", has_text="toy.friction").get_by_role("button", name="Try").click()
        tab.see("Undo toy.friction", timeout=PATIENCE)
        _looked_at(tab, "add")
        assert tab.page.get_by_text("Criteria of thesis").count() == 0  # they are for its pump alone
        numbers = tab.page.locator(".chart .annotation-text").all_text_contents()
        assert min(float(text) for text in numbers if text[:1].isdigit()) < 1.1  # nothing but noise is left
        tab.go("Locate")
        _looked_at(tab, "added")
        assert "+ toy.friction" in tab.page.locator(".drawing [data-name=force]").text_content()
        tab.go("Take away")
        with tab.page.expect_download() as download:
            tab.page.locator(".file", has_text="FMU").get_by_text("Download").first.click()
        fmu = tmp_path / "taken.fmu"
        download.value.save_as(fmu)
        _looked_at(tab, "take")
        model = read_model(fmu)
        assert model.name == "MassWithRubbing"
        assert model["force.F_c"].start == pytest.approx(0.4, abs=0.02)
        assert tab.errors == []
        assert tab.foreign() == []
    inside = [str(path.relative_to(project)) for path in project.rglob("*")]
    deepest = max(inside, key=len)
    assert LONG + 1 + len(deepest) <= LONGEST, deepest


def _looked_at(tab: Tab, name: str) -> None:
    """A picture of a page that everybody can use."""
    tab.accessible()
    tab.shot(name)


def _a_slot_is_picked_by_keyboard(tab: Tab) -> None:
    """The drawing has every place of the model; its one slot tells its share."""
    names = tab.page.locator(".drawing g.node").evaluate_all("(all) => all.map((g) => g.dataset.name)")
    assert sorted(names) == ["F", "force", "v", "x"]
    slot = tab.page.get_by_role("button", name=re.compile(r"^force (9\d\.\d|100\.0) % of the misfit"))
    slot.focus()
    tab.page.keyboard.press("Enter")
    assert slot.get_attribute("aria-pressed") == "true"
    tab.see("Effects that fit here")


def _a_cell_opens_its_record(tab: Tab) -> None:
    """A click into the map's second row, of two; the frame of the page stays where it is."""
    assert tab.page.locator("#record h2").inner_text() == "a.txt"  # the worse one
    tab.pick("Map of the error", 0.5, 0.75)
    tab.page.locator("#record h2", has_text="b.txt").wait_for()
    tab.page.wait_for_timeout(700)  # it scrolls there
    assert tab.page.evaluate("document.querySelector('.top').getBoundingClientRect().top") == 0
    assert tab.page.evaluate("document.querySelector('.main').scrollTop") > 0


def lines(path: Path, count: int) -> list[str]:
    """Whole lines of a file, once there are so many."""
    begun = time.monotonic()
    while time.monotonic() - begun < PATIENCE:
        found = path.read_text().split("\n")[:-1] if path.exists() else []
        if len(found) >= count:
            return found
        time.sleep(0.02)
    raise AssertionError(f"{path} has {len(found)} lines in place of {count}")


def test_a_stopped_diagnosis_goes_on_and_a_reload_finds_it(
    shown: Shown, dropped: tuple[Path, Path], tmp_path: Path
) -> None:
    project = tmp_path / "project"
    with server(project) as address:
        tab = begun(shown, address, dropped)
        other = Tab(shown, address)
        tab.press("Find what is missing")
        tab.see("Stop")
        other.see("Stop")  # two tabs agree
        checkpoint = project / "results/diagnose/report/checkpoint.jsonl"
        found = lines(checkpoint, 2)  # whose it is, and the first part that is done
        other.press("Stop")  # at once: the toy is found within seconds
        tab.see("was stopped; what it had found is kept")
        tab.page.reload()
        tab.see("was stopped; what it had found is kept")
        found = lines(checkpoint, len(found))
    with server(project) as address:  # a server that ended loses nothing
        tab = Tab(shown, address)
        tab.press("Go on")
        tab.see("Stop")
        tab.go("Add")
        assert lines(checkpoint, len(found) + 1)[: len(found)] == found  # nothing is done twice
        tab.see("Undo toy.", timeout=PATIENCE)  # friction or its twin: these data do not tell them apart
        undo = tab.page.get_by_role("button", name=re.compile(r"^Undo toy\.(friction|twin)$"))
        undo.click()
        undo.wait_for(state="detached")
        assert tab.errors == []
