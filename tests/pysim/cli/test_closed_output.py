"""A standard output that is closed, or full: a sentence, and no other file takes its place."""

import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build import build


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device here that is always full")
@pytest.mark.parametrize("redirection", ["> /dev/full", ">&-"])
def test_what_cannot_be_printed_is_said_in_a_line(redirection: str) -> None:
    fmu = build("HydraulicTestBench.Controllers.Gain")
    words = f"{sys.executable} -m pysim simulate {fmu} {redirection}"
    root = Path(__file__).parents[3]
    done = subprocess.run(words, shell=True, capture_output=True, text=True, check=False, cwd=root)
    assert done.returncode == 2
    *_, last = done.stderr.strip().splitlines()
    assert last.startswith("pysim simulate: ")
    assert "Traceback" not in done.stderr
