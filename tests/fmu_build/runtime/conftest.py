"""Compiles the runtime with a model and a test program in C, and runs it."""

import importlib.util
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

RUNTIME = Path(__file__).parents[3] / "fmu_build" / "runtime"
_WARNINGS = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wstrict-prototypes", "-Werror"]
_SANITIZERS = ["-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
_LONGEST_S = 300.0


@dataclass(frozen=True)
class Compiler:
    """A C compiler as a command, with its options; `suffix` is that of programs it makes."""

    command: tuple[str, ...]
    options: tuple[str, ...]


def system_compiler() -> Compiler | None:
    """gcc or clang, with sanitizers, if one is installed; there are none for MinGW."""
    found = next((path for name in ("gcc", "clang") if (path := shutil.which(name))), None)
    return Compiler((found,), tuple(_SANITIZERS)) if found and sys.platform != "win32" else None


def zig() -> Compiler:
    """The compiler that builds our FMUs, optimised as there."""
    options = ["-O3", "-fno-math-errno", "-fno-trapping-math", "-fno-sanitize=all"]
    return Compiler((sys.executable, "-m", "ziglang", "cc"), tuple(options))


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


@dataclass(frozen=True)
class Builder:
    """Compiles each runtime source once for all the test programs of a session."""

    compiler: Compiler
    folder: Path

    def _object(self, source: Path) -> Path:
        made = self.folder / f"{source.parent.name}_{source.stem}.o"
        if not made.exists():
            include = [f"-I{RUNTIME / name}" for name in ("include", "src")]
            options = [*_WARNINGS, *self.compiler.options, *include, "-isystem", str(fmi_headers())]
            run([*self.compiler.command, *options, "-c", str(source), "-o", str(made)])
        return made

    def __call__(self, test: str, model: str, *, fmi: int = 2) -> str:
        """Builds test/`test`.c with test/`model`.c and runs it; returns what it prints."""
        mine = [RUNTIME / "test" / f"{name}.c" for name in (test, model)]
        program = self.folder / f"{test}_{model}.exe"
        objects = [str(self._object(source)) for source in (*mine, *sources(fmi))]
        run([*self.compiler.command, *self.compiler.options, *objects, "-lm", "-o", str(program)])
        return run([str(program)])


@pytest.fixture(scope="session", params=["sanitized", "zig"])
def c_test(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Callable[..., str]:
    """A function (test, model, fmi=2) that builds and runs a C test, under sanitizers and with zig."""
    compiler = system_compiler() if request.param == "sanitized" else zig()
    if compiler is None:
        pytest.skip("no gcc or clang here, so no address and undefined-behaviour sanitizers")
    return Builder(compiler, tmp_path_factory.mktemp(request.param))
