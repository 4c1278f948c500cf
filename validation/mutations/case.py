"""Faults planted in the formulas of the thesis, one at a time: a test notices each."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from validation.findings import Finding

_ROOT = Path(__file__).parents[2]


def run() -> Iterator[Finding]:
    """A claim per fault, with the test that noticed it."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "faults.jsonl"
        words = [sys.executable, "-m", "tests.mutations", "--thesis", "--json", str(file)]
        done = subprocess.run(words, cwd=_ROOT, capture_output=True, text=True, check=False)
        if not file.is_file():
            raise RuntimeError(f"no fault was planted: {' '.join(done.stderr.split())[-300:]}")
        lines = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
    for line in lines:
        yield Finding(
            f"{line['about']}: {line['test'] or 'no test notices it'}",
            float(not line["test"]),
            0.0,
            "faults",
            alternative="1: the formula could be wrong and every test would pass",
            source="each fault changes a result of the thesis",
        )
