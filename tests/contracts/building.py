"""How a case becomes an .fmu."""

from pathlib import Path

from fmu_build import build
from fmu_build.emit import model_identifier
from fmu_build.pack import select_platforms
from fmu_build.pack.fmu import pack
from tests.cases import Case


def build_case(case: Case, fmi: int, folder: Path) -> Path:
    """The .fmu of a case, made anew in `folder`."""
    output = folder / f"{case.name}_fmi{fmi}.fmu"
    if case.model is not None:
        pack(case.model(), output, fmi=fmi, platforms=select_platforms(["host"]))
        return output
    libraries = []
    if case.text:
        library = folder / f"{model_identifier(case.class_name)}.mo"
        library.write_text(case.text, encoding="utf-8")
        libraries.append(library)
    return build(case.class_name, output, libraries=libraries, fmi=fmi, probes=case.probes, use_cache=False)
