"""How this folder's functions become machine code, and how they call into an FMU."""

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

# A part of a loop: no GIL, compiled into whatever calls it. fastmath stays off: NaN has to be seen.
native = numba.njit(nogil=True, error_model="numpy")

# The same for the handful of lines that every derivative call runs through: passing an array to a function that is not
# inlined costs seven registers, which is more than the work it does.
inlined = numba.njit(nogil=True, error_model="numpy", forceinline=True)


def _source_key() -> str:
    """Hash of every source file of this folder."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def entry(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile a function that Python calls, once per machine.

    Numba's own cache looks at the date of the one file that holds the function, not at the files of the functions it
    calls; so its folder is named here after the content of all of them.
    """
    before = config.CACHE_DIR
    config.CACHE_DIR = str(cache_folder("native") / _source_key())
    try:
        return numba.njit(nogil=True, error_model="numpy", cache=True)(function)
    finally:
        config.CACHE_DIR = before


@intrinsic  # type: ignore[untyped-decorator]
def call(typing_context: Any, address: Any, arguments: Any) -> Any:
    """Call the C function at `address` (int64) with a tuple of arguments; the int it returns.

    The C signature follows from the Numba types: an array is passed as the pointer to its first item, int64 as a
    pointer or size_t, int32 as int, fmi2Boolean or (widened, as every 64-bit calling convention allows) C bool,
    float64 as double. Because the address is data, one compiled loop serves every FMU.
    """

    def emit(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        target, packed = values
        passed = []
        for i, kind in enumerate(arguments.types):
            value = builder.extract_value(packed, i)
            if isinstance(kind, types.Array):
                value = context.make_array(kind)(context, builder, value).data
            passed.append(value)
        function_type = ir.FunctionType(ir.IntType(32), [v.type for v in passed])
        return builder.call(builder.inttoptr(target, function_type.as_pointer()), passed)

    return types.int32(types.int64, arguments), emit
