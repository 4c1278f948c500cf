"""Every built FMU as a file: its description, its parts, its bytes."""

import tempfile
import zipfile
from pathlib import Path

import pytest
from fmpy.validation import validate_fmu

from fmu_build.pack import host_platform
from tests.cases import CASES
from tests.conftest import new_cache
from tests.contracts.building import build_case
from tests.contracts.fmu import Fmu


def test_fmpy_finds_nothing_wrong(fmu: Fmu) -> None:
    """The whole check, with that of the variables' names, which a build leaves to the emitter."""
    assert validate_fmu(str(fmu.path)) == []


def test_all_parts_are_there(fmu: Fmu, fmi: int) -> None:
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


@pytest.mark.parametrize("fmi", [2, 3])
def test_the_same_input_gives_the_same_bytes(fmi: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = build_case(
        CASES[0], fmi, tmp_path, use_cache=False
    ).read_bytes()  # one that is kept may be an earlier version's
    monkeypatch.setenv("HTB_CACHE", str(new_cache(tmp_path / "another")))
    assert build_case(CASES[0], fmi, tmp_path).read_bytes() == first


def test_no_path_of_this_machine_is_inside(fmu: Fmu) -> None:
    places = {str(Path(__file__).parents[2]), str(Path.home()), str(Path(tempfile.gettempdir()) / "fmu_build-")}
    with zipfile.ZipFile(fmu.path) as archive:
        for name in archive.namelist():
            content = archive.read(name)
            assert not [place for place in places if place.encode() in content], name
