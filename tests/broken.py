"""FMUs that look whole and are not."""

import zipfile
from pathlib import Path


def with_broken_library(fmu: Path, target: Path) -> Path:
    """The same FMU, whose shared libraries no system can load."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            new.writestr(name, b"no library" if name.startswith("binaries/") else old.read(name))
    return target
