"""The page Compare in a real browser, on answers whose numbers are known: Bode plots with the band of Table 1.3, and a
file that holds two records."""

import io
import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.pysim.app.browser import Show, Shown, Tab, artefacts

DESCRIPTION = """
[dataset]
name = "sines"
[signals.u]
role = "input"
unit = "%"
[signals.y]
role = "output"
unit = "%"
"""
RECORD = """[[records]]
file = "{name}.txt"
columns = ["time", "u", "y"]
kind = "frequency-response"
offset = {offset}
amplitude = 10
frequency = {frequency}
"""
F = [1.0, 2.0, 5.0]
LIMITS = (("E_M max", "maximum magnitude deviation", 2.0, "dB"), ("E_P max", "maximum phase deviation", 35.0, "deg"))


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """Sines at two operating points, compared with a model that fails at the second."""
    folder = tmp_path / "project"
    (folder / "data").mkdir(parents=True)
    text, time = DESCRIPTION, np.arange(0, 4, 0.005)
    for offset in (0, 25):
        for frequency in F:
            name, wave = f"o{offset}_{frequency:g}", 10 * np.sin(2 * np.pi * frequency * time)
            np.savetxt(folder / f"data/{name}.txt", np.column_stack([time, offset + wave, offset + wave]), fmt="%.5f")
            text += RECORD.format(name=name, offset=offset, frequency=frequency)
    (folder / "data/dataset.toml").write_text(text)
    answered(folder, [stage("prior", (1.0, 3.0)), stage("refit", (0.5, 2.5))], "HydraulicTestBench.Pump.FreeGreyBox")
    return folder


def answered(folder: Path, stages: list[dict[str, Any]], model: str = "") -> None:
    """Make a project of a folder with data, and these stages its only result."""
    from pysim.app.project import Project

    (folder / "results/compare").mkdir(parents=True)
    (folder / "project.toml").write_text(f'model = "{model}"\n')
    time = np.arange(0, 4, 0.005)
    about = np.frombuffer(json.dumps({"form": 3, "stages": stages}).encode(), dtype=np.uint8)
    archive = io.BytesIO()
    np.savez(archive, about=about, t=time, m=10 + 0 * time[:, None], s=10 + 0 * time[:, None])
    (folder / "results/compare/records.npz").write_bytes(archive.getvalue())
    error = [{"step": s["step"], "fit": 2.0, "validate": None, "criteria": {}, "passes": False} for s in stages]
    empty: dict[str, Any] = {key: [] for key in ("added", "ranking", "missing", "confusable", "notes")}
    answer = {**empty, "error": error, "reason": "", "verdict": "none", "next_test": None, "files": {}}
    answer["warnings"] = {"prior": ["not this"], "refit": ["m stopped at its bound", "m stopped at its bound"]}
    (folder / "results/compare/answer.json").write_text(json.dumps(answer))
    job = {"work": {"name": "compare", "title": "Compare", "words": ["compare"], "effects": []}, "state": "done"}
    job |= {"begun": 1.0, "ended": 2.0, "fingerprint": Project(folder).fingerprint(), "message": ""}
    (folder / "results/compare/job.json").write_text(json.dumps(job))


def stage(step: str, decibels: tuple[float, float]) -> dict[str, Any]:
    """A model that is so many dB off above the lowest frequency, at two operating points."""
    names = [f"o{offset}_{f:g}.txt" for offset in (0, 25) for f in F]
    own = {"kind": "frequency-response", "use": "fit", "names": ["y"], "units": ["%"], "noise": [0.1], "frequency": 1.0}
    own |= {"time": "t", "measured": "m", "simulated": "s", "deviations": {}, "rms": [2.0]}
    responses = []
    for offset, off in zip((0.0, 25.0), decibels, strict=True):
        gain = [1.0, 0.8, 0.4]
        simulated = {"gain": [1.0, *(g * 10 ** (off / 20) for g in gain[1:])], "phase": [-0.1, -0.2, -0.5]}
        values = (off, 0.0)
        told = [
            {"symbol": symbol, "name": name, "limit": limit, "unit": unit, "value": value}
            for (symbol, name, limit, unit), value in zip(LIMITS, values, strict=True)
        ]
        one = {"offset": offset, "amplitude": 10.0, "input": "u", "output": "y", "use": "fit", "frequency": F}
        one |= {"measured": {"gain": gain, "phase": [-0.1, -0.2, -0.5]}, "simulated": simulated, "message": ""}
        responses.append({**one, "passes": off <= 2.0, "deviations": told})
    records = [{**own, "index": k, "source": name} for k, name in enumerate(names)]
    return {
        "step": step, "estimates": [], "undetermined": [], "where": [], "records": records, "responses": responses,
    }  # fmt: skip


@pytest.mark.slow
def test_a_bode_plot_stands_in_its_band_and_says_when_it_leaves_it(shown: Shown, show: Show, project: Path) -> None:
    tab = Tab(shown, show(project), artefacts())
    tab.go("Compare")
    tab.see("passes Table 1.3")
    banner = tab.page.get_by_role("alert").inner_text()  # of the last fit alone, and nothing twice
    assert banner.split("\n\n") == ["Do not believe this fit", "m stopped at its bound"]
    curves = lines(tab)
    measured, band, model = curves["measured y"], curves["± 2 dB, ± 35° (Table 1.3) y"], curves["refitted y"]
    assert max(abs(a - b) for a, b in zip(model, measured, strict=True)) == pytest.approx(0.5)
    assert band == pytest.approx([v + 2 for v in measured] + [v - 2 for v in reversed(measured)])
    assert curves["refitted y2"] == pytest.approx(curves["measured y2"])
    tab.see("maximum magnitude deviation 0.5 of 2 dB")
    tab.page.get_by_role("button", name="25 ± 10").press("Enter")
    tab.see("beyond Table 1.3")
    tab.see("maximum magnitude deviation 2.5 of 2 dB")
    curves = lines(tab)
    out = [a - b for a, b in zip(curves["refitted y"], curves["measured y"], strict=True)]
    assert out == pytest.approx([0, 2.5, 2.5])
    tab.page.get_by_text("Frequency responses").scroll_into_view_if_needed()
    tab.shot("bode")
    assert tab.errors == []


def test_only_the_thesis_pump_is_judged_by_its_limits(shown: Shown, show: Show, project: Path) -> None:
    shutil.rmtree(project / "results")
    answered(project, [stage("prior", (1.0, 3.0))])  # of no model of the thesis
    tab = Tab(shown, show(project), artefacts())
    tab.go("Compare")
    tab.see("Frequency responses")
    assert tab.page.locator(".chip", has_text="Table 1.3").count() == 0
    assert tab.page.get_by_text("maximum magnitude deviation").count() == 0
    assert tab.errors == []


TWICE = """[[records]]
file = "both.txt"
columns = ["time", "u", {columns}]
kind = "step"
use = "{use}"
"""


def test_of_a_file_with_two_records_each_has_its_own_curves_and_error(shown: Shown, show: Show, tmp_path: Path) -> None:
    folder, own = tmp_path / "project", stage("refit", (0.5, 2.5))
    (folder / "data").mkdir(parents=True)
    time = np.arange(0, 4, 0.005)
    np.savetxt(folder / "data/both.txt", np.column_stack([time, time > 1, time > 1, time > 1]), fmt="%.3f")
    text = DESCRIPTION + '[signals.z]\nrole = "output"\nunit = "%"\n'
    text += TWICE.format(columns='"y", "-"', use="fit") + TWICE.format(columns='"-", "z"', use="validate")
    (folder / "data/dataset.toml").write_text(text)
    record = {**own["records"][0], "source": "both.txt", "kind": "step", "frequency": None}
    told = (("y", "fit", 2.0), ("z", "validate", 7.0))
    records = [{**record, "index": k, "names": [n], "use": u, "rms": [rms]} for k, (n, u, rms) in enumerate(told)]
    answered(folder, [{**own, "step": step, "records": records, "responses": []} for step in ("prior", "refit")])
    tab = Tab(shown, show(folder), artefacts())
    tab.go("Compare")
    assert opened(tab) == ("used to choose", "z<br>(%)")  # the one that is worse
    rows = tab.page.locator("tr", has_text="both.txt")
    assert [row.split()[1:] for row in rows.all_inner_texts()] == [["fitted", "2.00"], ["used", "to", "choose", "7.00"]]
    assert tab.page.locator("th", has_text="Hz").count() == 0  # none of them is a sine
    rows.nth(0).click()
    tab.page.locator("#record .chip", has_text="fitted").wait_for()
    assert opened(tab) == ("fitted", "y<br>(%)")
    tab.shot("two records")
    tab.pick("Map of the error", 0.75, 0.75)
    tab.page.locator("#record .chip", has_text="used to choose").wait_for()
    assert opened(tab) == ("used to choose", "z<br>(%)")
    assert tab.errors == []


def opened(tab: Tab) -> tuple[str, str]:
    """Use of the record that is shown, and what its first axis says."""
    chart = tab.page.locator("#record .chart[data-ready=yes]")
    chart.wait_for()
    axis = chart.evaluate("(el) => el.layout.yaxis.title.text")
    return tab.page.locator("#record .chip").inner_text(), str(axis)


def lines(tab: Tab) -> dict[str, list[float]]:
    """Name and panel of every line of the Bode plot, and its values."""
    chart = tab.page.locator("[aria-label^='Bode plot'][data-ready=yes]")
    chart.wait_for()
    found = chart.evaluate("(el) => el.data.map((t) => [`${t.name} ${t.yaxis}`, Array.from(t.y)])")
    return dict(found)
