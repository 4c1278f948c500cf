import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fmpy.ssp.ssd import read_ssd

from pysim.cosim import (
    Connection,
    Doubling,
    GaussSeidel,
    Iterated,
    System,
    SystemFile,
    cosimulate,
    read_system_file,
)
from pysim.cosim.members import Fmu
from pysim.cosim.ssp import read_ssp, write_ssp
from pysim.cosim.ssp._names import base_unit
from pysim.io import read_model
from pysim.simulate import Rodas
from pysim.types import BadInput, Record, Signal
from tests.pysim.cosim.described import MASS, SPRING, controlled, oscillator
from tests.pysim.simulate.text_models import LAG, text_model


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("ssp")
    oscillator(place)
    controlled(place)
    return place


def ran(file: SystemFile) -> Record:
    return cosimulate(file.system, file.experiment, step=file.step, order=file.order)


def test_what_was_exported_comes_back_and_runs_the_same(folder: Path, tmp_path: Path) -> None:
    file = read_system_file(folder / "oscillator.toml", stop=0.2)
    assert write_ssp(file, tmp_path / "out" / "oscillator.ssp") == ()
    again = read_ssp(tmp_path / "out" / "oscillator.ssp")
    assert (again.name, again.step, again.order) == (file.name, file.step, file.order)
    assert again.system.connections == file.system.connections
    first = ran(file)
    second = ran(again)
    assert second.names == first.names == ("mass.v", "spring.F", "spring.x")  # x is no output of the FMU
    np.testing.assert_array_equal(second.values, first.values)
    shorter = read_ssp(tmp_path / "out" / "oscillator.ssp", stop=0.1, step=2e-3)
    assert (shorter.step, shorter.experiment.times[-1]) == (2e-3, pytest.approx(0.1))


def test_the_stop_is_the_last_row(folder: Path, tmp_path: Path) -> None:
    file = read_system_file(folder / "oscillator.toml", stop=0.205)
    write_ssp(file, tmp_path / "a.ssp")
    times = read_ssp(tmp_path / "a.ssp").experiment.times
    assert times[[0, 1, -2, -1]].tolist() == pytest.approx([0.0, 0.01, 0.2, 0.205], rel=1e-12)


def test_the_description_follows_the_standards_schema(folder: Path, tmp_path: Path) -> None:
    file = read_system_file(folder / "oscillator.toml")
    driven = replace(file, order=Iterated())
    write_ssp(driven, tmp_path / "a.ssp")
    ssd = read_ssd(str(tmp_path / "a.ssp"), validate=True)
    mass, spring = ssd.system.elements
    assert (mass.name, mass.source) == ("mass", "resources/Mass_2.fmu")
    assert [(c.name, c.kind) for c in spring.connectors] == [("v", "input"), ("F", "output")]
    assert [(c.startElement, c.startConnector, c.endElement, c.endConnector) for c in ssd.system.connections] == [
        ("spring", "F", "mass", "F"),
        ("mass", "v", "spring", "v"),
    ]
    assert {unit.name for unit in ssd.units} == {"N", "m/s"}
    assert read_ssp(tmp_path / "a.ssp").order == Iterated()
    with zipfile.ZipFile(tmp_path / "a.ssp") as archive:
        assert sorted(archive.namelist()) == ["SystemStructure.ssd", "resources/Mass_2.fmu", "resources/Spring_2.fmu"]


def test_a_factor_an_offset_and_constant_inputs_go_with_it(folder: Path, tmp_path: Path) -> None:
    text = (
        (folder / "oscillator.toml").read_text().replace('to = "mass.F"', 'to = "mass.F"\nfactor = -1.0\noffset = 8.0')
    )
    text = text.replace('from = "mass.v"\nto = "spring.v"\n', "").replace("[[connections]]\n\n", "")
    text += "\n[inputs]\nspring.v = -0.5\n"
    (folder / "factor.toml").write_text(text)
    file = read_system_file(folder / "factor.toml", stop=0.1)
    write_ssp(file, tmp_path / "factor.ssp")
    read_ssd(str(tmp_path / "factor.ssp"), validate=True)
    record = ran(read_ssp(tmp_path / "factor.ssp"))
    # F = -k (0.1 - 0.5 t) with k = 100, turned round, and 8 N more; m = 4; each step takes the force at its end
    t = record.time
    np.testing.assert_allclose(record["mass.v"], 25.0 * (0.1 * t - 0.25 * t * (t + 1e-3)) + 2.0 * t, atol=1e-9)


def test_fmus_of_one_name_are_kept_apart(folder: Path, tmp_path: Path) -> None:
    paths = []
    for place, capital in (("v1", "pump.fmu"), ("v2", "Pump.fmu"), ("v3", "pump.fmu")):
        (tmp_path / place).mkdir()
        paths.append(tmp_path / place / capital)
        paths[-1].write_bytes((folder / ("Mass_2.fmu" if place == "v1" else "Spring_2.fmu")).read_bytes())
    members = tuple(Fmu(n, read_model(p)) for n, p in zip(("reference", "pump", "pump_2"), paths, strict=True))
    file = read_system_file(folder / "oscillator.toml")
    system = System(members, (Connection("pump.F", "reference.F"), Connection("reference.v", "pump.v")))
    write_ssp(replace(file, system=system, experiment=replace(file.experiment, overrides={})), tmp_path / "a.ssp")
    with zipfile.ZipFile(tmp_path / "a.ssp") as archive:
        sources = [component.source for component in read_ssd(str(tmp_path / "a.ssp")).system.elements]
        assert [archive.read(name) for name in sources] == [path.read_bytes() for path in paths]
        assert len({name.casefold() for name in archive.namelist()}) == 4


def test_settings_that_do_not_go_along_are_told(folder: Path, tmp_path: Path) -> None:
    file = read_system_file(folder / "oscillator.toml")
    mass = Fmu("mass", text_model(MASS, folder), interface="model-exchange", solver=Rodas(rtol=1e-3))
    spring = Fmu("spring", text_model(SPRING, folder, fmi=3), events=False)
    lag = Fmu("lag", text_model(LAG, folder), feedthrough="none", parameters={"u": 1.0})
    system = System((mass, spring, lag), file.system.connections)
    order = GaussSeidel(("spring", "mass", "lag"))
    told = write_ssp(replace(file, system=system, order=order, doubling=Doubling()), tmp_path / "a.ssp")
    assert told == (
        "the doubling of steps",
        "the sequence spring, mass, lag",
        "the solver of mass",
        "that spring handles its events alone",
        "the feedthrough of lag",
    )
    assert write_ssp(replace(file, order=Iterated(rtol=1e-3)), tmp_path / "a.ssp") == ("the limits of the iteration",)


def test_a_package_that_cannot_be_finished_leaves_the_one_before(folder: Path, tmp_path: Path) -> None:
    file, path = read_system_file(folder / "oscillator.toml"), tmp_path / "a.ssp"
    path.write_bytes(b"before")
    lost = tmp_path / "Mass.fmu"
    lost.write_bytes((folder / "Mass_2.fmu").read_bytes())
    members = (Fmu("mass", read_model(lost)), file.system.members[1])
    lost.unlink()
    with pytest.raises(FileNotFoundError):
        write_ssp(replace(file, system=System(members, file.system.connections)), path)
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_python_cannot_be_exported_unless_left_out(folder: Path, tmp_path: Path) -> None:
    file = read_system_file(folder / "controlled.toml")
    with pytest.raises(BadInput, match=r"a\.ssp: SSP holds FMUs and cannot hold controller, which is Python; the wire"):
        write_ssp(file, tmp_path / "a.ssp")
    assert not (tmp_path / "a.ssp").exists()
    left_out = write_ssp(file, tmp_path / "a.ssp", fmus_only=True)
    assert left_out[0] == "controller, which is Python"
    assert len(left_out) == 3
    again = read_ssp(tmp_path / "a.ssp", stop=0.05)
    assert [member.name for member in again.system.members] == ["plant"]
    assert again.experiment.record == ("plant.y",)
    with pytest.raises(BadInput, match=r"nothing drives plant\.u"):
        ran(again)


def test_a_signal_over_time_has_no_room(folder: Path, tmp_path: Path) -> None:
    file = read_system_file(folder / "oscillator.toml")
    wave = Signal.lines([0.0, 1.0], [0.0, 1.0])
    driven = replace(file, experiment=replace(file.experiment, inputs={"spring.v": wave}))
    with pytest.raises(BadInput, match=r"cannot hold the signal of spring\.v"):
        write_ssp(driven, tmp_path / "a.ssp")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('source="resources/Mass_2.fmu"', 'source="../Mass_2.fmu"', "outside the package"),
        ("ssd:Component", "ssd:System", "is a System; flatten"),
        ('implementation="CoSimulation"', 'type="application/x-ssp-package"', "only FMUs with shared libraries"),
        ('startElement="spring" ', "", "is driven by the system's own connector F"),
        ('startConnector="F"', 'startConnector="G"', r"no output 'spring\.G'"),
        ('name="m"', 'name="weight"', "no variable 'weight'"),
        ('value="4.0"', 'value="four"', "m = 'four' is no number"),
        ("<ssd:System ", "<ssd:System", "cannot be read"),
    ],
)
def test_what_is_not_understood_is_refused(folder: Path, tmp_path: Path, old: str, new: str, message: str) -> None:
    good, bad = tmp_path / "good.ssp", tmp_path / "bad.ssp"
    write_ssp(read_system_file(folder / "oscillator.toml"), good)
    with zipfile.ZipFile(good) as source, zipfile.ZipFile(bad, "w") as target:
        for item in source.infolist():
            content = source.read(item)
            if item.filename == "SystemStructure.ssd":
                assert old.encode() in content
                content = content.replace(old.encode(), new.encode())
            target.writestr(item, content)
    with pytest.raises(BadInput, match=message):
        read_ssp(bad)


def test_no_package(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="no SSP package at"):
        read_ssp(tmp_path / "missing.ssp")
    with zipfile.ZipFile(tmp_path / "empty.ssp", "w") as archive:
        archive.writestr("a.txt", "")
    with pytest.raises(BadInput, match=r"holds no SystemStructure\.ssd"):
        read_ssp(tmp_path / "empty.ssp")


@pytest.mark.parametrize(
    ("unit", "expected"),
    [
        ("N.m/rad", {"kg": "1", "m": "2", "s": "-2", "rad": "-1"}),
        ("m3/s", {"m": "3", "s": "-1"}),
        ("Pa", {"kg": "1", "m": "-1", "s": "-2"}),
        ("%/s", {"s": "-1", "factor": "0.01"}),
        ("furlong", None),
    ],
)
def test_units_in_base_units(unit: str, expected: dict[str, str] | None) -> None:
    assert base_unit(unit) == expected
