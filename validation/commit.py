"""Which commit of this checkout makes a result."""

from __future__ import annotations

import subprocess
from pathlib import Path

_ROOT = Path(__file__).parents[1]
_DIGITS = 12
_NO_CODE = (":!*.md", ":!validation/recorded.jsonl")  # what a record writes


def this_commit() -> str:
    """The first twelve digits of the commit, "-dirty" behind them where code or data differ from it; "" where this is
    no checkout of git."""
    if _git("rev-parse", "--show-toplevel") != str(_ROOT):
        return ""
    commit = _git("rev-parse", f"--short={_DIGITS}", "HEAD")
    return f"{commit}-dirty" if _git("status", "--porcelain", "--", ".", *_NO_CODE) else commit


def _git(*words: str) -> str:
    """What git answers; "" where it fails or is not there."""
    try:
        done = subprocess.run(["git", *words], cwd=_ROOT, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return done.stdout.strip()
