"""Compiles the runtime with a model and a test program in C, and runs it.

What the compiler makes is kept in build/c-tests by the content it was made from, so that only the first run compiles.
"""

import functools
import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
import time
import uuid
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
RUNTIME = ROOT / "fmu_build" / "runtime"
STORE = ROOT / "build" / "c-tests"
_WARNINGS = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wstrict-prototypes", "-Werror"]
_SANITIZERS = ["-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
_LONGEST_S = 300.0
_KEPT_S = 14 * 86400.0  # since its last use


@dataclass(frozen=True)
class Compiler:
    """A C compiler as a command, with its options."""

    command: tuple[str, ...]
    options: tuple[str, ...]

    @functools.cached_property
    def version(self) -> str:
        return run([*self.command, "--version"])


def compiler() -> Compiler:
    """gcc or clang with sanitizers; where there is neither, or on Windows, the one that builds our FMUs."""
    found = next((path for name in ("gcc", "clang") if (path := shutil.which(name))), None)
    if found and sys.platform != "win32":
        return Compiler((found,), tuple(_SANITIZERS))
    return Compiler((sys.executable, "-m", "ziglang", "cc"), ("-O1", "-fno-sanitize=all"))


def fmi_headers() -> Path:
    spec = importlib.util.find_spec("fmpy")
    assert spec is not None
    assert spec.origin is not None
    return Path(spec.origin).parent / "c-code"


def sources(fmi: int) -> list[Path]:
    """The runtime as it is compiled into an FMU of that version."""
    other = f"fmi{5 - fmi}"
    return sorted(path for path in (RUNTIME / "src").glob("*.c") if not path.name.startswith(other))


def run(command: list[str]) -> str:
    """What the command prints; the test fails with its errors if it does."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=_LONGEST_S, check=False)
    assert done.returncode == 0, f"{' '.join(command[:3])} ...\n{done.stderr}"
    return done.stdout


def digest(parts: Sequence[str | bytes]) -> str:
    found = hashlib.sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        found.update(f"{len(data)}\0".encode() + data)
    return found.hexdigest()[:24]


class Builder:
    """Compiles each source once, for all the test programs and all the runs that have the same content."""

    def __init__(self, compiler: Compiler) -> None:
        self.compiler = compiler
        headers = sorted([*RUNTIME.rglob("*.h"), *fmi_headers().glob("fmi*.h")])
        self._common: list[str | bytes] = [
            compiler.version,
            *_WARNINGS,
            *compiler.options,
            *(path.read_bytes() for path in headers),
        ]
        self._objects: dict[Path, Path] = {}
        for source in sorted({*sources(2), *sources(3)}):
            self._object(source)

    def __call__(self, test: str, model: str, *, fmi: int = 2) -> str:
        """Builds test/`test`.c with test/`model`.c and runs it; returns what it prints."""
        mine = [RUNTIME / "test" / f"{name}.c" for name in (test, model)]
        objects = [self._object(source) for source in (*mine, *sources(fmi))]
        name = f"{test}-{model}-{digest([path.name for path in objects])}.exe"
        return run([str(self._made(name, [*map(str, objects), "-lm"], self.compiler.options))])

    def _object(self, source: Path) -> Path:
        if source not in self._objects:
            include = [f"-I{RUNTIME / name}" for name in ("include", "src")]
            options = [*_WARNINGS, *self.compiler.options, *include, "-isystem", str(fmi_headers())]
            name = f"{source.stem}-{digest([*self._common, source.read_bytes()])}.o"
            self._objects[source] = self._made(name, ["-c", str(source)], options)
        return self._objects[source]

    def _made(self, name: str, inputs: Sequence[str], options: Sequence[str]) -> Path:
        """The file of this name in the store; another process may make it at the same time."""
        target = STORE / name
        if not target.exists():
            STORE.mkdir(parents=True, exist_ok=True)
            partial = STORE / f"{uuid.uuid4().hex}.tmp"
            run([*self.compiler.command, *options, *inputs, "-o", str(partial)])
            os.replace(partial, target)
        os.utime(target)
        return target


@pytest.fixture(scope="session")
def c_test() -> Iterator[Callable[..., str]]:
    """A function (test, model, fmi=2) that builds and runs a C test, under sanitizers where this machine has them."""
    yield Builder(compiler())
    for path in STORE.glob("*"):
        if time.time() - path.stat().st_mtime > _KEPT_S:
            path.unlink(missing_ok=True)
