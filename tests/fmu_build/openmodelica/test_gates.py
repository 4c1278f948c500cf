"""FMUs that are not taken."""

import re
import zipfile

import pytest
from fmpy import simulate_fmu

from fmu_build import BuildError, build
from fmu_build.openmodelica.gates import accept
from fmu_build.openmodelica.kinds import disagreement
from fmu_build.pack import host_platform
from tests.fmu_build.openmodelica.repack import FLAGS, as_of_omc, repacked
from tests.planted import planted


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


def kinds_of(fmu):
    text = description(fmu)
    return {kind for kind in (b"ModelExchange", b"CoSimulation") if b"<" + kind in text}


def test_a_co_simulation_that_differs_is_left_out(tmp_path, caplog):
    """A mass whose damping is a fifth too large as soon as it steps by itself."""
    wrong = as_of_omc(planted("WRONG_RUN", tmp_path), tmp_path / "wrong.fmu")
    assert re.search(r"off by \d+ % of the range", disagreement(wrong))
    accept(wrong, tmp_path / "a.fmu")
    assert kinds_of(tmp_path / "a.fmu") == {b"ModelExchange"}
    assert "model exchange alone" in caplog.text
    simulate_fmu(str(tmp_path / "a.fmu"), stop_time=0.1)


def test_kinds_that_agree_are_both_kept(tmp_path, caplog):
    right = as_of_omc(planted("NONE", tmp_path), tmp_path / "right.fmu")
    assert disagreement(right) == ""
    accept(right, tmp_path / "a.fmu")
    assert kinds_of(tmp_path / "a.fmu") == {b"ModelExchange", b"CoSimulation"}
    assert not caplog.records


def test_our_own_kinds_agree_on_a_model_with_events():
    """The one whose co-simulation by OpenModelica is off by half of its range."""
    own = build("HydraulicTestBench.LoadCircuit.TestBench")
    assert disagreement(own) == ""
