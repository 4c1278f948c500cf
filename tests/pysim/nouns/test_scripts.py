"""The five scripts of docs/tutorials run as they stand there, and find what their plants have and their models lack."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import pysim
from pysim.nouns.model import opened
from tests.pysim.nouns import script_files
from tests.pysim.nouns.script_files import FRICTION, RIG_TRUE, STRENGTHS, TRUE
from tests.test_docs import ROOT, blocks

LONGEST = 15  # lines of a script that are not blank
LESSONS = ("first_minutes", "own_model", "other_fmu", "controller", "write_effect")
PAGES = [(ROOT / "docs" / "tutorials" / f"{lesson}.md").read_text(encoding="utf-8") for lesson in LESSONS]
SCRIPTS = [source for page in PAGES for words, _, source in blocks(page) if words == "python script"]
Ran = dict[str, Any]


def lines_of(script: str) -> int:
    return sum(bool(line.strip()) for line in script.splitlines())


def test_there_are_five_of_at_most_fifteen_lines() -> None:
    counts = [lines_of(script) for script in SCRIPTS]
    print("lines of the scripts:", counts)
    assert len(counts) == 5
    assert max(counts) <= LONGEST


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Ran]:
    """Runs a script in a folder with its files; gives its names."""

    def ran(number: int, files: Callable[[Path], None] = lambda folder: None) -> Ran:
        monkeypatch.chdir(tmp_path)
        files(tmp_path)
        opened.clear()  # a script has a process to itself
        names: Ran = {"__name__": "__main__"}
        exec(compile(SCRIPTS[number - 1], f"script {number}", "exec"), names)
        plt.close("all")
        return names

    return ran


def errors(*given: Any, use: str = "held out") -> list[float]:
    """Rms over the noise on logs that were never given, model by model, all signals and logs together."""
    rows = [row for row in pysim.compare(*given).table if row["use"] == use]
    models = dict.fromkeys(row["model"] for row in rows)
    return [float(np.sqrt(np.mean([row["x noise"] ** 2 for row in rows if row["model"] == one]))) for one in models]


def inside(interval: tuple[float, float], truth: float) -> bool:
    return interval[0] < truth < interval[1]


@pytest.mark.slow
def test_1_quick_start(run: Callable[..., Ran]) -> None:
    names = run(1)
    why = names["why"]
    assert why.verdict == "valve.deadband"
    (row,) = list(why.effects)
    assert inside((row["95 % from"], row["to"]), 0.02)
    before, after = errors(names["fitted"].model, why.model, names["data"])
    assert before > 1.5
    assert after == pytest.approx(1.0, abs=0.05)
    written = {path.name for path in Path("better").iterdir()}
    assert {"report.html", "parameters.toml", "FreeGreyBoxWithValveDeadband.mo"} <= written


@pytest.mark.slow
def test_2_your_own_model_and_logs(run: Callable[..., Ran]) -> None:
    names = run(2, script_files.with_faults)
    fitted, why = names["fitted"], names["why"]
    assert not fitted.ok
    assert "x lacks 6 samples. They are not compared." in repr(names["pysim"].load(
        "logs/*.csv", time="timestamp", inputs="F", outputs="x", units={"x": "mm"}).check())  # fmt: skip
    assert why.verdict == "axis.friction"
    (row,) = list(why.effects)
    assert row["value"] == pytest.approx(FRICTION, rel=0.03)
    again = pysim.fit(why.model, names["data"], initial="estimate")
    assert again.ok, again.warnings
    assert inside(again.intervals["guideway.F_c"], FRICTION)
    for name, truth in TRUE.items():
        assert inside(again.intervals[name], truth), name
    before, after = errors(fitted.model, why.model, names["data"])
    assert before > 3
    assert after == pytest.approx(1.0, abs=0.1)
    assert next(Path("better").glob("*.fmu")).stat().st_size > 0


@pytest.mark.slow
def test_3_a_data_frame_and_an_fmu_of_another_tool(run: Callable[..., Ran]) -> None:
    names = run(3, script_files.of_another_tool)
    fitted = names["fitted"]
    assert not fitted.ok
    assert fitted.values == pytest.approx(RIG_TRUE, rel=0.05)
    before, after = errors(names["theirs"], fitted.model, names["data"])
    assert after < 0.5 * before
    first = names["missing"][0]
    assert (first.slot, first.argument) == ("u", "der(x)")  # a friction, seen from outside
    assert first.share > 0.9
    assert Path("simulated.csv").read_text().startswith("time [s],x [m]")


def test_4_a_controller_that_is_a_plain_class(run: Callable[..., Ran]) -> None:
    record = run(4, script_files.pump)["run"]
    assert record["pump.alphaPercent"][-1] == pytest.approx(40, abs=0.5)
    assert abs(record["pump.alphaPercent"][:100]).max() < 0.1


@pytest.mark.slow
def test_5_an_effect_of_your_own(run: Callable[..., Ran]) -> None:
    names = run(5, script_files.with_drag)
    missing, better, why = names["missing"], names["better"], names["why"]
    assert missing[0].argument == "guideway.v"
    assert missing[0].share > 0.95
    assert better.ok, better.warnings
    for name, truth in {**TRUE, **{f"guideway.{name}": value for name, value in STRENGTHS.items()}}.items():
        assert inside(better.intervals[name], truth), name
    assert why.verdict == "my.drag"
    before, after = errors(names["axis"], better.model, names["data"])
    assert before > 5
    assert after == pytest.approx(1.0, abs=0.1)
