"""`pysim friction` on a folder of logs made from Table 6.2."""

import json
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.io import write_dataset
from pysim.present.report import MARKER
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record
from tests.pysim.cli.ran import refused
from tests.pysim.identify.friction.shafts import INERTIA, TRUTH, measured, simulated

GAIN = 9.5493e-6  # m3/rad
WORDS = ["--speed", "omega_s", "--supply", "p_s", "--supply-gain", str(GAIN), "--inertia", str(INERTIA)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The swing's log, torque as the pressure of a motor, with a load pressure on top of both."""
    test = measured(simulated(), 1)
    load = 20e5 + 5e5 * np.sin(test.time)
    values = np.column_stack([test.torque / GAIN + load, load, test.speed])
    signals = (
        MeasuredSignal("p_s", "input", "Pa", "supply pressure", "p_s"),
        MeasuredSignal("p_L", "input", "Pa", "load pressure", "p_L"),
        MeasuredSignal("omega_s", "output", "rad/s", "speed", "omega_s"),
    )
    record = Record(test.time, values, ("p_s", "p_L", "omega_s"), ("Pa", "Pa", "rad/s"))
    dataset = Dataset("shaft", "slow swing", "shaft", signals, (MeasuredRecord("swing.txt", "other", "fit", record),))
    path = tmp_path_factory.mktemp("shaft") / "data"
    write_dataset(path, dataset)
    return str(path)


def test_finds_table_6_2_and_writes_everything(folder: str, tmp_path: Path) -> None:
    out, numbers = tmp_path / "out", tmp_path / "friction.json"
    words = ["--load", "p_L", "--load-gain", str(GAIN), "--json", str(numbers), "--output", str(out)]
    assert main(["friction", folder, *WORDS, *words]) == 0
    data = json.loads(numbers.read_text())
    for i, name in enumerate(("omega_0", "tau_c", "tau_s"), start=1):
        low, high = data["parameters"][name]["interval"]
        assert low - (high - low) < TRUTH[i] < high + (high - low)
        assert high - low < 0.05 * high
    assert data["parameters"]["r"]["bounded_only"]
    assert data["parameters"]["r"]["interval"][1] is None
    assert data["by_filter"]["objective"] == "thesis Eq. 6.1"
    assert {path.name for path in out.iterdir()} == {"friction.png", "friction.svg", "report.html", MARKER}
    assert (out / "report.html").read_text().count("data:image/svg+xml") == 1


def test_without_the_load_the_friction_is_another(folder: str, tmp_path: Path) -> None:
    """It is seen that --load counts: the swing of the load pressure is left in the torque."""
    numbers = tmp_path / "friction.json"
    assert main(["friction", folder, *WORDS, "--json", str(numbers)]) == 0
    assert json.loads(numbers.read_text())["residual_rms"] > 3


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--inertia", "nan"], ["--inertia nan", "0 or above"]),
        (["--speed", "nothing"], ["no signal 'nothing'"]),
        (["--supply-gain", "1"], ["is a pressure"]),
        (["--supply-gain", "nan"], ["--supply-gain nan", "torque per pressure"]),
        (["--load-gain", "2e-6"], ["--load-gain", "--load"]),
        (["--cutoff-hz", "0"], ["--cutoff-hz", "positive number"]),
        (["--cutoff-hz", "600"], ["cutoff of 600 Hz", "lower the cutoff"]),
        (["--pulses", "few"], ["'few' is no number of pulses", "or none"]),
    ],
)
def test_mistakes_are_one_line(
    folder: str, words: list[str], named: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    refused(["friction", folder, *WORDS, *words], capsys, *named)
