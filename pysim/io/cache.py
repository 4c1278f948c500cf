"""Where derived files are kept: machine code of the kernel, unpacked archives."""

from __future__ import annotations

from pathlib import Path

from fmu_build.private_folder import UnusableFolder, private_folder
from pysim.types import BadInput


def cache_folder(purpose: str) -> Path:
    """The folder for one purpose, see `fmu_build.private_folder`.

    Raises:
        BadInput: the folder cannot be written, belongs to another user, or others may write into it.
    """
    try:
        return private_folder(purpose)
    except UnusableFolder as error:
        raise BadInput(str(error)) from error
