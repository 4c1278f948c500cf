"""An FMU's shared library and its instances: FMPy does the life cycle, native code gets the addresses."""

from __future__ import annotations

import ctypes
import threading
from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import platform, platform_tuple, sharedLibraryExtension
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model
from fmpy.fmi3 import FMU3Model

from pysim.io import extracted
from pysim.simulate._fmu_calls import FUNCTIONS
from pysim.simulate._messages import Mailbox
from pysim.simulate._sparsity import jacobian_arrays
from pysim.types import BadInput, Model

# Setter of FMPy per type of variable, FMI 2 and FMI 3.
_SETTERS = {
    2: {"Real": "setReal", "Integer": "setInteger", "Enumeration": "setInteger", "Boolean": "setBoolean"},
    3: {
        "Float64": "setFloat64",
        "Float32": "setFloat32",
        "Int32": "setInt32",
        "Int64": "setInt64",
        "Enumeration": "setInt64",
        "Boolean": "setBoolean",
    },
}

_FATAL = 4
_loading = threading.Lock()  # FMPy changes the working directory while it loads


def settable_types(model: Model) -> frozenset[str]:
    """Types of variables that can be set to a number."""
    return frozenset(_SETTERS[model.abilities.fmi])


class CallFailed(RuntimeError):
    """The FMU refused a step of its life cycle."""


class Instance:
    """An FMU between instantiation and release."""

    def __init__(self, library: Library, fmu: Any, mailbox: Mailbox) -> None:
        self.model, self.jacobian, self.fmu, self.mailbox = library.model, library.jacobian, fmu, mailbox
        self.lost = False  # after a fatal error nothing may be called any more

    def address(self, function: str) -> int:
        """Address of one of the library's functions."""
        return ctypes.cast(getattr(self.fmu.dll, function), ctypes.c_void_p).value or 0

    def addresses(self) -> dict[str, Any]:
        """What native code needs to call this instance."""
        version = self.model.abilities.fmi
        return {
            "version": version,
            "instance": self.fmu.component,
            "needs_completed_step": self.model.abilities.needs_completed_step,
            "answers": np.zeros(4),
            **{name: self.address(functions[version - 2]) for name, functions in FUNCTIONS.items()},
        }

    def initialise(self, overrides: Mapping[str, float], start: float, stop: float, tolerance: float | None) -> None:
        """Set start values, go through initialisation mode, arrive in event mode.

        Raises:
            CallFailed: the FMU refused; its own words are in the mailbox.
        """
        fmu = self.fmu
        try:
            for name, value in overrides.items():
                self._set(name, value)
            if self.model.abilities.fmi == 2:
                fmu.setupExperiment(tolerance=tolerance, startTime=start, stopTime=stop)
                fmu.enterInitializationMode()
            else:
                fmu.enterInitializationMode(tolerance=tolerance, startTime=start, stopTime=stop)
            fmu.exitInitializationMode()
        except FMICallException as error:
            self.lost = error.status >= _FATAL
            raise CallFailed(str(error)) from error

    def _set(self, name: str, value: float) -> None:
        variable = self.model[name]
        real = variable.type in ("Real", "Float32", "Float64")
        setter = getattr(self.fmu, _SETTERS[self.model.abilities.fmi][variable.type])
        setter([variable.reference], [float(value) if real else int(value)])


class Library:
    """A loaded FMU; makes instances, from any thread."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.jacobian = jacobian_arrays(model)
        self._idle: deque[tuple[Any, Mailbox]] = deque()
        self._folder = extracted(model.path)
        _check_binary(model, self._folder)

    def _load(self) -> tuple[Any, Mailbox]:
        kind = FMU2Model if self.model.abilities.fmi == 2 else FMU3Model
        with _loading:
            fmu = kind(
                guid=self.model.token,
                modelIdentifier=self.model.abilities.library,
                unzipDirectory=str(self._folder),
                instanceName=self.model.name,
            )
        return fmu, Mailbox(self.model.abilities.fmi)

    @contextmanager
    def instance(self) -> Iterator[Instance]:
        """A new instance, freed at the end of the block.

        Raises:
            CallFailed: the FMU could not be instantiated.
        """
        try:
            fmu, mailbox = self._idle.popleft()
        except IndexError:
            fmu, mailbox = self._load()
        mailbox.empty()
        instance = Instance(self, fmu, mailbox)
        try:
            fmu.instantiate(**mailbox.callbacks)
        except Exception as error:  # FMPy raises a bare Exception
            raise CallFailed("the FMU could not be instantiated" + mailbox.text()) from error
        try:
            yield instance
        finally:
            if not instance.lost:
                (fmu.fmi2FreeInstance if self.model.abilities.fmi == 2 else fmu.fmi3FreeInstance)(fmu.component)
                self._idle.append((fmu, mailbox))

    def close(self) -> None:
        """Unload the shared library."""
        while self._idle:
            self._idle.popleft()[0].freeLibrary()


@contextmanager
def open_library(model: Model) -> Iterator[Library]:
    """The model's shared library, loaded for the length of the block.

    Raises:
        BadInput: no model exchange, or no binary for this machine.
    """
    library = Library(model)
    try:
        yield library
    finally:
        library.close()


def _check_binary(model: Model, folder: Path) -> None:
    if not model.abilities.model_exchange:
        raise BadInput(f"{model.path.name} is for co-simulation only; export it for model exchange as well")
    name = platform if model.abilities.fmi == 2 else platform_tuple
    binary = folder / "binaries" / name / f"{model.abilities.library}{sharedLibraryExtension}"
    if not binary.is_file():
        present = ", ".join(sorted(p.name for p in (folder / "binaries").glob("*"))) or "none"
        raise BadInput(f"{model.path.name} has no binary for {name} (it has: {present}); export it for this machine")
