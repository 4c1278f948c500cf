"""How a case becomes an .fmu."""

from collections.abc import Callable
from pathlib import Path

from fmu_build import build
from fmu_build.emit import model_identifier
from tests.cases import Case
from tests.contracts.fmu import Fmu

Built = Callable[[Case, int], Fmu]  # (case, FMI version) -> unpacked FMU


def build_case(case: Case, fmi: int, folder: Path, *, use_cache: bool = True) -> Path:
    """The .fmu of a case. `folder` takes its Modelica text; with `use_cache` the file is that of the shared store."""
    libraries = []
    if case.text:
        library = folder / f"{model_identifier(case.class_name)}.mo"
        library.write_text(case.text, encoding="utf-8")
        libraries.append(library)
    return build(case.class_name, libraries=libraries, fmi=fmi, probes=case.probes, use_cache=use_cache)
