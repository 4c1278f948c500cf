"""An FMU's shared library and its instances."""

from __future__ import annotations

import ctypes
import os
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from fmpy.fmi2 import FMU2Model
from fmpy.fmi3 import FMU3Model

from pysim.io import load_library
from pysim.simulate._job import Job
from pysim.simulate._messages import Mailbox
from pysim.simulate._structure import Structure
from pysim.simulate.kernel.functions import FUNCTIONS, MATRICES, PARAMETER_COLUMN, SETUP, TYPES, access
from pysim.simulate.kernel.layout import (
    ERROR,
    FATAL,
    PART_CRASHED,
    PART_ENTER,
    PART_EXIT,
    PART_INSTANTIATE,
    PART_SET,
    PART_SILENT,
    WARNING,
)
from pysim.simulate.kernel.library import kernel
from pysim.simulate.kernel.signals import Packs
from pysim.simulate.kernel.sparsity import jacobian_arrays
from pysim.types import BadInput, Model

REALS = frozenset({"Real", "Float32", "Float64"})


def settable_types(model: Model) -> frozenset[str]:
    """Types of variables that can be set to a number."""
    return frozenset(TYPES[model.abilities.fmi])


_PARTS = {
    PART_INSTANTIATE: "the FMU could not be instantiated",
    PART_SET: "a start value could not be set",
    PART_ENTER: "the FMU could not be initialised",
    PART_EXIT: "the FMU could not be initialised",
    PART_CRASHED: "the FMU crashed and took its process with it",
    PART_SILENT: "the FMU gave no answer for so long that its process was ended",
}


def failure(part: int) -> str:
    """What went wrong ahead of a run, by the kernel's number of the part."""
    return _PARTS[part]


class CallFailed(RuntimeError):
    """The FMU refused a step of its life cycle."""


class Instance:
    """One instance of an FMU, used for run after run, by one thread at a time.

    Between runs it is reset, which the standard defines to give what a new instance is. An FMU that refuses to be
    reset, or that reported an error, is instantiated anew.

    Args:
        fmu: as FMPy loaded it; its functions are called by the kernel.
    """

    def __init__(self, library: Library, fmu: Any) -> None:
        self.model, self.dll = library.model, fmu.dll
        self.jacobian = jacobian_arrays(library.model)
        self.mailbox = Mailbox(self.model.abilities.fmi)
        self.job: Job | None = None  # memory of the run before
        self._free_library = fmu.freeLibrary
        self._access: dict[tuple[str, tuple[str, ...]], Structure] = {}
        self.record = Structure("Fmu", self._functions(fmu))

    def _functions(self, fmu: Any) -> dict[str, Any]:
        version, folder = self.model.abilities.fmi, Path(fmu.unzipDirectory, "resources")
        found: dict[str, Any] = {
            "version": version,
            "needs_completed_step": self.model.abilities.needs_completed_step,
            "name": _text(self.model.name),
            "token": _text(self.model.token),
            "resources": _text(folder.as_uri() if version == 2 else f"{folder}{os.sep}"),
            "log": self.mailbox.log,
            **{name: self.address(functions[version - 2]) for name, functions in FUNCTIONS.items()},
        }
        if self._own_functions:
            found["get_matrices"] = self.address(MATRICES)
        if version == 2:
            found["callbacks"] = ctypes.addressof(self.mailbox.callbacks["callbacks"])
            found["setup_experiment"] = self.address(SETUP)
        return found

    def address(self, function: str) -> int:
        """Address of one of the library's functions."""
        return ctypes.cast(getattr(self.dll, function), ctypes.c_void_p).value or 0

    @property
    def _own_functions(self) -> bool:
        """Whether the FMU is one of ours, which gives more than the standard asks for."""
        return hasattr(self.dll, MATRICES) and hasattr(self.dll, PARAMETER_COLUMN)

    def column_of(self) -> Callable[[int], int] | None:
        """Which column of an FMU of ours belongs to a parameter, by its reference; None for one of others."""
        if not self._own_functions:
            return None
        if not self.component and kernel().renew(self.record.record) > WARNING:
            return None
        function = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, ctypes.c_uint32)(self.address(PARAMETER_COLUMN))
        return lambda reference: int(function(self.component, reference))

    @property
    def component(self) -> int:
        """The instance, as the FMU's functions want it; 0 where there is none."""
        return int(self.record.record["instance"][0])

    @property
    def status(self) -> int:
        """The worst one of the run; after a fatal error nothing may be called any more."""
        return int(self.record.record["status"][0])

    @status.setter
    def status(self, status: int) -> None:
        self.record.change({"status": status})

    def access(self, names: tuple[str, ...], verb: str) -> Structure:
        """What the kernel needs to read ("Get") or to set ("Set") these variables."""
        if (verb, names) not in self._access:
            self._access[verb, names] = Structure("Access", access(self.model, names, verb, self.address))
        return self._access[verb, names]

    def renew(self) -> None:
        """Be as new, whatever the run before did.

        Raises:
            CallFailed: the FMU could not be instantiated.
        """
        self.mailbox.empty()
        self._check(PART_INSTANTIATE, kernel().renew(self.record.record))

    def enter_initialisation(
        self, values: Mapping[str, float], start: float, stop: float, tolerance: float | None
    ) -> None:
        """Set start values, enter initialisation mode.

        Raises:
            CallFailed: the FMU refused.
        """
        numbers, buffer = np.array([*values.values()], dtype=np.float64), np.zeros(len(values))
        setters, record = self.access(tuple(values), "Set").record, self.record.record
        self._check(PART_SET, kernel().set_values(record, setters, numbers, buffer))
        self._check(PART_ENTER, kernel().enter_initialisation(record, tolerance or 0.0, start, stop))

    def exit_initialisation(self) -> None:
        """Go on to event mode.

        Raises:
            CallFailed: the FMU refused.
        """
        self._check(PART_EXIT, kernel().exit_initialisation(self.record.record))

    def _check(self, part: int, status: int) -> None:
        if status > WARNING:
            self.status = max(self.status, status)
            raise CallFailed(failure(part) + self.mailbox.text())

    def release(self) -> None:
        """Free the instance; the library stays loaded."""
        kernel().release(self.record.record)

    def unload(self) -> None:
        """Unload the shared library."""
        self._free_library()


def _text(text: str) -> np.ndarray:
    """A text as C has it."""
    return np.frombuffer(text.encode() + b"\0", dtype=np.uint8)


class Library:
    """A loaded FMU; lends instances, to any thread."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.known: dict[Any, Any] = {}  # what was found out about the FMU and need not be asked again
        self.packs = Packs()
        self._idle: deque[Instance] = deque()
        if not model.abilities.model_exchange:
            raise BadInput(f"{model.label} is for co-simulation only; export it for model exchange as well")

    def _load(self) -> Instance:
        kind = FMU2Model if self.model.abilities.fmi == 2 else FMU3Model
        return Instance(self, load_library(kind, self.model, self.model.abilities.library, self.model.name))

    @contextmanager
    def lent(self) -> Iterator[Instance]:
        """An instance in whatever state the run before left it, for the length of the block."""
        try:
            instance = self._idle.pop()
        except IndexError:
            instance = self._load()
        try:
            yield instance
        finally:
            self._take_back(instance)

    def _take_back(self, instance: Instance) -> None:
        """Keep it for a later run, unless after a fatal error, when nothing of an FMU may be called any more."""
        if instance.status >= FATAL:
            return
        if instance.status >= ERROR:
            instance.release()
        self._idle.append(instance)

    @contextmanager
    def instance(self) -> Iterator[Instance]:
        """An instance that is as new, for the length of the block.

        Raises:
            CallFailed: the FMU could not be instantiated.
        """
        with self.lent() as instance:
            instance.renew()
            yield instance

    def close(self) -> None:
        """Free the instances and unload the shared library."""
        while self._idle:
            instance = self._idle.pop()
            instance.release()
            instance.unload()


@contextmanager
def open_library(model: Model) -> Iterator[Library]:
    """The model's shared library, loaded for the length of the block.

    Raises:
        BadInput: no model exchange, no binary for this machine, or an FMU that cannot be instantiated.
    """
    library = Library(model)
    try:
        _try_instance(library)
        yield library
    finally:
        library.close()


def _try_instance(library: Library) -> None:
    """Make the first instance now, so that an FMU nobody can instantiate is one error and not one per run."""
    try:
        with library.instance():
            pass
    except CallFailed as error:
        raise BadInput(f"{library.model.label}: {error}; export it again") from error
