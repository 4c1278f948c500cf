"""Whether OpenModelica can be used here, and what is missing where it cannot."""

import importlib.util
import os
import shutil
import subprocess
from pathlib import Path

from fmu_build.errors import BuildError

HOME_VARIABLE = "OPENMODELICAHOME"
_LONGEST_S = 60.0  # `omc --version` answers at once; the first start after an installation may be slow


def what_is_missing() -> str:
    """Why OpenModelica cannot be used, as the end of a sentence with its cure; empty where it can."""
    if find_omc() is None:
        return f"omc is not installed: get it from openmodelica.org, or name its folder in {HOME_VARIABLE}"
    if importlib.util.find_spec("OMPython") is None:
        return "the Python package OMPython is missing: pip install OMPython"
    if is_root():
        return "omc does not serve the user root: call fmu-build as another user"
    return ""


def find_omc() -> Path | None:
    """The program, where OMPython looks for it: below $OPENMODELICAHOME, else on the path."""
    home = os.environ.get(HOME_VARIABLE)
    found = shutil.which("omc", path=str(Path(home) / "bin")) if home else shutil.which("omc")
    return Path(found) if found else None


def is_root() -> bool:
    """omc refuses to start as a server then, because it would take anybody's commands with all rights."""
    return hasattr(os, "geteuid") and os.geteuid() == 0


def omc_version() -> str:
    """What `omc --version` says. Raises BuildError where it cannot be asked."""
    omc = find_omc()
    if omc is None:
        raise BuildError(f"building with OpenModelica: {what_is_missing()}.")
    try:
        done = subprocess.run(
            [str(omc), "--version"], capture_output=True, text=True, errors="replace", timeout=_LONGEST_S, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise BuildError(f"{omc} cannot be started: {error}; reinstall OpenModelica.") from error
    if done.returncode or not done.stdout.strip():
        raise BuildError(f"{omc} --version ends with {done.returncode}: {done.stderr.strip()}; reinstall OpenModelica.")
    return done.stdout.strip()
