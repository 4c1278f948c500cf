"""The C files of an FMU, all in one folder: the generated model, the run-time system and the FMI headers."""

import importlib.util
from collections.abc import Iterable
from pathlib import Path

from ..errors import BuildError

RUNTIME = Path(__file__).parents[1] / "runtime"


def runtime_files() -> list[Path]:
    """Every source of the run-time system, headers included."""
    return sorted(path for folder in ("include", "src") for path in (RUNTIME / folder).glob("*.[ch]"))


def source_files(model_c: str, fmi: int) -> dict[str, bytes]:
    """Name and content of each file for one FMI version, in a fixed order.

    A run-time source whose name begins with fmi2 or fmi3 belongs to that version alone.
    """
    other = f"fmi{5 - fmi}"
    paths = [path for path in runtime_files() if not path.name.startswith(other)]
    files = {"model.c": model_c.encode()}
    for path in [*paths, *_fmi_headers(fmi)]:
        files[path.name] = path.read_bytes().replace(b"\r\n", b"\n")
    return files


def compiled(names: Iterable[str]) -> tuple[str, ...]:
    """The files that are given to the compiler."""
    return tuple(name for name in names if name.endswith(".c"))


def _fmi_headers(fmi: int) -> list[Path]:
    """The standard's own headers, as the package fmpy brings them."""
    spec = importlib.util.find_spec("fmpy")
    if spec is None or not spec.submodule_search_locations:
        raise BuildError("building an FMU needs the FMI headers of the Python package fmpy: pip install fmpy.")
    headers = sorted((Path(spec.submodule_search_locations[0]) / "c-code").glob(f"fmi{fmi}*.h"))
    if not headers:
        raise BuildError(f"the package fmpy holds no headers for FMI {fmi}; reinstall it: pip install fmpy.")
    return headers
