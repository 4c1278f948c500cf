"""A standard output that is closed, or full: a sentence, every file is written all the same."""

import subprocess
import sys
from pathlib import Path

import pytest

TUNE = f"{sys.executable} -m pysim tune load --json gains.json"


def done(words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    python = f"PYTHONPATH={Path(__file__).parents[3]}"
    return subprocess.run(["sh", "-c", f"{python} {words}"], capture_output=True, text=True, check=False, cwd=folder)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device here that is always full")
@pytest.mark.parametrize("command", [TUNE, f"{sys.executable} -m pysim --help"])
@pytest.mark.parametrize("redirection", ["> /dev/full", ">&-"])
def test_what_cannot_be_printed_is_said_in_a_line(redirection: str, command: str, tmp_path: Path) -> None:
    ended = done(f"{command} {redirection}", tmp_path)
    assert ended.returncode == 2
    (line,) = ended.stderr.strip().splitlines()
    assert line.startswith("pysim: standard output: ")
    assert (tmp_path / "gains.json").exists() == (command is TUNE)
