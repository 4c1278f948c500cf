"""The whole way: a Modelica class to a checked .fmu."""

import importlib.util
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from fmu_build.cache import cached, content_key, copy_whole, store
from fmu_build.errors import BuildError, CannotCompile, Underdetermined, WrongCall
from fmu_build.pack import Platform, check_writable, host_platform, select_platforms
from fmu_build.scratch import scratch
from fmu_build.text.libraries import bundled_library

if TYPE_CHECKING:
    from fmu_build.lower import OdeModel

COMPILERS = ("rumoca", "openmodelica")
_NOTHING: Mapping[str, float | str] = {}
_READINGS = 3  # of files that are saved while they are read
_Read = TypeVar("_Read")
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
    compiler: str = "rumoca",
    omc_options: Sequence[str] = (),
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
        compiler: "rumoca", with our own run-time system, or "openmodelica", for an installed omc: that one builds FMI 2
            for this machine, without probes.
        omc_options: for "openmodelica": of omc's command line, such as "--maxSizeLinearTearing=400".
    Returns:
        The FMU's path.
    Raises:
        BuildError: the class, an argument or the installation is at fault; nothing has been written.
        CannotCompile: a BuildError of our own compiler on a class that is there; "openmodelica" may take it.
    """
    if compiler not in COMPILERS:
        raise BuildError(f'there is no compiler "{compiler}" here; choose among {", ".join(COMPILERS)}.')
    if fmi not in (2, 3):
        raise BuildError(f"there is no FMI version {fmi} here; choose 2 or 3.")
    _check_options(omc_options, compiler)
    systems = select_platforms(platforms)
    target = None if output is None else Path(output)
    if target is not None:
        check_writable(target)
    paths = [*_existing(libraries), bundled_library()]
    options = [f"FMI {fmi}", *(system.name for system in systems), *(f"probe {name}" for name in probes)]
    if compiler == "openmodelica":
        options += [_openmodelica(fmi, systems, probes), *omc_options]
    content = partial(content_key, class_name, paths, overrides, options)
    key = content()
    fmu = cached(key) if use_cache else None
    if fmu is None and compiler == "openmodelica":
        fmu = _build_with_openmodelica(class_name, paths, overrides, omc_options, key, content)
    elif fmu is None:
        fmu = _build_anew(class_name, paths, overrides, probes, fmi, systems, key, content)
    if target is None:
        return fmu
    try:
        copy_whole(fmu, target)
    except OSError as error:
        raise BuildError(f"cannot write {target}: {error.strerror or error}; choose another place.") from error
    return target


def _build_anew(
    class_name: str,
    libraries: Sequence[Path],
    overrides: Mapping[str, float | str],
    probes: Sequence[str],
    fmi: int,
    targets: Sequence[Platform],
    key: str,
    content: Callable[[], str],
) -> Path:
    """Build into the cache. The heavy imports are here: a model that is in the cache does not wait for them."""
    _check_installation()
    from fmu_build.pack.fmu import pack

    model, key = _read_unchanged(lambda: _compiled(class_name, libraries, overrides, probes), key, content)
    with scratch() as folder:
        fmu = folder / "model.fmu"
        pack(model, fmu, fmi=fmi, platforms=targets)
        return store(key, fmu)


def _compiled(
    class_name: str, libraries: Sequence[Path], overrides: Mapping[str, float | str], probes: Sequence[str]
) -> "OdeModel":
    from fmu_build.front import load
    from fmu_build.front.open_connectors import refuse_open_connectors
    from fmu_build.lower import lower

    try:
        return lower(load(class_name, libraries, overrides), probes)
    except RecursionError:
        raise CannotCompile(
            f"an expression of {class_name} is nested too deeply: a sum of more than some 300 terms, or as many "
            "parentheses within each other; split it into several equations."
        ) from None
    except WrongCall:
        raise
    except BuildError as error:
        if _is_there(class_name, libraries):
            if isinstance(error, Underdetermined):
                refuse_open_connectors(class_name, libraries)
            raise CannotCompile(error.message, error.file, error.line) from error
        raise


def _build_with_openmodelica(
    class_name: str,
    libraries: Sequence[Path],
    overrides: Mapping[str, float | str],
    options: Sequence[str],
    key: str,
    content: Callable[[], str],
) -> Path:
    """Build into the cache; our own library goes first, since others may use it."""
    _check_installation("fmpy", "casadi")
    from fmu_build.front.open_connectors import refuse_open_connectors
    from fmu_build.openmodelica.translate import translate

    own = bundled_library()
    ordered = [own, *(library for library in libraries if library != own)]
    with scratch() as folder:
        fmu = folder / "model.fmu"
        try:
            _, key = _read_unchanged(lambda: translate(class_name, ordered, overrides, fmu, options), key, content)
        except Underdetermined:
            refuse_open_connectors(class_name, ordered)
            raise
        return store(key, fmu)


def _read_unchanged(read: Callable[[], _Read], key: str, content: Callable[[], str]) -> tuple[_Read, str]:
    """What `read` makes of the files and their key, which is no longer `key` where one has been saved meanwhile."""
    for _ in range(_READINGS):
        result, before, key = read(), key, content()
        if key == before:
            return result, key
    raise BuildError("the Modelica files change while they are read; build again when they have been saved.")


def _openmodelica(fmi: int, systems: Sequence[Platform], probes: Sequence[str]) -> str:
    """The omc that will build, by its version. Raises BuildError for what it cannot do, or where it is missing."""
    from fmu_build.openmodelica import omc_version

    if fmi != 2:
        raise BuildError("OpenModelica builds FMI 2 here; leave FMI 3 to our own compiler.")
    if tuple(systems) != (host_platform(),):
        raise BuildError("OpenModelica builds for this machine only; leave other platforms to our own compiler.")
    if probes:
        raise BuildError("probes are added by our own compiler only; write them into the model as inputs.")
    return f"openmodelica {omc_version()}"


def _check_options(options: Sequence[str], compiler: str) -> None:
    if options and compiler != "openmodelica":
        raise BuildError("options of omc are for OpenModelica; choose it with --compiler openmodelica.")
    for option in options:
        if not option.startswith(("-", "+")) or not option.isprintable():
            raise BuildError(
                f"{option!r} is no option of omc; write it as on its command line, such as -d=initialization."
            )


def _is_there(class_name: str, libraries: Sequence[Path]) -> bool:
    from fmu_build.text import Libraries, TextError

    try:
        Libraries(libraries).find(class_name)
    except TextError:
        return False
    return True


def _check_installation(*names: str) -> None:
    missing = [_NEEDED[name] for name in names or _NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        raise CannotCompile(f"building an FMU needs {' and '.join(missing)}: pip install {' '.join(missing)}.")


def _existing(libraries: Sequence[Path | str]) -> list[Path]:
    paths = [Path(library) for library in libraries]
    for path in paths:
        if not path.exists():
            raise BuildError(f"the library {path} does not exist; name a directory with a package.mo, or a .mo file.")
    return paths
