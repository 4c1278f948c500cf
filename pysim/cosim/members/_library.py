"""The shared library of a co-simulation FMU, and one instance in it: FMPy does the life cycle, steps go past it."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from numpy.typing import NDArray

from pysim.cosim.member import MemberFailed
from pysim.io import load_library
from pysim.simulate import FmuValues, Mailbox
from pysim.types import CoSimulation, Model

Array = NDArray[np.float64]

_ERROR, FATAL = 3, 4

# FMUs need not be able to do that in co-simulation, but for initialisation and the event mode of FMI 3.
READ_AT_ONCE = 'an output could not be read behind an input that was set; take Fmu(..., feedthrough="none")'

_P, _N, _STATUS = ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int
_EXCHANGE = {2: ctypes.CFUNCTYPE(_STATUS, _P, _P, _N, _P), 3: ctypes.CFUNCTYPE(_STATUS, _P, _P, _N, _P, _N)}


class SteppingInstance:
    """One instance of an FMU that steps by itself."""

    def __init__(self, name: str, model: Model, stepping: CoSimulation) -> None:
        self.model, self.stepping, self.mailbox = model, stepping, Mailbox(model.abilities.fmi)
        self._kept: list[NDArray[np.uint32]] = []  # what the library is given addresses of
        self.status = 0  # worst one; after a fatal error nothing may be called any more
        kind = FMU2Slave if model.abilities.fmi == 2 else FMU3Slave
        self.fmu: Any = load_library(kind, model, stepping.library, name)
        self._alive = self.is_running = False

    def instantiate(self, **options: bool) -> int:
        """Make the instance; its pointer."""
        try:
            self.fmu.instantiate(**self.mailbox.callbacks, **options)
        except Exception as error:  # FMPy raises a bare Exception
            self._unload()
            raise MemberFailed(f"it cannot be instantiated{self.mailbox.text()}") from error
        self._alive = True
        component: int = self.fmu.component
        return component

    def address(self, function: str) -> int:
        """Address of one of the library's functions."""
        return ctypes.cast(getattr(self.fmu.dll, function), ctypes.c_void_p).value or 0

    def exchange(self, verb: str, names: tuple[str, ...], array: Array) -> Callable[[], int]:
        """A function that moves all values in one go, and returns the status.

        Args:
            verb: "Set" takes the variables from the array (n,), "Get" puts them there.
            names: (n,) of the variables.
        """
        fmi, variables = self.model.abilities.fmi, [self.model[name] for name in names]
        values = FmuValues(fmi, variables, array, self.address)
        if not values.is_plain:
            return partial(values.write if verb == "Set" else values.read, self.fmu.component)
        references = np.array([variable.reference for variable in variables], dtype=np.uint32)
        self._kept.append(references)  # numbers alone: straight into the library, past two calls of Python's
        arguments = [references.ctypes.data, references.size, array.ctypes.data, references.size]
        function = _EXCHANGE[fmi](self.address(f"fmi{fmi}{verb}{'Real' if fmi == 2 else 'Float64'}"))
        return partial(function, self.fmu.component, *arguments[: 3 if fmi == 2 else 4])

    @contextmanager
    def refusal(self) -> Iterator[None]:
        """Turn what FMPy raises into MemberFailed, with the FMU's own words."""
        try:
            yield
        except FMICallException as error:
            self.status = max(self.status, error.status)
            raise MemberFailed(f"{error}{self.mailbox.text()}") from error

    def check(self, status: int, what: str) -> None:
        """A call that returned a status above warning is an error."""
        if status > 1:
            self.status = max(self.status, status)
            raise MemberFailed(f"{what}{self.mailbox.text()}")

    def set_values(self, values: Mapping[str, float]) -> None:
        """Set parameters and start values by name."""
        array = np.array(list(values.values()), dtype=np.float64)
        variables = [self.model[name] for name in values]
        names = ", ".join(values)
        bound = FmuValues(self.model.abilities.fmi, variables, array, self.address)
        self.check(bound.write(self.fmu.component), f"{names} could not be set")

    def close(self) -> None:
        """Free the instance and unload the library; twice does no harm."""
        if self._alive and self.is_running and self.status < _ERROR:
            with suppress(FMICallException):  # it may close files; what it says of that comes too late to matter
                self.fmu.terminate()
        self.is_running = False
        if self._alive and self.status < FATAL:
            free = self.fmu.fmi2FreeInstance if self.model.abilities.fmi == 2 else self.fmu.fmi3FreeInstance
            free(self.fmu.component)
        if self._alive:
            self._alive = False
            self._unload()

    def _unload(self) -> None:
        if self.status < FATAL:
            self.fmu.freeLibrary()
