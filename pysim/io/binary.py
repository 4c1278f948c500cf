"""Whether an FMU can run on this machine, and its shared library."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol, TypeVar

from fmpy import platform, platform_tuple, sharedLibraryExtension

from pysim.io.archive import extracted, stamp
from pysim.io.fmu import read_model
from pysim.types import BadInput, Model

Loaded = TypeVar("Loaded", covariant=True)

_loading = threading.Lock()  # FMPy changes the working directory while it loads


class Loader(Protocol[Loaded]):
    """A class of FMPy that loads a shared library."""

    def __call__(self, *, guid: str, modelIdentifier: str, unzipDirectory: str, instanceName: str) -> Loaded:
        """An FMU without an instance yet."""
        ...


def check_binary(model: Model, library: str) -> None:
    """Check that the FMU holds a shared library for this system and processor.

    Args:
        library: its name in the FMU, without suffix.
    Raises:
        BadInput: it does not; says for which machines it has one. So too where the FMU is gone, or has become another
            since it was read.
    """
    _check_same(model)
    folder = extracted(model.path) / "binaries"
    name = platform if model.abilities.fmi == 2 else platform_tuple
    if not (folder / name / f"{library}{sharedLibraryExtension}").is_file():
        present = ", ".join(sorted(p.name for p in folder.glob("*"))) or "none"
        raise BadInput(f"{model.label} has no binary for {name} (it has: {present}); export it for this machine")


def _check_same(model: Model) -> None:
    if not model.path.is_file():
        raise BadInput(f"{model.label} is not at {model.path} any more; export it again")
    if stamp(model.path) != model.stamp and read_model(model.path).token != model.token:
        raise BadInput(f"{model.label} has become another since it was read; read it again with read_model")


def load_library(load: Loader[Loaded], model: Model, library: str, instance: str) -> Loaded:
    """Load an FMU's shared library; whoever asks from another thread waits.

    Args:
        load: the class of FMPy that does it.
        library: as for `check_binary`.
        instance: name that the FMU's messages will carry.
    Raises:
        BadInput: as `check_binary`, or a library that the system cannot load.
    """
    check_binary(model, library)
    folder = str(extracted(model.path))
    with _loading, _working_folder():
        try:
            return load(guid=model.token, modelIdentifier=library, unzipDirectory=folder, instanceName=instance)
        except Exception as error:  # FMPy raises a bare Exception
            raise BadInput(
                f"{model.label}: its library {library} cannot be loaded ({error}); install what it needs beside "
                "itself, or export the FMU again for this machine"
            ) from error


@contextmanager
def _working_folder() -> Iterator[None]:
    """Stay where we are: FMPy does not come back from a library that cannot be loaded."""
    folder = os.getcwd()
    try:
        yield
    finally:
        os.chdir(folder)
