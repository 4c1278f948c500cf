"""Set up an environment of its own beside this file, then run a command in it: `python3 run.py demo` or `... test`.

Needs Python 3.11 or later and nothing else; the first run downloads the packages pyproject.toml names, later runs need
no network. Packages in a folder wheels/ beside this file are taken from there. What follows the command is passed on to
it; `python3 run.py python FILE.py` runs a program of your own in the environment.
"""

import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent
ENVIRONMENT = ROOT / ".venv"
PYTHON = ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
STAMP = ENVIRONMENT / "installed.sha256"
BEFORE = ROOT / "build" / "environment-before"  # what .venv was, until its successor is complete
WHEELS = ROOT / "wheels"
COMMANDS = {
    "demo": ["-m", "pysim", "demo"],
    "pysim": ["-m", "pysim"],
    "fmu-build": ["-m", "fmu_build"],
    "validate": ["-m", "pysim", "validate"],
    "python": [],
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
    """Create or refresh the environment where pyproject.toml has changed since the last time.

    An environment cannot be moved: its scripts hold its path. So the one of before is set aside, and comes back to its
    own place where the new one cannot be completed.
    """
    expected = fingerprint()
    recover()
    if PYTHON.exists() and STAMP.exists() and STAMP.read_text() == expected:
        return
    print(f"Setting up {ENVIRONMENT} (once, a minute or two) ...", file=sys.stderr, flush=True)
    try:
        set_aside()
        install()
        STAMP.write_text(expected)
    except (subprocess.CalledProcessError, OSError) as error:
        recover()
        if not usable():
            sys.exit(reason(error))
        print(f"{reason(error)}\nrun.py: going on with the environment of before.", file=sys.stderr, flush=True)
    except BaseException:  # Ctrl-C
        recover()
        raise
    else:
        recover()


def set_aside() -> None:
    """Free the place of the environment; on Windows that fails while a program of it runs."""
    if ENVIRONMENT.exists():
        BEFORE.parent.mkdir(exist_ok=True)
        ENVIRONMENT.rename(BEFORE)


def recover() -> None:
    """Take away what was set aside where its successor is complete; else put it back, even after a kill."""
    if not BEFORE.exists():
        return
    if STAMP.exists():
        shutil.rmtree(BEFORE, ignore_errors=True)  # what a running program holds goes the next time
        return
    if ENVIRONMENT.exists():
        shutil.rmtree(ENVIRONMENT)
    BEFORE.rename(ENVIRONMENT)


def install() -> None:
    """A new environment with all packages: from wheels/ where that holds them all, else with the index."""
    inside = Path(sys.prefix).resolve() == ENVIRONMENT.resolve()  # this very program runs in what was set aside
    python = getattr(sys, "_base_executable", sys.executable) if inside else sys.executable
    subprocess.run([python, "-m", "venv", "--clear", str(ENVIRONMENT)], check=True)
    pip = [str(PYTHON), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
    what = ["--editable", f"{ROOT}[test,lint]"]
    if WHEELS.is_dir():
        pip += ["--find-links", str(WHEELS)]
        if subprocess.run([*pip, "--no-index", *what]).returncode == 0:
            return
        print("run.py: wheels/ does not hold every package; asking the package index.", file=sys.stderr, flush=True)
    subprocess.run([*pip, *what], check=True)


def usable() -> bool:
    """Whether there is an environment that runs this very checkout, if perhaps with older packages."""
    code = "import os, sys, pysim; sys.exit(not os.path.samefile(os.path.dirname(pysim.__file__), sys.argv[1]))"
    try:
        asked = [str(PYTHON), "-I", "-c", code, str(ROOT / "pysim")]
        return subprocess.run(asked, cwd=ENVIRONMENT, capture_output=True).returncode == 0
    except OSError:
        return False


def reason(error: Exception) -> str:
    """Why there is no new environment, and what to do."""
    if isinstance(error, OSError):
        return f"run.py: {ENVIRONMENT} cannot be renewed ({error}); close what runs in it and try again."
    if "venv" in getattr(error, "cmd", ()):
        return "run.py: could not create the environment; on Debian and Ubuntu: apt install python3-venv."
    return (
        "run.py: could not install the packages, see the messages above; is the package index reachable? Without a "
        "network they can come from a folder wheels/ beside run.py, see README.md."
    )


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
