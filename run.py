"""Set up an environment of its own beside this file, then run a command in it: `python3 run.py demo` or `... test`.

Needs Python 3.11 or later and nothing else; the first run downloads the packages pyproject.toml names, later runs need
no network. What follows the command is passed on to it.
"""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent
ENVIRONMENT = ROOT / ".venv"
PYTHON = ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
STAMP = ENVIRONMENT / "installed.sha256"
COMMANDS = {
    "demo": ["-m", "pysim", "demo"],
    "pysim": ["-m", "pysim"],
    "fmu-build": ["-m", "fmu_build"],
    "validate": ["-m", "pysim", "validate"],
}
CHECKS = {  # run beside this file; the others where they were called
    "test": ["-m", "pytest"],
    "lint": ["-m", "ruff", "check"],
    "types": ["-m", "mypy"],
}


def fingerprint() -> str:
    """What the installed environment depends on: this Python, this place, and the packages asked for."""
    parts = (sys.version, str(ROOT), (ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


def prepare() -> None:
    """Create or refresh the environment where pyproject.toml has changed since the last time."""
    expected = fingerprint()
    if PYTHON.exists() and STAMP.exists() and STAMP.read_text() == expected:
        return
    print(f"Setting up {ENVIRONMENT} (once, a minute or two) ...", file=sys.stderr, flush=True)
    try:
        subprocess.run([sys.executable, "-m", "venv", "--clear", str(ENVIRONMENT)], check=True)
        pip = [str(PYTHON), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
        subprocess.run([*pip, "--editable", f"{ROOT}[test,lint]"], check=True)
    except subprocess.CalledProcessError as error:
        if "venv" in error.cmd:
            sys.exit("run.py: could not create the environment; on Debian and Ubuntu: apt install python3-venv.")
        sys.exit("run.py: could not install the packages, see the messages above; is the package index reachable?")
    STAMP.write_text(expected)


def main() -> int:
    if sys.version_info < (3, 11):  # noqa: UP036 - this file meets the system's Python before any package does
        sys.exit(f"run.py: needs Python 3.11 or later, this is {sys.version.split()[0]}.")
    known = COMMANDS | CHECKS
    if len(sys.argv) < 2 or sys.argv[1] not in known:
        sys.exit(f"usage: python3 run.py {{{','.join(known)}}} [arguments]\n\n{__doc__}")
    prepare()
    folder = ROOT if sys.argv[1] in CHECKS else None
    return subprocess.run([str(PYTHON), *known[sys.argv[1]], *sys.argv[2:]], cwd=folder).returncode


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
