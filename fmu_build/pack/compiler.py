"""C sources to a shared library for any platform, by the C compiler in the Python package ziglang."""

import errno
import importlib.util
import os
import subprocess
from collections.abc import Sequence
from pathlib import Path

from fmu_build.cache import cache_folder
from fmu_build.errors import BuildError
from fmu_build.pack.platforms import Platform

FLAGS = (
    *("-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror"),
    *("-O3", "-fno-math-errno", "-fno-trapping-math"),  # safe ones: NaN, infinities and rounding stay as they are
    *("-shared", "-fPIC", "-fvisibility=hidden"),
    *("-g0", "-s", "-fno-sanitize=all"),  # no debug data, and so no paths of this machine, in the binary
)
_NO_ROOM = "NoSpaceLeft"  # Zig's name for it
_LONGEST_S = 900.0  # the very first build for Windows compiles zig's C library, some minutes on a slow machine


class CompilerError(Exception):
    """The compiler refused what we generated: our mistake, not the user's."""


def compile_shared(sources: Sequence[Path], includes: Sequence[str], platform: Platform, library: Path) -> bytes:
    """The bytes of a shared library made of absolute `sources`; it is also left at `library`.

    Args:
        includes: the compiler's options for folders of headers.

    The compiler works in the folder of the last source: zig remembers what it has compiled by the working folder, and
    one that stays the same spares compiling the run-time system for each model. No path gets into the library.
    """
    command = [_zig(), "cc", "-target", platform.zig_target, *FLAGS, *_linker_flags(platform, library)]
    command += [*includes, *(str(source) for source in sources)]
    kept = str(cache_folder("zig"))  # zig links what it has compiled before: from where no other user can write
    try:
        done = subprocess.run(
            [*command, "-lm", "-o", str(library)],
            cwd=sources[-1].parent,
            env={**os.environ, "ZIG_GLOBAL_CACHE_DIR": kept, "ZIG_LOCAL_CACHE_DIR": kept},
            capture_output=True,
            text=True,
            errors="replace",
            timeout=_LONGEST_S,
            check=False,
        )
    except OSError as error:
        raise BuildError(f"the C compiler of ziglang cannot be started: {error}; reinstall it.") from error
    except subprocess.TimeoutExpired as error:
        raise BuildError(
            f"{platform.name}: the C compiler was not done after {_LONGEST_S:g} s; try again when the machine is less "
            "busy, or build a smaller model."
        ) from error
    if done.returncode and _NO_ROOM in done.stderr:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    if done.returncode:
        raise CompilerError(f"{platform.name}: the C compiler failed.\n{done.stderr.strip()}")
    return library.read_bytes()


def _linker_flags(platform: Platform, library: Path) -> list[str]:
    if platform.suffix == ".so":
        return ["-Wl,-z,defs"]  # elsewhere a missing symbol is an error anyway
    if platform.suffix == ".dylib":
        return [f"-Wl,-install_name,@rpath/{library.name}"]  # else the whole path is kept inside
    return []


def _zig() -> str:
    """The compiler's program; started directly, which saves the start of a second Python."""
    spec = importlib.util.find_spec("ziglang")
    if spec is None or not spec.submodule_search_locations:
        raise BuildError("building an FMU needs the C compiler of the Python package ziglang: pip install ziglang.")
    folder = Path(spec.submodule_search_locations[0])
    for name in ("zig", "zig.exe"):
        if (folder / name).exists():
            return str(folder / name)
    raise BuildError(f"the package ziglang in {folder} holds no compiler; reinstall it: pip install ziglang.")
