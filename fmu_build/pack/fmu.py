"""An OdeModel to a checked .fmu."""

import hashlib
import os
import uuid
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import groupby
from pathlib import Path

from fmu_build.emit import (
    GENERATION_TOOL,
    Description,
    c_source,
    complete_table,
    fmi2_description,
    fmi3_build_description,
    fmi3_description,
    model_identifier,
)
from fmu_build.lower.ode_model import OdeModel
from fmu_build.pack.archive import check_writable, write_archive
from fmu_build.pack.compiler import compile_shared
from fmu_build.pack.documentation import documentation_page
from fmu_build.pack.mach_o import fat_library
from fmu_build.pack.platforms import Platform
from fmu_build.pack.sources import Sources, sources_for
from fmu_build.pack.validation import validate_own
from fmu_build.scratch import scratch
from fmu_build.version import version

_NO_TOKEN = "{00000000-0000-0000-0000-000000000000}"
_LICENSE = Path(__file__).with_name("license.txt")


def pack(model: OdeModel, output: Path, *, fmi: int, platforms: Sequence[Platform]) -> None:
    """Write the FMU of `model`; the same arguments give the same bytes.

    Raises:
        BuildError: the target cannot be written, a package is missing, or the FMU fails FMPy's validation.
        CompilerError: the generated C does not compile.
    """
    check_writable(output)
    model = complete_table(model)
    sources = sources_for(fmi)
    members = _texts(model, sources, fmi)
    token = _token(members)
    for path in ("modelDescription.xml", "sources/model.c"):
        members[path] = members[path].replace(_NO_TOKEN.encode(), token.encode())
    tool = f'generationTool="{GENERATION_TOOL}'.encode()  # no part of the token, which a later version gives again
    members["modelDescription.xml"] = members["modelDescription.xml"].replace(tool, tool + f" {version()}".encode())
    model_c = members["sources/model.c"]
    members |= _binaries(model_c, sources, model_identifier(model.name), fmi, platforms)
    write_archive(output, members, validate_own)


def _texts(model: OdeModel, sources: Sources, fmi: int) -> dict[str, bytes]:
    """All members but the binaries, with `_NO_TOKEN` for the token."""
    files = ("model.c", *(path.name for path in sources.compiled))
    about = Description(_NO_TOKEN, model_identifier(model.name), files)
    describe = fmi2_description if fmi == 2 else fmi3_description
    members = {f"sources/{name}": content for name, content in sources.contents().items()}
    members["sources/model.c"] = c_source(model, _NO_TOKEN).encode()
    members["modelDescription.xml"] = describe(model, about).encode()
    members["documentation/index.html"] = documentation_page(model).encode()
    members["documentation/licenses/license.txt"] = _LICENSE.read_bytes().replace(b"\r\n", b"\n")
    if fmi == 3:
        members["sources/buildDescription.xml"] = fmi3_build_description(about).encode()
    return members


def _token(members: Mapping[str, bytes]) -> str:
    """The same content has the same token, another content another one."""
    digest = hashlib.sha256()
    for path, content in sorted(members.items()):
        digest.update(f"{path}\0{len(content)}\0".encode() + content)
    return "{" + str(uuid.UUID(bytes=digest.digest()[:16], version=5)) + "}"


def _binaries(
    model_c: bytes, sources: Sources, identifier: str, fmi: int, platforms: Sequence[Platform]
) -> dict[str, bytes]:
    """Libraries by their place in the FMU; where platforms share a folder (FMI 2 on macOS), one for all of them."""

    def place(platform: Platform) -> str:
        return f"binaries/{platform.folder(fmi)}/{identifier}{platform.suffix}"

    with scratch() as folder:
        (folder / "model.c").write_bytes(model_c)
        files = (folder / "model.c", *sources.compiled)

        def compiled(platform: Platform) -> bytes:
            library = folder / platform.name / Path(place(platform)).name
            library.parent.mkdir()
            return compile_shared(files, sources.includes, platform, library)

        ordered = sorted(platforms, key=place)
        with ThreadPoolExecutor(os.cpu_count()) as side_by_side:  # each waits for a compiler, a process of its own
            libraries = zip(ordered, side_by_side.map(compiled, ordered), strict=True)
            groups = groupby(libraries, key=lambda pair: place(pair[0]))
            return {path: fat_library([library for _, library in group]) for path, group in groups}
