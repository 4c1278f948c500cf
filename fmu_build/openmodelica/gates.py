"""What an FMU of OpenModelica has to pass before it is taken: the checks of our own, and those of its known faults."""

import json
import logging
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from collections.abc import Mapping
from pathlib import Path

from fmu_build.errors import BuildError
from fmu_build.openmodelica.kinds import disagreement
from fmu_build.pack.archive import write_archive
from fmu_build.pack.platforms import Platform, host_platform
from fmu_build.pack.validation import validate_foreign
from fmu_build.scratch import scratch

_log = logging.getLogger(__name__)
_LOAD = "import ctypes, sys; ctypes.CDLL(sys.argv[1])"  # in a process of its own: a library may do anything
_LONGEST_S = 60.0


def accept(fmu: Path, output: Path) -> None:
    """Check an FMU and write it, packed as our own are; without co-simulation where that differs from model exchange.

    Raises:
        BuildError: it is no FMI 2 FMU for both kinds of simulation, holds no CVODE for co-simulation, its library for
            this machine is missing or cannot be loaded, or it fails FMPy's validation.
    """
    try:
        with zipfile.ZipFile(fmu) as archive:
            members = {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}
    except (OSError, zipfile.BadZipFile) as error:
        raise BuildError(f"the FMU of omc cannot be read: {error}") from None
    identifier = _check_kinds(members)
    _check_solver(members)
    _check_library(members, identifier, host_platform())
    different = disagreement(fmu)
    if different:
        members["modelDescription.xml"] = _without_co_simulation(members["modelDescription.xml"])
        _log.warning(
            "co-simulation by this FMU of OpenModelica %s: the FMU is left with model exchange alone", different
        )
    write_archive(output, members, validate_foreign)


def _without_co_simulation(description: bytes) -> bytes:
    """The same text without its element CoSimulation."""
    found = re.search(rb"<CoSimulation\b(?:[^>]*/>|.*?</CoSimulation\s*>)\s*", description, re.DOTALL)
    return description if found is None else description[: found.start()] + description[found.end() :]


def _check_kinds(members: Mapping[str, bytes]) -> str:
    """The identifier of the model."""
    try:
        root = ElementTree.fromstring(members.get("modelDescription.xml", b""))
    except ElementTree.ParseError as error:
        raise BuildError(f"the FMU of omc has no readable modelDescription.xml: {error}") from None
    version = root.get("fmiVersion", "none")
    if version != "2.0":
        raise BuildError(f"the FMU of omc is of FMI version {version}, not 2.0")
    kinds = {kind: root.find(kind) for kind in ("ModelExchange", "CoSimulation")}
    for kind, element in kinds.items():
        if element is None or not element.get("modelIdentifier"):
            raise BuildError(f"the FMU of omc lacks {kind}")
    names = {str(element.get("modelIdentifier")) for element in kinds.values() if element is not None}
    if len(names) != 1:
        raise BuildError(f"the FMU of omc has two libraries, {' and '.join(sorted(names))}")
    return names.pop()


def _check_solver(members: Mapping[str, bytes]) -> None:
    """The flags for the solver inside, which omc writes only where it has understood the option."""
    for name, content in members.items():
        if name.startswith("resources/") and name.endswith("_flags.json"):
            try:
                solver = json.loads(content).get("s")
            except (ValueError, AttributeError):
                solver = None
            if solver == "cvode":
                return
            raise BuildError(f"the FMU of omc would solve by {solver or 'explicit Euler'}, not by CVODE")
    raise BuildError(
        "the FMU of omc would solve by explicit Euler: this omc does not know --fmiFlags; take a later one"
    )


def _check_library(members: Mapping[str, bytes], identifier: str, platform: Platform) -> None:
    path = f"binaries/{platform.fmi2_folder}/{identifier}{platform.suffix}"
    if path not in members:
        raise BuildError(f"the FMU of omc holds no {path}; look into omc's own log for what its C compiler said")
    with scratch() as folder:
        beside = f"binaries/{platform.fmi2_folder}/"
        for name, content in members.items():  # libraries that it brings along lie beside it
            if name.startswith(beside) and "/" not in name.removeprefix(beside):
                (folder / name.removeprefix(beside)).write_bytes(content)
        library = folder / Path(path).name
        done = subprocess.run(
            [sys.executable, "-c", _LOAD, str(library)],
            capture_output=True,
            text=True,
            errors="replace",
            timeout=_LONGEST_S,
            check=False,
        )
    if done.returncode:
        last = (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]
        raise BuildError(f"the library in the FMU of omc cannot be loaded: {last}")
