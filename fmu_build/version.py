"""Which version of this program runs: from git's tag and commit in a clone, from the metadata where it is installed.

The build reads it from here too, so this file imports nothing but the standard library.
"""

import re
import subprocess
from functools import cache
from importlib import metadata
from pathlib import Path

DISTRIBUTION = "hydraulic-test-bench"
RELEASE = "0.1.0"  # where no tag says another
_ROOT = Path(__file__).resolve().parents[1]
_DIGITS = 12  # of a commit
_RECORDS = (":!*.md", ":!validation/recorded.jsonl")  # what validation writes about a commit changes nothing of it
_DESCRIBED = re.compile(r"v(?P<tag>\d[\w.]*?)-(?P<count>\d+)-g(?P<commit>[0-9a-f]+)")


@cache
def version() -> str:
    """Such as 0.2.0 at a tag, 0.2.0.post3+g1a2b3c4d5e6f three commits later, with .dirty behind changes of your own."""
    if (_ROOT / ".git").exists() and (commit := this_commit()):
        described = _git("describe", "--tags", "--long", "--match", "v[0-9]*", f"--abbrev={_DIGITS}")
        return _of_tag(described, commit) or f"{RELEASE}.dev0+g{commit.replace('-', '.')}"
    if (_ROOT / "PKG-INFO").is_file():  # the unpacked archive of sources
        head = (_ROOT / "PKG-INFO").read_text(encoding="utf-8")
        return re.findall(r"^Version: (.+)$", head, re.MULTILINE)[0].strip()
    if (_ROOT / "pyproject.toml").is_file():  # a copy without git
        return f"{RELEASE}.dev0"
    try:
        return metadata.version(DISTRIBUTION)
    except metadata.PackageNotFoundError:
        return f"{RELEASE}.dev0"


def this_commit() -> str:
    """The first twelve digits of the commit, "-dirty" behind them where code or data differ from it; "" where this is
    no clone."""
    top = _git("rev-parse", "--show-toplevel")
    if not top or Path(top).resolve() != _ROOT:
        return ""
    commit = _git("rev-parse", f"--short={_DIGITS}", "HEAD")
    return f"{commit}-dirty" if _git("status", "--porcelain", "--", ".", *_RECORDS) else commit


def _of_tag(described: str, commit: str) -> str:
    """What git says of the nearest tag as PEP 440 writes it; "" where there is no tag of a version."""
    found = _DESCRIBED.fullmatch(described)
    if found is None:
        return ""
    dirty = commit.endswith("-dirty")
    if found["count"] == "0" and not dirty:
        return found["tag"]
    return f"{found['tag']}.post{found['count']}+g{commit.replace('-', '.')}"


def _git(*words: str) -> str:
    """What git answers; "" where it fails or is not there."""
    try:
        done = subprocess.run(["git", *words], cwd=_ROOT, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return done.stdout.strip()
