"""The page in a real browser: what it refuses, what it shows, and that two tabs agree."""

import re
import urllib.error
import urllib.request
import zipfile
from pathlib import Path

import numpy as np
import pytest

from tests.pysim.app.browser import Show, Shown, Tab, artefacts, base

HOSTILE = '<img src=x onerror="alert(1)">'
LONG, SPIKE = 50_000, 12_345  # samples of the long log, and the one of them that stands out


@pytest.fixture
def address(show: Show, tmp_path: Path) -> str:
    """Of a workbench with an empty project, where at most 1 MB may be dropped."""
    return show(tmp_path / "project", size=2**20)


@pytest.fixture
def dropped(tmp_path: Path) -> Path:
    """Two logs, one with a fault in line 6, of a signal that wants to run code."""
    folder = tmp_path / "dropped"
    folder.mkdir()
    short = [f"{k / 10} {k} {k}" for k in range(20)]
    for name in ("first", "good"):
        (folder / f"{name}.txt").write_text("\n".join(short))
    (folder / "bad.txt").write_text("\n".join([*short[:5], "0.5 5 open", *short[6:]]))
    (folder / "dataset.toml").write_text(described("first", "good", "bad"))
    return folder


def described(*names: str) -> str:
    """A data set of these logs."""
    records = "".join(
        f'[[records]]\nfile = "{name}.txt"\ncolumns = ["time", "cmd", {quoted(HOSTILE)}]\nkind = "other"\n'
        for name in names
    )
    signals = f'[signals.cmd]\nrole = "input"\nunit = "%"\n[signals.{quoted(HOSTILE)}]\nrole = "output"\nunit = "bar"\n'
    return f"[dataset]\nname = {quoted(HOSTILE)}\n{signals}{records}"


def quoted(text: str) -> str:
    """As TOML writes it."""
    return '"' + text.replace('"', '\\"') + '"'


def status(url: str, **headers: str) -> int:
    """Of a request without the browser's cookie."""
    try:
        with urllib.request.urlopen(urllib.request.Request(url, headers=headers)) as answer:
            return int(answer.status)
    except urllib.error.HTTPError as error:
        return error.code


def test_nobody_comes_in_without_the_token(address: str) -> None:
    for place in ("/", "/series?of=data&record=0&begin=0&end=1", "/static/app.css", "/_nicegui_ws/socket.io/"):
        assert status(base(address) + place) == 403
    assert status(base(address) + "/?token=guessed") == 403
    assert status(address, Host="evil.example") == 403  # a name of somebody else's that leads here
    assert status(address, Origin="http://evil.example") == 403


def test_what_is_dropped_is_read_refused_with_a_remedy_and_shown_as_text(
    shown: Shown, show: Show, dropped: Path, tmp_path: Path
) -> None:
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.drop("folder", dropped)
    tab.see("1 log was refused")
    tab.see("bad.txt, line 6: 'open' is no number")
    tab.shot("refused")
    assert tab.page.get_by_text(HOSTILE).count() >= 2  # name of the data set, and of the signal
    assert tab.page.locator("img[src=x]").count() == 0
    tab.press("Leave them out")
    tab.see("2 records, 0 not fitted")
    assert tab.errors == []
    assert tab.foreign() == []


def test_two_tabs_agree_and_a_reload_finds_the_same(shown: Shown, show: Show, dropped: Path, tmp_path: Path) -> None:
    (tmp_path / "project").mkdir()
    (tmp_path / "project/project.toml").write_text("")
    (dropped / "dataset.toml").write_text(described("first", "good"))
    dropped.rename(tmp_path / "project/data")
    address = show(tmp_path / "project")
    tab, other = Tab(shown, address), Tab(shown, address)
    other.page.get_by_label("used to choose, good.txt").check()
    tab.see("2 records, 1 not fitted")  # the other tab has followed
    tab.page.reload()
    tab.see("2 records, 1 not fitted")
    assert tab.errors == other.errors == []


def test_a_long_record_is_drawn_with_few_points_and_all_its_spikes(shown: Shown, show: Show, tmp_path: Path) -> None:
    """50,000 samples: every spike is among the points on the screen, and all samples are once zoomed."""
    data = tmp_path / "project/data"
    data.mkdir(parents=True)
    (tmp_path / "project/project.toml").write_text("")
    time = np.arange(LONG) / 1000
    wave = np.sin(time) + (np.arange(LONG) == SPIKE) * 5.0  # a spike of one sample
    np.savetxt(data / "long.txt", np.column_stack([time, wave, wave]), fmt="%.4f")
    (data / "dataset.toml").write_text(described("long"))
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.see("1 record, 0 not fitted")
    tab.go("Compare")
    tab.page.locator("tr", has_text="long.txt").click()
    chart = tab.page.locator("#record .chart[data-ready=yes]")
    chart.wait_for()
    drawn = "(el) => ({n: el.data[0].x.length, high: Math.max(...el.data[0].y)})"
    whole = chart.evaluate(drawn)
    assert whole["n"] < 2000
    assert whole["high"] == pytest.approx(5 + np.sin(SPIKE / 1000), abs=1e-3)
    assert chart.evaluate("(el) => el.layout.yaxis2.title.text").startswith("&lt;img src=x")
    for _ in range(100):  # by keyboard, into the middle
        if chart.get_attribute("data-exact") == "yes":
            break
        chart.press("+")
        tab.page.wait_for_timeout(100)
    assert chart.get_attribute("data-exact") == "yes"
    x = chart.evaluate("(el) => el.data[0].x")
    assert np.diff(x) == pytest.approx(0.001)
    assert tab.page.locator("img[src=x]").count() == 0
    assert tab.errors == []
    tab.shot("long")


def test_it_can_be_used_without_a_mouse(shown: Shown, address: str) -> None:
    tab = Tab(shown, address)
    for _ in range(4):
        tab.page.keyboard.press("Tab")
    names = []
    for _ in range(8):
        names.append(tab.page.evaluate("document.activeElement.innerText"))
        tab.page.keyboard.press("Tab")
    assert any("Compare" in name for name in names), names
    tab.page.get_by_role("link", name=re.compile("Candidates")).focus()
    tab.page.keyboard.press("Enter")
    tab.page.wait_for_url("**/candidates")
    assert tab.errors == []


WIDE = """() => {
    const page = document.querySelector("#page"), right = page.getBoundingClientRect().right + 1;
    const scrolls = (e) => ["auto", "scroll", "hidden"].includes(getComputedStyle(e).overflowX);
    const inside = (e) => e.parentElement !== page && (scrolls(e.parentElement) || inside(e.parentElement));
    const out = (e) => e.getBoundingClientRect().width && e.getBoundingClientRect().right > right && !inside(e);
    return [...page.querySelectorAll(".page *")].filter(out).map((e) => `${e.tagName} ${e.textContent.slice(0, 40)}`);
}"""
PATHS = ("/", "/model", "/compare", "/locate", "/candidates", "/add", "/take")


@pytest.mark.parametrize("width", [420, 800, 1440])
def test_nothing_sticks_out_and_what_reads_aloud_knows_the_page(width: int, shown: Shown, address: str) -> None:
    tab = Tab(shown, address)
    tab.page.set_viewport_size({"width": width, "height": 800})
    for path in PATHS:
        tab.page.locator(f".rail a[href='{path}']").click()
        tab.page.wait_for_selector(f".rail a[href='{path}'][aria-current=page]")
        assert tab.page.evaluate(WIDE) == [], path
        assert tab.page.evaluate("document.documentElement.lang") == "en"
        assert tab.page.locator("main").count() == 1
        cut = "(all) => all.filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.textContent)"
        assert tab.page.locator(".what b").evaluate_all(cut) == []
        unnamed = "input:not([aria-label]):not([id]), select:not([aria-label])"
        assert tab.page.locator(unnamed).count() == 0
    assert tab.errors == []


def test_light_and_dark_follow_the_system_and_the_choice(shown: Shown, address: str) -> None:
    dark = Tab(shown, address, color_scheme="dark")
    paper = "getComputedStyle(document.body).backgroundColor"
    assert dark.page.evaluate(paper) == "rgb(15, 21, 27)"
    dark.page.get_by_title(re.compile("Look: auto")).click()
    dark.page.wait_for_function(f"{paper} === 'rgb(245, 247, 249)'")
    dark.page.get_by_title(re.compile("Look: light")).click()
    dark.page.wait_for_function(f"{paper} === 'rgb(15, 21, 27)'")
    dark.page.get_by_title(re.compile("Look: dark")).click()
    dark.page.get_by_title(re.compile("Look: auto")).wait_for()


def test_a_data_set_that_another_took_the_place_of_is_brought_back(
    shown: Shown, show: Show, dropped: Path, tmp_path: Path
) -> None:
    (dropped / "dataset.toml").write_text(described("first", "good"))
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.drop("folder", dropped)
    tab.see("2 records, 0 not fitted")
    before = {path.name: path.read_bytes() for path in (tmp_path / "project/data").iterdir()}
    (dropped / "dataset.toml").write_text(described("first"))
    tab.drop("folder", dropped)
    tab.see("This data set takes the place of the one that is there")
    tab.shot("replace")
    tab.press("Keep the one that is there")
    tab.see("Drop a data set here")
    assert {path.name: path.read_bytes() for path in (tmp_path / "project/data").iterdir()} == before
    tab.drop("folder", dropped)
    tab.press("Replace it")
    tab.see("1 record, 0 not fitted")
    tab.press("Bring back data-1")
    tab.see("2 records, 0 not fitted")
    assert {path.name: path.read_bytes() for path in (tmp_path / "project/data").iterdir()} == before
    tab.shot("earlier")
    tab.press("Bring back data-2")  # and forth
    tab.see("1 record, 0 not fitted")
    assert tab.errors == []


def test_a_wrong_file_is_refused_in_a_sentence(shown: Shown, address: str, tmp_path: Path) -> None:
    (tmp_path / "picture.jpg").write_bytes(b"\xff\xd8")
    tab = Tab(shown, address, artefacts())
    tab.drop("files", tmp_path / "picture.jpg")
    tab.see("no data set, no logs and no model in this: .jpg; drop logs as .txt")
    for height in (800, 480):  # however low the window: the way to another page, and what runs, stay free
        tab.page.set_viewport_size({"width": 1280, "height": height})
        toast, rail = (tab.page.locator(one).bounding_box() for one in (".q-notification", ".rail"))
        assert rail["x"] + rail["width"] <= toast["x"]
        assert toast["y"] > 56
    tab.shot("toast")
    with zipfile.ZipFile(tmp_path / "sly.zip", "w") as archive:
        archive.writestr("../../outside.txt", "0 1 2")
    tab.drop("files", tmp_path / "sly.zip")
    tab.see("is no name of a file below the dropped folder")
    errors = tab.page.locator(".q-notification")
    tab.until(lambda: errors.count() == 1)  # the one before is of an earlier drop
    tab.press("? Help")
    tab.until(lambda: errors.count() == 0)


def test_2_mb_are_too_many_for_this_page_and_for_its_server(shown: Shown, address: str, tmp_path: Path) -> None:
    (tmp_path / "big.txt").write_bytes(bytes(2 * 2**20))
    tab = Tab(shown, address)
    tab.drop("files", tmp_path / "big.txt")
    tab.see("2 MB in 1 files are too much; drop at most 1 MB")
    script = """async () => {
        const name = await (await fetch("/upload", { method: "POST" })).text();
        const body = new Blob([new Uint8Array(1.2 * 2 ** 20)]);
        const answer = await fetch(`/upload/${name}?name=big.txt`, { method: "PUT", body });
        return [answer.status, await answer.text()];
    }"""
    code, words = tab.page.evaluate(script)  # who does not ask the page first
    assert (code, "goes beyond the limit; drop at most 1 MB" in words) == (422, True)
