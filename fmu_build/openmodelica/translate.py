"""A class to an FMU by OpenModelica."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from fmu_build.emit import model_identifier
from fmu_build.errors import BuildError
from fmu_build.front.overrides import Override, modification
from fmu_build.openmodelica.gates import accept
from fmu_build.openmodelica.session import Session, open_session, quoted
from fmu_build.scratch import scratch

# Without it a co-simulation FMU of OpenModelica takes explicit Euler steps of the size of the communication step.
OPTIONS = ("--fmiFlags=s:cvode",)


def translate(
    class_name: str,
    libraries: Sequence[Path],
    overrides: Mapping[str, Override],
    output: Path,
    options: Sequence[str] = (),
) -> None:
    """Write the class's FMI 2 FMU, model exchange and co-simulation in one, for this machine.

    Args:
        libraries: directories with a package.mo, or single .mo files; one that uses another behind it.
        overrides: parameter values by name inside the class; they become modifications.
        options: of omc's command line, such as "--maxSizeLinearTearing=400", behind our own.
    Raises:
        BuildError: OpenModelica is missing or refuses the class, or the FMU does not pass the checks.
    """
    with scratch() as folder, open_session() as session:
        _prepare(session, folder, libraries, options)
        built = _build(session, folder, class_name, modification(overrides))
        accept(built, output)


def _prepare(session: Session, folder: Path, libraries: Sequence[Path], options: Sequence[str]) -> None:
    if not session.ask(f"cd({quoted(folder)})"):
        raise BuildError(f"omc cannot work in {folder}: {session.reason()}")
    for option in (*OPTIONS, *options):
        session.require(f"setCommandLineOptions({quoted(option)})")
    for library in libraries:
        file = library / "package.mo" if library.is_dir() else library
        session.require(f"loadFile({quoted(file.resolve())})")


def _build(session: Session, folder: Path, class_name: str, modified: str) -> Path:
    """The FMU as omc leaves it in the folder."""
    identifier = model_identifier(class_name)
    if modified:
        named = f"{identifier}_"  # a class of this name beside the packages; the FMU keeps its own
        session.require(f"loadString({quoted(f'model {named} extends {class_name}{modified}; end {named};')})")
        class_name = named
    call = f'buildModelFMU({class_name}, version="2.0", fmuType="me_cs", fileNamePrefix={quoted(identifier)}, '
    call += 'platforms={"static"}, includeResources=true)'
    fmu = folder / f"{identifier}.fmu"
    try:
        answer = session.ask(call)
    except BuildError:
        if not fmu.is_file():
            raise
        answer = str(fmu)  # omc also reports errors it has recovered from: what the FMU is worth, the checks say
    if not answer or not fmu.is_file():
        raise BuildError(f"omc has built no FMU of {class_name}: {session.reason()}")
    return fmu
