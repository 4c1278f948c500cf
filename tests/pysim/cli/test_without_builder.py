"""A finished FMU is compared on a machine that can build none: what compiles is blocked."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.pysim.simulate.fixture_fmus import OSCILLATOR, build

ROOT = Path(__file__).parents[3]

DATASET = """[dataset]
name = "oscillator"
description = "closed form"
system = "oscillator"

[signals.u]
role = "input"
unit = "N"
quantity = "force"

[signals.x]
role = "output"
unit = "m"
quantity = "way"

[[records]]
file = "response.csv"
columns = ["frequency_hz", "magnitude_db", "phase_deg"]
kind = "frequency-response-table"
offset = 4.0
amplitude = 1.0
use = "validate"
"""

SCRIPT = """
import sys

BLOCKED = {"rumoca", "casadi", "ziglang"}  # what compiles; our reader of Modelica text needs none of it


class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in BLOCKED:
            raise ImportError(f"{name} is blocked")


sys.meta_path.insert(0, Blocker())
from pysim.cli import main

try:
    import casadi
except ImportError:
    sys.exit(main(sys.argv[1:]))
sys.exit("nothing is blocked")
"""


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """x / u = 1 / (w^2 - omega^2 + 2 i D w omega) with w = 20 rad/s and D = 1, as a measured table."""
    frequency = np.array([0.1, 1.0, 3.0, 6.0])
    g = 1 / (20 + 2j * np.pi * frequency) ** 2
    rows = np.column_stack([frequency, 20 * np.log10(abs(g)), np.degrees(np.unwrap(np.angle(g)))])
    folder = tmp_path / "data"
    folder.mkdir()
    np.savetxt(folder / "response.csv", rows, delimiter=",")
    (folder / "dataset.toml").write_text(DATASET)
    return folder


@pytest.mark.slow  # a process of its own, which imports all anew
def test_compare_needs_nothing_of_the_builder(data: Path, tmp_path: Path) -> None:
    fmu, numbers = build(OSCILLATOR, 2, data), tmp_path / "numbers.json"
    words = ["compare", str(data), "--model", str(fmu), "--set", "w=20", "--set", "D=1", "--json", str(numbers)]
    done = subprocess.run([sys.executable, "-c", SCRIPT, *words], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (test,) = json.loads(numbers.read_text())["parameter_sets"][0]["tests"]
    assert test["passes"] is True
    assert max(test["deviations"].values()) < 0.1
