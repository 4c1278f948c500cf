"""Logs that nobody has described, in a real browser: the form is filled in, and the data set is there."""

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.io import read_dataset
from pysim.types import Record
from tests.pysim.app.browser import Show, Shown, Tab, artefacts
from tests.toy import CATALOGUE, TEXT

TIME = np.arange(0, 8, 0.005)


@pytest.fixture
def logs(tmp_path: Path) -> list[Path]:
    """Three, with a heading that has units, and a column nobody needs."""
    paths = [tmp_path / f"run{k}.csv" for k in (1, 2, 3)]
    for k, path in enumerate(paths, 1):
        wave = np.sin(k * TIME)
        rows = np.column_stack([TIME, 2 * wave, 1000 * wave, TIME * 0])
        np.savetxt(path, rows, fmt="%.5f", delimiter=",", header="t [s],F [N],x [mm],spare", comments="")
    return paths


def test_single_logs_are_described_on_the_page(shown: Shown, show: Show, logs: list[Path], tmp_path: Path) -> None:
    folder = tmp_path / "project"
    (tmp_path / "Toy.mo").write_text(TEXT)
    tab = Tab(shown, show(folder), artefacts())
    tab.drop("files", *logs)
    tab.see("3 logs, 4 columns, as run1.csv has them")
    assert tab.page.get_by_label("unit of column 3").input_value() == "mm"
    tab.page.get_by_label("noise of column 3").fill("0.5")
    tab.page.get_by_label("noise of column 3").press("Tab")
    tab.drop("files", tmp_path / "Toy.mo")  # the page changes meanwhile
    tab.see("Libraries of yours: model/Toy.mo")
    tab.page.get_by_label("Modelica class").fill("Toy.Mass")
    tab.press("Use this model")
    tab.see(f"{len(CATALOGUE)} effects that fit", timeout=300)
    tab.page.wait_for_function("document.querySelector('[aria-label=\"variable of column 3\"]')?.value === 'x'")
    assert tab.page.get_by_label("noise of column 3").input_value() == "0.5"  # what was filled in stays
    tab.shot("bare")
    tab.press("Use these logs")
    tab.see("spare: choose a unit, or a dash to leave the column out")
    tab.page.get_by_label("role of column 4").select_option("-")
    tab.press("Use these logs")
    tab.see("3 records, 1 not fitted")
    found = tomllib.loads((folder / "data/dataset.toml").read_text())
    assert found["signals"] == {
        "F": {"role": "input", "unit": "N", "quantity": "F"},
        "x": {"role": "output", "unit": "mm", "quantity": "x", "noise": 0.5},
    }  # fmt: skip
    assert [(r["file"], r["use"]) for r in found["records"]] == [
        ("run1.csv", "fit"), ("run2.csv", "fit"), ("run3.csv", "validate"),
    ]  # fmt: skip
    assert found["records"][0]["columns"] == ["time", "F", "x"]
    assert (folder / "earlier/data-1/run1.csv").read_bytes() == logs[0].read_bytes()  # as it was dropped
    tab.see("Ready to compare")
    tab.page.get_by_label("F between samples").select_option("straight lines")
    tab.until(lambda: tomllib.loads((folder / "data/dataset.toml").read_text())["signals"]["F"].get("hold") == "linear")
    tab.page.get_by_label("held out, run1.csv").check()
    tab.see("3 records, 2 not fitted")
    more = tmp_path / "run4.csv"
    more.write_bytes(logs[0].read_bytes())
    tab.drop("files", logs[1], more)
    tab.see("4 records, 2 not fitted")
    records = tomllib.loads((folder / "data/dataset.toml").read_text())["records"]
    uses = {"run1.csv": "test", "run2.csv": "fit", "run3.csv": "validate", "run4.csv": "fit"}
    assert {record["file"]: record["use"] for record in records} == uses
    tab.press("Put this data set aside")
    tab.see("Bring back data-3")
    assert not (folder / "data").exists()
    assert tab.errors == []


@pytest.mark.slow
def test_stepped_sines_are_known_by_their_names(shown: Shown, show: Show, tmp_path: Path) -> None:
    for frequency in (1, 2):
        wave = 25 + 10 * np.sin(2 * np.pi * frequency * TIME)
        np.savetxt(tmp_path / f"{frequency}Hz.txt", np.column_stack([TIME, wave, wave]), fmt="%.5f")
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.drop("files", tmp_path / "1Hz.txt", tmp_path / "2Hz.txt")
    tab.see("2 logs, 3 columns")
    assert tab.page.get_by_label("kind of the logs").input_value() == "frequency-response"
    for number, name in ((2, "command"), (3, "angle")):
        tab.page.get_by_label(f"name of column {number}").fill(name)
        tab.page.get_by_label(f"unit of column {number}").select_option("%")
    tab.press("Use these logs")
    tab.see("2 records, 0 not fitted")
    records = tomllib.loads((tmp_path / "project/data/dataset.toml").read_text())["records"]
    assert [(r["offset"], r["amplitude"], r["frequency"]) for r in records] == [(25, 10, 1), (25, 10, 2)]
    assert tab.errors == []


@pytest.mark.slow
def test_times_in_ms_are_told(shown: Shown, show: Show, tmp_path: Path) -> None:
    np.savetxt(
        tmp_path / "a.txt", np.column_stack([1000 * TIME, TIME, TIME]), header="t (ms) u (V) y (bar)", fmt="%.4f"
    )
    text = (tmp_path / "a.txt").read_text().removeprefix("# ").replace(" (", "(")
    (tmp_path / "a.txt").write_text(text)
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.drop("files", tmp_path / "a.txt")
    tab.see("1 log, 3 columns")
    units = [tab.page.get_by_label(f"unit of column {k}").input_value() for k in (1, 2, 3)]
    assert units == ["ms", "V", "bar"]
    tab.press("Use these logs")
    tab.see("1 record, 0 not fitted")
    assert tab.page.locator("td.number", has_text="7.995").count() == 1  # s, not 7995
    assert tab.errors == []


def test_dates_volts_an_empty_cell_and_a_turned_sign_are_made_ready_by_clicks_alone(
    shown: Shown, show: Show, tmp_path: Path
) -> None:
    """A logger's file: moments in place of seconds, decimal commas, a sensor in V that was wired the wrong way."""
    wave, rows = np.sin(TIME[:400]), []
    for k, (force, volt) in enumerate(zip(2 * wave, 5 - 40 * wave, strict=True)):
        told = "" if k == 200 else f"{force:.4f}"
        rows.append(f"2026-03-01 10:00:{k / 100:06.3f};{told};{volt:.4f}".replace(".", ","))
    (tmp_path / "bench.csv").write_text("\n".join(["Zeitstempel;F [N];x", *rows, ""]))
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.drop("files", tmp_path / "bench.csv")
    tab.see("1 log, 3 columns")
    assert tab.page.get_by_label("role of column 1").input_value() == "time"
    tab.page.get_by_label("unit of column 3").select_option("V")
    tab.shot("dates")
    tab.press("Use these logs")
    tab.see("1 record, 0 not fitted")
    tab.see("Next: fill the cells that are empty, or cut them out on the page Prepare.")
    for key, value in (("unit", "mm"), ("factor", "-25"), ("offset", "125")):
        field = tab.page.get_by_label(f"{key} of x")
        field.select_option(value) if key == "unit" else (field.fill(value), field.press("Tab"))
        tab.until(
            lambda key=key, value=value: str(described(tmp_path)["signals"]["x"].get(key)).removesuffix(".0") == value
        )
    tab.shot("volts")
    tab.go("Prepare")
    tab.see("F lacks 1 sample")
    tab.page.get_by_role("button", name="fill_gaps").first.click()
    tab.see("✓ ready")
    log = read_dataset(tmp_path / "project/data").logs()[0].data
    assert isinstance(log, Record)
    assert np.diff(log.time) == pytest.approx(0.01)
    assert log["x"] == pytest.approx(wave, abs=1e-4)  # m
    assert tab.errors == []


def described(folder: Path) -> dict[str, Any]:
    return tomllib.loads((folder / "project/data/dataset.toml").read_text())


def test_a_log_without_numbers_is_refused_in_a_sentence(shown: Shown, show: Show, tmp_path: Path) -> None:
    (tmp_path / "words.txt").write_text("no numbers\nat all\n")
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.drop("files", tmp_path / "words.txt")
    tab.see("words.txt holds no rows of numbers")
    assert tab.errors == []
