"""Every built FMU as a file: its description, its parts, its bytes."""

import zipfile

from fmpy.validation import validate_fmu

from fmu_build.pack import host_platform
from tests.contracts.building import build_case


def test_fmpy_finds_nothing_wrong(fmu):
    assert validate_fmu(str(fmu.path)) == []


def test_all_parts_are_there(fmu, fmi):
    with zipfile.ZipFile(fmu.path) as archive:
        names = set(archive.namelist())
        license_text = archive.read("documentation/licenses/license.txt").decode()
        model_c = archive.read("sources/model.c").decode()
    identifier = fmu.description.modelExchange.modelIdentifier
    platform = host_platform()
    binaries = {name for name in names if name.startswith("binaries/")}
    assert binaries == {f"binaries/{platform.folder(fmi)}/{identifier}{platform.suffix}"}
    assert {"documentation/index.html", f"sources/fmi{fmi}Functions.h", "sources/model.h"} <= names
    assert ("sources/buildDescription.xml" in names) == (fmi == 3)
    assert "BSD 3-Clause" in license_text
    assert fmu.description.guid in model_c


def test_the_same_input_gives_the_same_bytes(fmu, case, fmi, tmp_path):
    assert build_case(case, fmi, tmp_path).read_bytes() == fmu.path.read_bytes()


def test_no_path_of_this_machine_is_inside(fmu, tmp_path):
    with zipfile.ZipFile(fmu.path) as archive:
        for name in archive.namelist():
            assert str(tmp_path.parent).encode() not in archive.read(name), name
