"""FMUs that are not taken."""

import zipfile

import pytest

from fmu_build import BuildError
from fmu_build.openmodelica.gates import accept
from fmu_build.pack import host_platform
from tests.fmu_build.openmodelica.repack import FLAGS, repacked


def description(fmu):
    return zipfile.ZipFile(fmu).read("modelDescription.xml")


def library(fmu):
    return next(name for name in zipfile.ZipFile(fmu).namelist() if name.startswith("binaries/"))


def changed(built, folder, changes):
    return repacked(built, folder / "changed.fmu", changes)


def test_a_good_one_keeps_its_members(built, tmp_path):
    accept(built, tmp_path / "a.fmu")
    before, after = zipfile.ZipFile(built), zipfile.ZipFile(tmp_path / "a.fmu")
    assert {n: before.read(n) for n in before.namelist()} == {n: after.read(n) for n in after.namelist()}
    accept(built, tmp_path / "b.fmu")
    assert (tmp_path / "a.fmu").read_bytes() == (tmp_path / "b.fmu").read_bytes()


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (None, "explicit Euler: this omc does not know"),
        (b'{"s": "euler"}', "solve by euler"),
        (b"{}", "solve by explicit Euler"),
        (b"[]", "solve by explicit Euler"),
        (b"no json", "solve by explicit Euler"),
    ],
)
def test_a_solver_that_is_not_cvode(built, tmp_path, flags, message):
    with pytest.raises(BuildError, match=message):
        accept(changed(built, tmp_path, {FLAGS: flags}), tmp_path / "a.fmu")
    assert not (tmp_path / "a.fmu").exists()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (b'fmiVersion="2.0"', b'fmiVersion="1.0"', "FMI version 1.0"),
        (b"<CoSimulation ", b"<NoSimulation ", "lacks CoSimulation|no readable"),
        (b"</fmiModelDescription>", b"", "no readable modelDescription.xml"),
    ],
)
def test_a_description_of_something_else(built, tmp_path, old, new, message):
    text = description(built)
    assert old in text
    with pytest.raises(BuildError, match=message):
        accept(changed(built, tmp_path, {"modelDescription.xml": text.replace(old, new)}), tmp_path / "a.fmu")


def test_a_description_that_breaks_the_standard(built, tmp_path):
    text = description(built).replace(b'causality="output"', b'causality="local"')  # outputs are still listed as such
    with pytest.raises(BuildError, match="FMPy's validation"):
        accept(changed(built, tmp_path, {"modelDescription.xml": text}), tmp_path / "a.fmu")


def test_a_library_that_is_missing_or_cannot_be_loaded(built, tmp_path):
    name = library(built)
    with pytest.raises(BuildError, match=f"holds no binaries/{host_platform().fmi2_folder}/"):
        accept(changed(built, tmp_path, {name: None}), tmp_path / "a.fmu")
    with pytest.raises(BuildError, match=r"cannot be loaded: .*(invalid ELF header|file too short|Error)"):
        accept(changed(built, tmp_path, {name: b"nonsense"}), tmp_path / "a.fmu")


def test_a_file_that_is_no_fmu(tmp_path):
    (tmp_path / "x.fmu").write_bytes(b"nonsense")
    with pytest.raises(BuildError, match="cannot be read"):
        accept(tmp_path / "x.fmu", tmp_path / "a.fmu")
