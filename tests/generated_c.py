"""Compiles generated C for this machine and calls its functions through ctypes."""

import ctypes
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import ziglang

from fmu_build.emit.c_function import ARGUMENTS
from fmu_build.pack import host_platform

INCLUDE = Path(__file__).parents[1] / "fmu_build" / "runtime" / "include"
ZIG = Path(ziglang.__file__).with_name("zig")  # started directly: `python -m ziglang` starts a second Python
# For the target of our FMUs and without debug data, so that zig compiles its start-up code once for both: 4 s of CPU.
OPTIONS = ("-std=c11", "-O3", "-g0", "-s", "-shared", "-fPIC", "-fsanitize=undefined", "-fsanitize-trap=undefined")
WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Werror")

_Pointer = ctypes.POINTER(ctypes.c_double)


def compile_shared(source: str, folder: Path) -> ctypes.CDLL:
    """A shared library of one C file in which model.h can be included."""
    file, library = folder / "generated.c", folder / "generated.so"
    file.write_text(source, encoding="utf-8")
    command = [str(ZIG), "cc", "-target", host_platform().zig_target, *OPTIONS, *WARNINGS]
    done = subprocess.run(
        [*command, f"-I{INCLUDE}", str(file), "-o", str(library)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return ctypes.CDLL(str(library))


@dataclass(frozen=True)
class Generated:
    """A function of the form ModelFunction; `sizes` are the lengths of its results."""

    function: ctypes._CFuncPtr  # type: ignore[name-defined]
    sizes: tuple[int, ...]

    def __call__(self, wanted: set[int] | None = None, **values: object) -> list[np.ndarray]:
        """Results in order, each of its length; those not `wanted` stay NaN. Values by lower-case argument."""
        inputs = [np.atleast_1d(np.asarray(values.get(a.lower(), []), dtype=float)) for a in ARGUMENTS]
        outputs = [np.full(size, np.nan) for size in self.sizes]
        arg = (_Pointer * len(inputs))(*(v.ctypes.data_as(_Pointer) for v in inputs))
        asked = [v.ctypes.data_as(_Pointer) if wanted is None or k in wanted else None for k, v in enumerate(outputs)]
        assert self.function(arg, (_Pointer * len(asked))(*asked)) == 0
        return outputs


def exported(source: str, functions: Mapping[str, tuple[int, ...]], folder: Path) -> dict[str, Generated]:
    """The static functions named, with the lengths of their results, made callable."""
    lines = [f"ModelFunction *const exported_{name} = {name};\n" for name in functions]
    library = compile_shared(source + "\n" + "".join(lines), folder)
    form = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(_Pointer), ctypes.POINTER(_Pointer))
    return {
        name: Generated(form(ctypes.c_void_p.in_dll(library, f"exported_{name}").value), sizes)
        for name, sizes in functions.items()
    }
