"""The demo from data set to report, with Table 4.1's own transfer functions in place of the FMUs."""

import json
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.cli import main
from pysim.identify import TransferFunction
from pysim.present import Drawing
from pysim.thesis import printed_table
from pysim.types import Comparison, Experiment, Model, Record
from tests.pysim import comparisons as linear
from tests.pysim.cli.ran import refused

SIGNALS = (
    linear.variable("alphaCMD", "input", "%"),
    linear.variable("alphaCMD_t", "input", "%/s"),
    linear.variable("alphaPercent", "output", "%"),
)


@cache
def functions() -> dict[tuple[float, float], TransferFunction]:
    """Table 4.1 by offset and amplitude."""
    found = {}
    for row in printed_table("4.1"):
        b0, a4, a3, a2, a1, a0 = (float(row[k]) for k in ("b0_1e6", "a4", "a3", "a2_1e3", "a1_1e6", "a0_1e6"))
        function = TransferFunction((b0 * 1e6,), (1.0, a4, a3, a2 * 1e3, a1 * 1e6, a0 * 1e6))
        found[float(row["offset_percent"]), float(row["amplitude_percent"])] = function
    return found


def from_the_table(experiment: Experiment, lag: float) -> Record:
    """The steady output of the tested point's transfer function, `lag` seconds late."""
    signal = experiment.inputs["alphaCMD"]
    amplitude, _, omega, _ = signal.sines[-1, 0]
    offset = signal.cubics[-1, 0]
    g = functions()[offset, amplitude].at(np.array([omega / 2 / np.pi]))[0]
    y = offset + amplitude * abs(g) * np.sin(omega * (experiment.times - 2.0 - lag) + np.angle(g))
    return Record(experiment.times, y[:, None], ("alphaPercent",), ("%",), origin="simulated")


@pytest.fixture
def demo(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """The free set repeats the table; the locked set is 2 ms late."""

    def pump_model(label: str, *, output: Path) -> Model:
        output.write_bytes(b"")
        return replace(linear.model(), name=label, path=output, variables=SIGNALS)

    def simulate_many(model: Model, experiments: Sequence[Experiment], **_: Any) -> list[Record]:
        return [from_the_table(experiment, 2e-3 * (model.name == "locked")) for experiment in experiments]

    def in_this_process(count: int) -> ThreadPoolExecutor:
        """In place of two processes, which would know nothing of the stand-ins."""
        return ThreadPoolExecutor(1)

    def draw_picture(comparisons: Sequence[Comparison], folder: Path, name: str) -> Drawing:
        (folder / f"{name}.png").write_bytes(b"drawn where compare is tested")
        return Drawing(name, name, b"<svg/>")

    monkeypatch.setattr("pysim.identify.greybox.helper_processes", in_this_process)
    monkeypatch.setattr("pysim.cli.commands.demo.draw_picture", draw_picture)
    monkeypatch.setattr("pysim.thesis.pump_model", pump_model)
    monkeypatch.setattr(import_module("pysim.identify.response_comparison"), "simulate_many", simulate_many)
    return tmp_path / "results" / "demo"


def test_demo_leaves_everything_behind(demo: Path) -> None:
    assert main(["demo", "--output", str(demo)]) == 0
    names = {path.name for path in demo.iterdir()}
    assert {"report.html", "comparison.json", "deviations.png", "measurements", "FreeGreyBox.fmu"} <= names
    assert sum(name.startswith("bode_O") for name in names) == 6
    free, locked = json.loads((demo / "comparison.json").read_text(encoding="utf-8"))["parameter_sets"]
    assert max(test["deviations"]["max_magnitude_db"] for test in free["tests"]) < 1e-6
    frequencies = np.array(free["tests"][0]["frequency_hz"])
    assert locked["tests"][0]["deviations"]["mean_phase_deg"] == pytest.approx(0.72 * frequencies.mean())


def test_quick_takes_fewer_frequencies(demo: Path) -> None:
    assert main(["demo", "--quick", "--output", str(demo)]) == 0
    data = json.loads((demo / "comparison.json").read_text(encoding="utf-8"))
    assert len(data["parameter_sets"][0]["tests"][0]["frequency_hz"]) == 8


def test_a_place_that_cannot_be_written_to_is_known_at_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "file").write_text("")
    refused(["demo", "--output", str(tmp_path / "file")], capsys, "--output", "choose another folder")
