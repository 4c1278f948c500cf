"""An FMU's shared library and its instances: FMPy does the life cycle, the kernel gets the addresses."""

from __future__ import annotations

import ctypes
from collections import deque
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model
from fmpy.fmi3 import FMU3Model

from pysim.io import load_library
from pysim.simulate._job import Job
from pysim.simulate._messages import Mailbox
from pysim.simulate.kernel.functions import FUNCTIONS
from pysim.simulate.kernel.layout import ERROR, FATAL, OK
from pysim.simulate.kernel.recording import row_layout
from pysim.simulate.kernel.sparsity import jacobian_arrays
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

REALS = frozenset({"Real", "Float32", "Float64"})


def settable_types(model: Model) -> frozenset[str]:
    """Types of variables that can be set to a number."""
    return frozenset(_SETTERS[model.abilities.fmi])


class CallFailed(RuntimeError):
    """The FMU refused a step of its life cycle."""


class Instance:
    """One instance of an FMU, used for run after run, by one thread at a time.

    Between runs it is reset, which the standard defines to give what a new instance is. An FMU that refuses to be
    reset, or that reported an error, is instantiated anew.
    """

    def __init__(self, library: Library, fmu: Any, mailbox: Mailbox) -> None:
        self.model, self.jacobian, self.fmu, self.mailbox = library.model, library.jacobian, fmu, mailbox
        self.status = OK  # worst one of the run; after a fatal error nothing may be called any more
        self.job: Job | None = None  # memory of the run before
        self.is_alive, self._can_reset = False, True  # alive: between instantiation and release
        self._rows: dict[tuple[str, ...], dict[str, Any]] = {}
        version = self.model.abilities.fmi
        self._addresses: dict[str, Any] = {
            "version": version,
            "needs_completed_step": self.model.abilities.needs_completed_step,
            **{name: self.address(functions[version - 2]) for name, functions in FUNCTIONS.items()},
        }

    def address(self, function: str) -> int:
        """Address of one of the library's functions."""
        return ctypes.cast(getattr(self.fmu.dll, function), ctypes.c_void_p).value or 0

    def addresses(self) -> dict[str, Any]:
        """What the kernel needs to call this instance; the same object as long as nothing changes."""
        if self._addresses.get("instance") != self.fmu.component:
            self._addresses = {**self._addresses, "instance": self.fmu.component}
        return self._addresses

    def rows(self, names: tuple[str, ...]) -> dict[str, Any]:
        """What the kernel needs to read these variables."""
        if names not in self._rows:
            self._rows[names] = row_layout(self.model, names, self.address)
        return self._rows[names]

    def renew(self) -> None:
        """Be as new, whatever the run before did.

        Raises:
            CallFailed: the FMU could not be instantiated.
        """
        self.mailbox.empty()
        self.status = OK
        if self.is_alive and self._can_reset and self._reset():
            return
        self.release()
        self.mailbox.empty()
        try:
            self.fmu.instantiate(**self.mailbox.callbacks)
        except Exception as error:  # FMPy raises a bare Exception
            raise CallFailed("the FMU could not be instantiated" + self.mailbox.text()) from error
        self.is_alive = True

    def _reset(self) -> bool:
        try:
            self.fmu.reset()
        except FMICallException:
            self._can_reset = False
        return self._can_reset

    def release(self) -> None:
        """Free the instance; the library stays loaded."""
        if self.is_alive:
            (self.fmu.fmi2FreeInstance if self.model.abilities.fmi == 2 else self.fmu.fmi3FreeInstance)(
                self.fmu.component
            )
        self.is_alive = False

    def initialise(self, values: Mapping[str, float], start: float, stop: float, tolerance: float | None) -> None:
        """Set start values, go through initialisation mode, arrive in event mode.

        Raises:
            CallFailed: the FMU refused; its own words are in the mailbox.
        """
        self.enter_initialisation(values, start, stop, tolerance)
        self.exit_initialisation()

    def enter_initialisation(
        self, values: Mapping[str, float], start: float, stop: float, tolerance: float | None
    ) -> None:
        """Set start values, enter initialisation mode.

        Raises:
            CallFailed: the FMU refused; its own words are in the mailbox.
        """
        with self._refusal():
            self._set(values)
            if self.model.abilities.fmi == 2:
                self.fmu.setupExperiment(tolerance=tolerance, startTime=start, stopTime=stop)
                self.fmu.enterInitializationMode()
            else:
                self.fmu.enterInitializationMode(tolerance=tolerance, startTime=start, stopTime=stop)

    def exit_initialisation(self) -> None:
        """Go on to event mode.

        Raises:
            CallFailed: the FMU refused; its own words are in the mailbox.
        """
        with self._refusal():
            self.fmu.exitInitializationMode()

    @contextmanager
    def _refusal(self) -> Iterator[None]:
        try:
            yield
        except FMICallException as error:
            self.status = max(self.status, error.status)
            raise CallFailed(str(error)) from error

    def _set(self, values: Mapping[str, float]) -> None:
        """Set variables, in one call for each type."""
        groups: dict[str, tuple[list[int], list[float]]] = {}
        for name, value in values.items():
            variable = self.model[name]
            references, numbers = groups.setdefault(variable.type, ([], []))
            references.append(variable.reference)
            numbers.append(float(value) if variable.type in REALS else int(value))
        for kind, (references, numbers) in groups.items():
            getattr(self.fmu, _SETTERS[self.model.abilities.fmi][kind])(references, numbers)


class Library:
    """A loaded FMU; lends instances, to any thread."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.jacobian = jacobian_arrays(model)
        self._idle: deque[Instance] = deque()
        if not model.abilities.model_exchange:
            raise BadInput(f"{model.label} is for co-simulation only; export it for model exchange as well")

    def _load(self) -> Instance:
        kind = FMU2Model if self.model.abilities.fmi == 2 else FMU3Model
        fmu = load_library(kind, self.model, self.model.abilities.library, self.model.name)
        return Instance(self, fmu, Mailbox(self.model.abilities.fmi))

    @contextmanager
    def instance(self) -> Iterator[Instance]:
        """An instance that is as new, for the length of the block.

        Raises:
            CallFailed: the FMU could not be instantiated.
        """
        try:
            instance = self._idle.pop()
        except IndexError:
            instance = self._load()
        try:
            instance.renew()
            yield instance
        finally:
            self._take_back(instance)

    def _take_back(self, instance: Instance) -> None:
        """Keep it for a later run, or unload it where it can never be used again.

        After a fatal error nothing of an FMU may be called any more, what it does when it is unloaded included.
        """
        if instance.status >= FATAL:
            return
        if not instance.is_alive:
            instance.fmu.freeLibrary()
            return
        if instance.status >= ERROR:
            instance.release()
        self._idle.append(instance)

    def close(self) -> None:
        """Free the instances and unload the shared library."""
        while self._idle:
            instance = self._idle.pop()
            instance.release()
            instance.fmu.freeLibrary()


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
