"""Whether an FMU can run on this machine."""

from __future__ import annotations

from fmpy import platform, platform_tuple, sharedLibraryExtension

from pysim.io.archive import extracted
from pysim.types import BadInput, Model


def check_binary(model: Model, library: str) -> None:
    """Check that the FMU holds a shared library for this system and processor.

    Args:
        library: its name in the FMU, without suffix.
    Raises:
        BadInput: it does not; says for which machines it has one.
    """
    folder = extracted(model.path) / "binaries"
    name = platform if model.abilities.fmi == 2 else platform_tuple
    if not (folder / name / f"{library}{sharedLibraryExtension}").is_file():
        present = ", ".join(sorted(p.name for p in folder.glob("*"))) or "none"
        raise BadInput(f"{model.path.name} has no binary for {name} (it has: {present}); export it for this machine")
