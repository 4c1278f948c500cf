"""The whole way: a Modelica class to a checked .fmu."""

import importlib.util
import tempfile
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path

from fmu_build.cache import cached, content_key, copy_whole, store
from fmu_build.errors import BuildError
from fmu_build.pack import Platform, check_writable, select_platforms

BUNDLED_LIBRARY = "HydraulicTestBench"
_NOTHING: Mapping[str, float | str] = {}
_NEEDED = {  # to build; running a finished FMU needs none of them
    "rumoca": "rumoca==0.10.2",
    "casadi": "casadi",
    "ziglang": "ziglang",
    "fmpy": "fmpy",
}


def build(
    class_name: str,
    output: Path | str | None = None,
    *,
    libraries: Sequence[Path | str] = (),
    fmi: int = 2,
    platforms: Sequence[str] = ("host",),
    overrides: Mapping[str, float | str] = _NOTHING,
    probes: Sequence[str] = (),
    use_cache: bool = True,
) -> Path:
    """Compile a Modelica class to an FMU for model exchange and co-simulation.

    Args:
        class_name: full name, such as "HydraulicTestBench.Examples.TimeResponse".
        output: file to write, a path or its text; None leaves the FMU in the cache and gives its place there.
        libraries: directories with a package.mo, or single .mo files, beside our own library.
        fmi: 2 or 3.
        platforms: names of `pack.PLATFORMS`, "host" or "all".
        overrides: values of parameters by their name in the class, in SI units; a text is taken as Modelica.
        probes: continuous variables, by their name in the class, that get a further input "probe.NAME": it is added to
            the right-hand side of the equation of the variable, or of its derivative where the variable is a state.
            At 0, its start value, the model is what it is without. "NAME=VARIABLE" adds a variable of the class itself.
        use_cache: False builds anew even where the same FMU has been built before.
    Returns:
        The FMU's path.
    Raises:
        BuildError: the class, an argument or the installation is at fault; nothing has been written.
    """
    if fmi not in (2, 3):
        raise BuildError(f"there is no FMI version {fmi} here; choose 2 or 3.")
    systems = select_platforms(platforms)
    target = None if output is None else Path(output)
    if target is not None:
        check_writable(target)
    paths = [*_existing(libraries), bundled_library()]
    options = [f"FMI {fmi}", *(system.name for system in systems), *(f"probe {name}" for name in probes)]
    key = content_key(class_name, paths, overrides, options)
    fmu = cached(key) if use_cache else None
    if fmu is None:
        fmu = _build_anew(class_name, paths, overrides, probes, fmi, systems, key)
    if target is None:
        return fmu
    try:
        copy_whole(fmu, target)
    except OSError as error:
        raise BuildError(f"cannot write {target}: {error.strerror or error}; choose another place.") from error
    return target


def bundled_library() -> Path:
    """The folder of our Modelica library: in a checkout beside this package, else installed with it."""
    return Path(str(files("modelica").joinpath(BUNDLED_LIBRARY)))


def _build_anew(
    class_name: str,
    libraries: Sequence[Path],
    overrides: Mapping[str, float | str],
    probes: Sequence[str],
    fmi: int,
    targets: Sequence[Platform],
    key: str,
) -> Path:
    """Build into the cache. The heavy imports are here: a model that is in the cache does not wait for them."""
    _check_installation()
    from fmu_build.front import load
    from fmu_build.lower import lower
    from fmu_build.pack.fmu import pack

    try:
        model = lower(load(class_name, libraries, overrides), probes)
    except RecursionError:
        raise BuildError(
            f"an expression of {class_name} is nested too deeply: a sum of more than some 300 terms, or as many "
            "parentheses within each other; split it into several equations."
        ) from None
    with tempfile.TemporaryDirectory(prefix="fmu_build-") as folder:
        fmu = Path(folder) / "model.fmu"
        pack(model, fmu, fmi=fmi, platforms=targets)
        return store(key, fmu)


def _check_installation() -> None:
    missing = [package for name, package in _NEEDED.items() if importlib.util.find_spec(name) is None]
    if missing:
        raise BuildError(f"building an FMU needs {' and '.join(missing)}: pip install {' '.join(missing)}.")


def _existing(libraries: Sequence[Path | str]) -> list[Path]:
    paths = [Path(library) for library in libraries]
    for path in paths:
        if not path.exists():
            raise BuildError(f"the library {path} does not exist; name a directory with a package.mo, or a .mo file.")
    return paths
