"""Run the tests that are marked slow, which the test command leaves out."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from validation.findings import Finding

_ROOT = Path(__file__).parents[2]
_CLAIM = "slow tests: pytest's exit code"


def run() -> Iterator[Finding]:
    """One finding; skipped where the tests are not beside the package."""
    if not (_ROOT / "tests").is_dir():
        yield Finding(_CLAIM, float("nan"), 0, "", "the tests are not installed; run this from a clone")
        return
    done = subprocess.run([sys.executable, "-m", "pytest", "-m", "slow"], cwd=_ROOT, capture_output=True, text=True)
    if done.returncode:
        print(done.stdout)
    yield Finding(f"{_CLAIM} ({done.stdout.strip().splitlines()[-1]})", done.returncode, 0, "")
