"""The kernel's functions, for Python. Each is called without the lock of the interpreter."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cache
from typing import Any, cast

from numpy.typing import NDArray

from pysim.simulate.kernel.build import build_kernel
from pysim.simulate.kernel.layout import JOB

Array = NDArray[Any]

_P, _N, _D = ctypes.c_void_p, ctypes.c_int64, ctypes.c_double
TAKE = ctypes.CFUNCTYPE(None, _N, _N, _N)  # Take of job.h


class Kernel:
    """The loaded library. A job is given as its record, (1,) of JOB."""

    def __init__(self, path: str) -> None:
        self.dll = ctypes.CDLL(path)
        self.dll.kernel_job_size.restype = _N
        if self.dll.kernel_job_size() != JOB.itemsize:
            raise RuntimeError("the kernel's structures are not those of its header")
        self._integrate = self._function("kernel_integrate", ctypes.c_int, _P, _N)
        self._work = self._function("kernel_work", None, _P, _P)
        self._renew = self._function("kernel_renew", ctypes.c_int, _P)
        self._release = self._function("kernel_release", None, _P)
        self._set_values = self._function("kernel_set_values", ctypes.c_int, _P, _P, _P, _P)
        self._enter = self._function("kernel_enter_initialisation", ctypes.c_int, _P, _D, _D, _D)
        self._exit = self._function("kernel_exit_initialisation", ctypes.c_int, _P)
        self.log_2: int = self._function("kernel_log_2", _P)()  # address of FMI 2's logger
        self._solve_least = self._function("kernel_solve_least", _D, _P, _P, _N, _D)
        self._factorise = self._function("kernel_factorise", ctypes.c_int, _P, _D)
        self._solve = self._function("kernel_solve", None, _P, _P)
        self._solve_rows = self._function("kernel_solve_rows", None, _P, _P, _N)
        self.row_sums: int = self._function("kernel_row_sums", _P)()  # address
        self.plain_row_sums: int = self._function("kernel_plain_row_sums", _P)()

    def _function(self, name: str, result: Any, *arguments: Any) -> Callable[..., Any]:
        function = getattr(self.dll, name)
        function.restype, function.argtypes = result, arguments
        return cast(Callable[..., Any], function)

    def integrate(self, job: Array, budget: int) -> int:
        """Go on with a run for at most `budget` accepted steps; RUNNING or how it ended."""
        return int(self._integrate(address(job), budget))

    def work(self, tasks: Array, job: Array) -> None:
        """Run the tasks that are left of a pass, (1,) of PASS."""
        self._work(address(tasks), address(job))

    def renew(self, fmu: Array) -> int:
        """Make an instance, (1,) of FMU, as new; the status."""
        return int(self._renew(address(fmu)))

    def release(self, fmu: Array) -> None:
        """Free an instance if there is one."""
        self._release(address(fmu))

    def set_values(self, fmu: Array, access: Array, values: Array, buffer: Array) -> int:
        """Set variables ahead of initialisation; `buffer` has 8 bytes for each. The status."""
        return int(self._set_values(address(fmu), address(access), address(values), address(buffer)))

    def enter_initialisation(self, fmu: Array, tolerance: float, start: float, stop: float) -> int:
        """Enter initialisation mode, without a tolerance where it is 0; times in s. The status."""
        return int(self._enter(address(fmu), tolerance, start, stop))

    def exit_initialisation(self, fmu: Array) -> int:
        """Go on to event mode; the status."""
        return int(self._exit(address(fmu)))

    def factorise(self, job: Array, shift: float) -> bool:
        """Factorise shift I - J, J in work.jacobian; False if it is singular or not finite."""
        return bool(self._factorise(address(job), shift))

    def solve(self, job: Array, right: Array) -> None:
        """Replace the right-hand sides, (n,) or (n, multiple of COLUMNS), by the solutions."""
        if right.ndim == 1:
            self._solve(address(job), address(right))
        else:
            self._solve_rows(address(job), address(right), right.shape[1])

    def solve_least(self, job: Array, solved: Array, least: float) -> float:
        """Solve shooting.matrix y = shooting.right, (n, m), with no part in directions that the matrix loses.

        The largest entry of the first column that is left over.
        """
        return float(self._solve_least(address(job), address(solved), solved.shape[1], least))


def address(array: Array) -> int:
    """Where a contiguous array lies in memory."""
    if not array.flags.c_contiguous:
        raise ValueError("the kernel reads arrays item after item: this one is not contiguous")
    return array.ctypes.data  # __array_interface__ would first describe all fields of a job, 0.35 ms


@cache
def kernel() -> Kernel:
    """The library for this machine, built if it has to be.

    Raises:
        BadInput: it cannot be built.
    """
    return Kernel(str(build_kernel()))
