"""`pysim report-bug`."""

from __future__ import annotations

import locale
import os
import platform
import re
import sys
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

from pysim.cli.command import DONE, Command, Given

_OURS = ("HTB_CACHE", "OPENMODELICAHOME", "MODELICAPATH", "PYTHONUTF8")
_TO_FILL_IN = """
What I typed, or the lines of Python:

What came out, with all lines of an error (they name folders: shorten them as you like):

What I expected:
"""


def run(given: Given) -> int:
    """Print what somebody needs who is to find the fault: no path, no name of a user, a computer, a model or a file."""
    print("\n".join(report()))
    print(_TO_FILL_IN)
    print("Nothing was sent. Look through these lines, fill in the three, and hand them on.", file=sys.stderr)
    return DONE


def report() -> Iterator[str]:
    """Version, system, settings by their names, and packages, a line each."""
    from fmu_build.version import version

    clone = Path(__file__).resolve().parents[3]
    kept = "a clone" if (clone / ".git").exists() else "sources" if (clone / "pyproject.toml").exists() else "a wheel"
    yield f"pysim {version()}, from {kept}"
    yield f"system: {platform.platform()}, {platform.machine()}, {os.cpu_count()} processors"
    own = "an environment of its own" if sys.prefix != sys.base_prefix else "the system's"
    bits = sys.maxsize.bit_length() + 1
    yield f"Python: {platform.python_implementation()} {platform.python_version()}, {bits} bit, {own}"
    terminal = "a terminal" if sys.stdout.isatty() else "no terminal"
    yield f"output: {terminal}, {sys.stdout.encoding}; files: {locale.getpreferredencoding(False)}"
    yield f"set in the environment: {', '.join(name for name in _OURS if os.environ.get(name)) or 'nothing of ours'}"
    yield f"solver: {_solver()}"
    yield from packages()


def packages() -> Iterator[str]:
    """Those that this program can use, with their versions."""
    from fmu_build.version import DISTRIBUTION

    try:
        said = metadata.requires(DISTRIBUTION) or []
    except metadata.PackageNotFoundError:
        yield "packages: not known, since this program is not installed"
        return
    names = sorted({re.split(r"[^\w.-]", one, maxsplit=1)[0].lower() for one in said} - {DISTRIBUTION})
    found = {name: _version_of(name) for name in ("pip", *names)}
    yield f"packages: {', '.join(f'{name} {there}' for name, there in found.items() if there)}"
    yield f"not installed: {', '.join(name for name, there in found.items() if not there) or 'none of the extras'}"


def _solver() -> str:
    """Without the message of a folder that cannot be used, which would name it."""
    from pysim.simulate import kernel_is_built
    from pysim.types import BadInput

    try:
        return "compiled" if kernel_is_built() else "not compiled yet"
    except BadInput:
        return "cannot be kept, or not built for this system"


def _version_of(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return ""


COMMAND = Command(
    "report-bug",
    "Print what a report of a fault needs: versions and system, no path and no name of yours.",
    run,
)
