"""How this folder's functions become machine code, and how they reach memory and an FMU.

Native functions take one argument, the record of a run (`_job.JOB`), and find arrays by the addresses in it. Passing
Numba's array objects instead would cost each call some 400 words on the stack and an atomic count per array, ten times
as much as a derivative of the pump.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from llvmlite import ir
from numba.core import config, types
from numba.extending import intrinsic

from pysim.io import cache_folder

_njit: Any = numba.njit
_intrinsic: Any = intrinsic
_config: Any = config

# A part of the loop: compiled into whatever calls it, so no wrapper for Python. No "fast" arithmetic: NaN has to be
# seen, and a product and its sum are rounded one after the other, so that every processor gives the same bits.
native = _njit(nogil=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True)


def _source_key() -> str:
    """Hash of this folder: native code, and the constants and layouts that are compiled into it."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def is_compiled() -> bool:
    """Whether this machine holds the machine code already; making it takes some 15 s, once."""
    return any((cache_folder("native") / _source_key()).rglob("*.nbi"))


def entry(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile a function that Python calls, once per machine.

    Numba's own cache looks at the date of the one file that holds the function, not at the files of the functions it
    calls; so its folder is named here after the content of all of them.
    """
    before = _config.CACHE_DIR
    _config.CACHE_DIR = str(cache_folder("native") / _source_key())
    try:
        compiled: Callable[..., Any] = _njit(nogil=True, error_model="numpy", cache=True)(function)
        return compiled
    finally:
        _config.CACHE_DIR = before


@_intrinsic
def call(typing_context: Any, address: Any, arguments: Any) -> Any:
    """Call the C function at `address` (int64) with a tuple of arguments; the int it returns.

    The C signature follows from the Numba types: int64 is a pointer or size_t, float64 a double, int32 an int or
    (widened, as every 64-bit calling convention allows) a C bool. Because the address is data, one compiled loop serves
    every FMU.
    """

    def emit(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        target, packed = values
        passed = [builder.extract_value(packed, i) for i in range(len(arguments))]
        function_type = ir.FunctionType(ir.IntType(32), [value.type for value in passed])
        return builder.call(builder.inttoptr(target, function_type.as_pointer()), passed)

    return types.int32(types.int64, arguments), emit


def _pointer_to(item: Any) -> Any:
    """An intrinsic that takes an address as a pointer to items of that type."""

    @_intrinsic
    def pointer(typing_context: Any, address: Any) -> Any:
        def emit(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            return builder.inttoptr(values[0], context.get_value_type(signature.return_type))

        return types.CPointer(item)(types.int64), emit

    return pointer


doubles = _pointer_to(types.float64)
singles = _pointer_to(types.float32)
longs = _pointer_to(types.int64)
ints = _pointer_to(types.int32)
octets = _pointer_to(types.uint8)
