"""The script that sets up the environment: what it says when it cannot go on."""

import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).parents[1] / "run.py"


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), *arguments], capture_output=True, text=True)


def test_without_a_command_it_lists_them() -> None:
    result = run()
    assert result.returncode == 1
    assert "usage: python3 run.py {demo," in result.stderr


def test_unknown_command_is_refused_before_anything_is_set_up(tmp_path: Path) -> None:
    copy = tmp_path / "run.py"
    copy.write_text(SCRIPT.read_text(encoding="utf-8"), encoding="utf-8")
    result = subprocess.run([sys.executable, str(copy), "dance"], capture_output=True, text=True)
    assert result.returncode == 1
    assert not (tmp_path / ".venv").exists()
