"""The C files of an FMU, all in one folder: the generated model, the run-time system and the FMI headers."""

import importlib.util
from dataclasses import dataclass
from pathlib import Path

from fmu_build.errors import BuildError

RUNTIME = Path(__file__).parents[1] / "runtime"


@dataclass(frozen=True)
class Sources:
    """What is compiled and shipped for one FMI version, beside model.c."""

    runtime: tuple[Path, ...]  # .c and .h
    headers: tuple[Path, ...]  # of the FMI standard

    @property
    def includes(self) -> tuple[str, ...]:
        """Options for the compiler; the standard's headers are not held to our warnings."""
        ours = (f"-I{path.parent}" for path in self.runtime)
        return tuple(dict.fromkeys([*ours, f"-isystem{self.headers[0].parent}"]))

    @property
    def compiled(self) -> tuple[Path, ...]:
        return tuple(path for path in self.runtime if path.suffix == ".c")

    def contents(self) -> dict[str, bytes]:
        """Name and content of each file; they all lie in one folder of the FMU."""
        return {path.name: path.read_bytes().replace(b"\r\n", b"\n") for path in (*self.runtime, *self.headers)}


def sources_for(fmi: int) -> Sources:
    """A run-time source whose name begins with fmi2 or fmi3 belongs to that version alone."""
    other = f"fmi{5 - fmi}"
    runtime = sorted(path for folder in ("include", "src") for path in (RUNTIME / folder).glob("*.[ch]"))
    return Sources(tuple(path for path in runtime if not path.name.startswith(other)), _fmi_headers(fmi))


def _fmi_headers(fmi: int) -> tuple[Path, ...]:
    """The standard's own headers, as the package fmpy brings them."""
    spec = importlib.util.find_spec("fmpy")
    if spec is None or not spec.submodule_search_locations:
        raise BuildError("building an FMU needs the FMI headers of the Python package fmpy: pip install fmpy.")
    headers = sorted((Path(spec.submodule_search_locations[0]) / "c-code").glob(f"fmi{fmi}*.h"))
    if not headers:
        raise BuildError(f"the package fmpy holds no headers for FMI {fmi}; reinstall it: pip install fmpy.")
    return tuple(headers)
