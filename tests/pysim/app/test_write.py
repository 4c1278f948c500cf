"""A law is typed on the page: drawn over the learned curve, its mistake shown at its place, added and refitted."""

import asyncio
import re
from pathlib import Path

import pytest

from pysim.app.desk import Desk
from pysim.app.jobs import Job, Runner, Work, _write_job, works
from pysim.app.project import Project
from pysim.app.upload import Limits
from pysim.workflow import LawPlace
from pysim.workflow.own_law import Range
from tests.pysim.app.browser import Show, Shown, Tab, artefacts
from tests.pysim.app.code_tasks import CODE
from tests.pysim.app.made import rubbing

PATIENCE = 60.0  # s, on a machine that does other things too
F_C = 0.4  # N
LAW = "-F*tanh(v/0.02)"


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return rubbing(tmp_path / "project", F_C)


@pytest.mark.slow
def test_a_law_is_written_over_the_learned_curve_and_added(shown: Shown, show: Show, project: Project) -> None:
    tab = Tab(shown, show(project.folder), artefacts())
    tab.see("effects that fit")
    tab.go("Locate")
    tab.page.get_by_role("button", name="Locate", disabled=False).click()
    tab.see("What force would need", timeout=PATIENCE)
    field = tab.page.get_by_label("law for force")
    field.press_sequentially("-F*tan(v/0.02)")
    tab.see("tan is no function that the law may use; did you mean tanh?")
    assert tab.page.locator("mark").inner_text() == "tan(v/0.02)"
    tab.shot("write-mistake")
    field.fill("-F*tanh(time/0.02)")
    tab.see("This law is not drawn over the learned curve, which is over")
    field.fill(LAW)
    usual = tab.page.get_by_label("usual of F")
    tab.until(lambda: float(usual.input_value()) == pytest.approx(F_C, rel=0.2))
    assert tab.page.get_by_label("unit of F").input_value() == "N"
    chart = tab.page.locator(".chart[aria-label^='Learned law, and the one written']")
    assert chart.evaluate("(el) => el.data.map((one) => one.name)") == ["95 % band", "learned law", "as written"]
    tab.shot("write")
    tab.page.get_by_label("name of the law").fill("my.rubbing")
    tab.press("Add and refit")
    tab.see("Undo my.rubbing", timeout=PATIENCE)
    numbers = tab.page.locator(".chart .annotation-text").all_text_contents()
    assert min(float(one) for one in numbers if one[:1].isdigit()) < 1.1  # nothing but noise is left
    assert project.settings().added == ("my.rubbing",)
    tab.go("Take away")
    assert "--library laws/MyRubbing.mo --effects my.rubbing" in tab.page.locator("pre").last.inner_text()
    tab.see("report/MyRubbing.mo")  # which the class needs
    tab.go("Locate")
    tab.see("This was found of the model without effects.")
    assert "--library laws/MyRubbing.mo --with my.rubbing" in " ".join(works(project)["locate"].words)
    tab.page.get_by_role("button", name="Locate", disabled=False).click()
    tab.page.get_by_text("This was found of the model").wait_for(state="detached", timeout=1000 * PATIENCE)
    tab.idle()
    assert "Done after" in tab.page.locator(".top").inner_text()
    tab.go("Add")
    tab.page.keyboard.press("Control+z")
    tab.page.get_by_role("button", name=re.compile("^Undo my")).wait_for(state="detached")
    assert project.settings().added == ()
    assert tab.errors == []


def test_a_law_is_changed_under_its_name(project: Project) -> None:
    """What was found with it as it was counts no more; what others have found does."""
    desk = Desk(project, Runner(project, tasks=CODE), Limits())
    place = LawPlace.of("Toy.Mass", "force", [project.models / "Toy.mo"])
    begun: list[str] = []
    desk.add = begun.append  # type: ignore[method-assign]

    async def write(law: str) -> None:
        await desk.add_law("my.rubbing", place, law, {"F": Range(-2.0, 2.0, 0.4, "N")})

    def found(*effects: str, name: str = "") -> Path:
        folder = project.results(name or "add-" + "+".join(effects))
        folder.mkdir(parents=True)
        _write_job(Job(Work(folder.name, "Add", ("add",), effects), "done", 1.0, 2.0, project.fingerprint()), folder)
        return folder

    asyncio.run(write(LAW))
    file = project.laws / "MyRubbing.mo"
    assert "tanh(v/0.02)" in file.read_text()
    mine, other = found("toy.bias", "my.rubbing"), found("toy.bias")
    tried = found(name="diagnose")
    project.change(added=("toy.bias", "my.rubbing"))
    asyncio.run(write(LAW))  # the same again changes nothing
    assert mine.exists()
    asyncio.run(write("-F*tanh(v/0.5)"))
    assert "tanh(v/0.5)" in file.read_text()
    assert (mine.exists(), tried.exists(), other.exists()) == (False, False, True)
    assert project.settings().added == ("toy.bias",)
    assert begun == ["my.rubbing"] * 3
    desk.runner.close()
