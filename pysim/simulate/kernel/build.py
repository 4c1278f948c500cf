"""Builds the kernel from its C sources with the compiler in the package ziglang, for this machine or for all.

`python -m pysim.simulate.kernel.build` puts a library for every platform into the package, as a wheel carries them.
Where there is none for this machine, `build_kernel` makes it at first use, in some seconds, and keeps it in the user's
cache.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

from pysim.io import cache_folder
from pysim.types import BadInput

SOURCES = Path(__file__).parent / "src"
PREBUILT = Path(__file__).parent / "prebuilt"

# Platform -> target of zig and suffix of a shared library. Linux libraries ask for glibc 2.17 (2012) or later.
TARGETS = {
    "x86_64-linux": ("x86_64-linux-gnu.2.17", ".so"),
    "x86_64-windows": ("x86_64-windows-gnu", ".dll"),
    "x86_64-darwin": ("x86_64-macos", ".dylib"),
    "aarch64-linux": ("aarch64-linux-gnu.2.17", ".so"),
    "aarch64-darwin": ("aarch64-macos", ".dylib"),
}
_SYSTEMS = {"linux": "linux", "win32": "windows", "darwin": "darwin"}
_PROCESSORS = {"x86_64": "x86_64", "amd64": "x86_64", "arm64": "aarch64", "aarch64": "aarch64"}

# NaN, infinities and rounding stay as they are, and no product is fused with its sum: every processor gives the same
# bits. A loop over a dozen numbers stays a loop. No debug data, and so no paths of this machine.
FLAGS = (
    *("-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror"),
    *("-O3", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=off", "-fno-builtin-memcpy"),
    *("-shared", "-fPIC", "-fvisibility=hidden", "-g0", "-s", "-fno-sanitize=all"),
)
_LONGEST = 900.0  # s; the first build for Windows compiles zig's C library


def build_kernel() -> Path:
    """The kernel's library for this machine, compiled if nobody did so before, which takes some seconds.

    Raises:
        BadInput: no compiler, a platform that is not known, or a cache that cannot be used.
    """
    found = _find()
    if found is not None:
        return found
    name, folder = this_platform(), cache_folder("kernel")
    suffix = TARGETS[name][1]
    with tempfile.TemporaryDirectory(dir=folder) as work:
        library = Path(work) / f"kernel{suffix}"
        compile_for(name, library)
        path = _place(folder, library.read_bytes(), suffix)
        os.replace(library, path)
    return path


def kernel_is_built() -> bool:
    """Whether this machine holds the kernel's library already."""
    return _find() is not None


def _find() -> Path | None:
    """The library for this machine, in the package or in the cache."""
    suffix = TARGETS[this_platform()][1]
    ready = PREBUILT / this_platform() / f"kernel-{source_key()}{suffix}"
    if ready.is_file():
        return ready
    folder = cache_folder("kernel")
    for path in folder.glob(f"{source_key()}-*{suffix}"):
        if path != _place(folder, path.read_bytes(), suffix):
            raise BadInput(f"{path} was changed after it was built; delete it and try again")
        return path
    return None


def _place(folder: Path, content: bytes, suffix: str) -> Path:
    """Where a library is kept: the digest of what it was made from, then its own."""
    return folder / f"{source_key()}-{hashlib.sha256(content).hexdigest()[:32]}{suffix}"


def source_key() -> str:
    """Digest of the sources and of how they are compiled."""
    digest = hashlib.sha256(repr((FLAGS, TARGETS)).encode())
    for path in sorted(SOURCES.glob("*.[ch]")):
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def this_platform() -> str:
    """This machine, by its name in TARGETS.

    Raises:
        BadInput: the kernel cannot be built for it.
    """
    name = f"{_PROCESSORS.get(platform.machine().lower())}-{_SYSTEMS.get(sys.platform)}"
    if name not in TARGETS:
        raise BadInput(f"no simulation on this machine ({platform.machine()}, {sys.platform}); use one of {[*TARGETS]}")
    return name


def compile_for(name: str, library: Path) -> None:
    """Compile the kernel for a platform of TARGETS into the file `library`.

    Raises:
        BadInput: the compiler is missing or refuses.
    """
    sources = [str(path) for path in sorted(SOURCES.glob("*.c"))]
    command = [_zig(), "cc", "-target", TARGETS[name][0], *FLAGS, *sources, "-lm", "-o", str(library)]
    kept = str(cache_folder("zig"))  # zig links what it has compiled before: from where no other user can write
    done = subprocess.run(
        command,
        cwd=SOURCES,
        env={**os.environ, "ZIG_GLOBAL_CACHE_DIR": kept, "ZIG_LOCAL_CACHE_DIR": kept},
        capture_output=True,
        text=True,
        timeout=_LONGEST,
        check=False,
    )
    if done.returncode:
        raise BadInput(f"the kernel could not be compiled for {name}; reinstall ziglang.\n{done.stderr.strip()}")


def _zig() -> str:
    spec = importlib.util.find_spec("ziglang")
    for folder in (spec.submodule_search_locations or []) if spec is not None else []:
        for name in ("zig", "zig.exe"):
            if (Path(folder) / name).is_file():
                return str(Path(folder) / name)
    raise BadInput("simulation needs the C compiler of the Python package ziglang: pip install ziglang")


def build_all(folder: Path = PREBUILT) -> list[Path]:
    """Compile the kernel for every platform; the libraries that `build_kernel` looks for."""
    made = []
    for name, (_, suffix) in TARGETS.items():
        (folder / name).mkdir(parents=True, exist_ok=True)
        for old in (folder / name).iterdir():
            old.unlink()
        made.append(folder / name / f"kernel-{source_key()}{suffix}")
        with tempfile.TemporaryDirectory() as work:  # Windows' linker leaves more than the library
            library = Path(work) / f"kernel{suffix}"
            compile_for(name, library)
            made[-1].write_bytes(library.read_bytes())
    return made


if __name__ == "__main__":
    for path in build_all():
        print(path)
