"""FMUs with other members than they were packed with."""

import zipfile
from collections.abc import Mapping
from pathlib import Path

FLAGS = "resources/Test_Oscillator_flags.json"


def as_of_omc(own: Path, target: Path) -> Path:
    """What omc adds where it was asked for CVODE: the flags of the solver inside."""
    return repacked(own, target, {FLAGS: b'{\n  "s" : "cvode"\n}\n'})


def repacked(source: Path, target: Path, changes: Mapping[str, bytes | None]) -> Path:
    """A copy with members replaced or added; None leaves one out."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w") as new:
        members = {name: old.read(name) for name in old.namelist()} | dict(changes)
        for name, content in members.items():
            if content is not None:
                new.writestr(name, content)
    return target
