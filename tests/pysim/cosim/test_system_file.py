from pathlib import Path

import numpy as np
import pytest

from pysim.cosim import Doubling, GaussSeidel, Iterated, Jacobi, Sampled, SystemFile, cosimulate, read_system_file
from pysim.cosim.members import Fmu, Isolated
from pysim.types import BadInput, Record
from tests.pysim.cosim.described import CONTROLLED, OSCILLATOR, controlled, oscillator


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("described")
    oscillator(place)
    controlled(place)
    return place


def ran(file: SystemFile) -> Record:
    return cosimulate(file.system, file.experiment, step=file.step, order=file.order, doubling=file.doubling)


def test_two_fmus_swing_as_they_should(folder: Path) -> None:
    file = read_system_file(folder / "oscillator.toml")
    assert (file.name, file.step, file.order, file.doubling) == ("Mass and spring", 1e-3, GaussSeidel(), None)
    assert file.experiment.record == ("mass.v", "spring.F", "spring.x")
    record, omega = ran(file), np.sqrt(100.0 / 4.0)
    assert record.time.size == 101
    assert record.units == ("m/s", "N", "m")
    np.testing.assert_allclose(record["mass.v"], -0.1 * omega * np.sin(omega * record.time), atol=3e-3)  # order 1
    np.testing.assert_allclose(record["spring.F"], -100.0 * record["spring.x"], atol=1e-9)


def test_a_controller_brings_its_plant_to_the_reference(folder: Path) -> None:
    file = read_system_file(folder / "controlled.toml")
    assert isinstance(file.system.members[1], Sampled)
    record = ran(file)
    assert abs(record["plant.y"][record.time < 1.0]).max() <= 0.3
    assert record["plant.y"][-1] == pytest.approx(3.0, abs=1e-3)
    assert record["controller.u"][-1] == pytest.approx(1.5, abs=1e-3)  # K = 2


def test_settings_of_members_and_of_the_run(folder: Path) -> None:
    text = OSCILLATOR.replace('fmu = "Mass_2.fmu"', 'fmu = "Mass_2.fmu"\ninterface = "model-exchange"\ntime_limit = 5')
    text = text.replace('order = "gauss-seidel"', 'order = "jacobi"\nlines = true\ntolerance = 1e-5\nstart = 0.5')
    file = read_system_file(written(folder, text), stop=2.0, step=1e-2)
    mass = file.system.members[0]
    assert isinstance(mass, Isolated)
    assert isinstance(mass.member, Fmu)
    assert (mass.member.interface, mass.member.parameters) == ("model-exchange", {"m": 4.0})
    assert (file.order, file.doubling, file.step) == (Jacobi(lines=True), Doubling(rtol=1e-5), 1e-2)
    assert (file.experiment.start, file.experiment.times[-1]) == (0.5, pytest.approx(2.0))
    order = read_system_file(written(folder, OSCILLATOR.replace("gauss-seidel", "iterated"))).order
    assert order == Iterated()


def test_a_class_beside_the_file(folder: Path) -> None:
    (folder / "mine.py").write_text(
        "from pysim.control import Gain\n\n\nclass Doubled(Gain):\n    def __init__(self, by):\n"
        "        super().__init__(2 * by)\n",
        encoding="utf-8",
    )
    text = CONTROLLED.replace('"pysim.control.PI"', '"mine.py:Doubled"')
    text = text.replace("{ K_p = 1.0, T_i = 0.5, dt = 0.01 }", "{ by = 0.5 }")
    text = text.replace("controller.measured", "controller.u").replace("controller.reference", '"plant.u"')
    text = text.replace('from = "controller.u"', 'from = "controller.y"').replace('"controller.u"]', '"controller.y"]')
    with pytest.raises(BadInput, match=r"plant\.u has a signal and is driven by controller\.y"):
        ran(read_system_file(written(folder, text, "own.toml")))
    text = text.replace('"plant.u" = "reference.csv"', "")
    record = ran(read_system_file(written(folder, text, "own.toml")))
    # u = y: 0.5 y' = 2 u - y = y, sampled every 10 ms
    assert record["plant.y"][100] == pytest.approx(0.3 * (2 - np.exp(-0.01 / 0.5)) ** 100, rel=1e-4)


PLAIN = """class Law:
    def __init__(self, K_p, T_i, dt=None):
        self.K_p, self.T_i, self.integral = K_p, T_i, 0.0
        if dt:
            self.dt = dt
    def step(self, t, reference, measured):
        error = reference - measured
        self.integral += error * 0.01 / self.T_i
        return self.K_p * (error + self.integral)
"""


@pytest.mark.parametrize(("own", "every"), [(", dt = 0.01", "every = 0.01"), (", dt = 0.01", ""), ("", "")])
def test_a_plain_class_is_a_controller_too(folder: Path, own: str, every: str) -> None:
    """As in `pysim.cosimulate`: its arguments are the inputs, wires name its output, the run gives its rate."""
    (folder / "plain.py").write_text(PLAIN, encoding="utf-8")
    text = CONTROLLED.replace('"pysim.control.PI"', '"plain.py:Law"').replace(", dt = 0.01", own)
    file = read_system_file(written(folder, text.replace("every = 0.01", every), "plain.toml"))
    (part,) = (one for one in file.system.members if isinstance(one, Sampled))
    assert ([p.name for p in part.inputs], [p.name for p in part.outputs]) == (["reference", "measured"], ["u"])
    assert part.every == 0.01
    first = ran(file)
    assert first["plant.y"][-1] == pytest.approx(3.0, abs=1e-3)
    assert ran(file)["plant.y"] == pytest.approx(first["plant.y"], abs=0.0)  # the integral begins anew


def test_a_controller_that_drives_nothing_is_refused(folder: Path) -> None:
    wire = '[[connections]]\nfrom = "controller.u"\nto = "plant.u"\n'
    text = CONTROLLED.replace(wire, "").replace("controller.reference", "plant.u = 0.0\ncontroller.reference")
    assert ran(read_system_file(written(folder, text)))["controller.u"].any()  # the run records it by name
    text = text.replace('record = ["plant.y", "controller.u"]', "")
    with pytest.raises(BadInput, match=r"other\.toml: system: controller\.u goes nowhere, so controller does nothing"):
        read_system_file(written(folder, text))


def written(folder: Path, text: str, name: str = "other.toml") -> Path:
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("spring.F", "spring.G", r"other\.toml, line 12: system: there is no output 'spring\.G'; .*spring\.F"),
        (
            '[[connections]]\nfrom = "mass.v"\nto = "spring.v"',
            "",
            r"nothing drives spring\.v; add \[\[connections\]\] with ",
        ),
        ('to = "mass.F"', 'to = "mass.F"\noffset = "a"', "line 12: offset = 'a' is no finite number"),
        ('to = "mass.F"', 'to = "spring.v"', r"line 12: connection .*in 'N', the input in 'm/s'"),
        ('"mass.F"\n', '"mass.F"\nfactor = 2.0\ngain = 1\n', "line 12: the key 'gain' is not known"),
        ("m = 4.0", "M = 4.0", r"line 4: Mass_2\.fmu has no variable 'M'"),
        ("m = 4.0", 'm = "heavy"', r"line 4, parameters: m = 'heavy' is no finite number"),
        ("Mass_2.fmu", "Nothing.fmu", r"line 4: no FMU at .*Nothing\.fmu"),
        ('fmu = "Mass_2.fmu"', 'inertia = "a"', 'line 4: say what mass is: fmu = "FILE.fmu", block'),
        ('fmu = "Mass_2.fmu"', 'fmu = "Mass_2.fmu"\ntolerance = 1e-3', "line 4: an FMU that steps by itself takes no"),
        ('fmu = "Mass_2.fmu"', 'fmu = "Mass_2.fmu"\nsteps = 2', "line 4: the key 'steps' is not known"),
        ('order = "gauss-seidel"', 'order = "euler"', "line 23: order = 'euler' is not known"),
        ('order = "gauss-seidel"', 'sequence = ["spring", "mass"]', "line 23: jacobi steps know no sequence"),
        ("step = 1e-3", "", "line 23: step is missing"),
        ("stop = 1.0", "stop = 0.0", "line 23: no row lies between"),
        ("stop = 1.0", "", "line 23: stop is missing"),
        ("[run]", "[runs]", "the key 'runs' is not known"),
        (
            "spring.k = 100.0",
            'spring.k = "x"',
            r"spring\.k = 'x' is no finite number",
        ),
    ],
)
def test_what_is_wrong_is_said_with_its_line(folder: Path, old: str, new: str, message: str) -> None:
    assert old in OSCILLATOR
    with pytest.raises(BadInput, match=message):
        read_system_file(written(folder, OSCILLATOR.replace(old, new, 1)))


def test_the_stop_is_the_last_row(folder: Path) -> None:
    assert "rows_every = 0.01" in OSCILLATOR
    text = OSCILLATOR.replace("rows_every = 0.01", "rows_every = 0.3")
    file = read_system_file(written(folder, text))
    assert file.experiment.times.tolist() == pytest.approx([0.0, 0.3, 0.6, 0.9, 1.0], rel=1e-15)
    assert ran(file).time[-1] == 1.0
    with pytest.raises(BadInput, match=r"line 23: stop = 1\.0005 s is no whole number of steps of 0\.001 s"):
        read_system_file(written(folder, text), stop=1.0005)


def test_empty_tables_are_none(folder: Path) -> None:
    text = OSCILLATOR.replace("spring.k = 100.0", "") + "[inputs]\n"
    assert "[overrides]" in text
    found = read_system_file(written(folder, text))
    assert not found.experiment.inputs
    assert not found.experiment.overrides


def test_what_a_controller_misses_is_not_taken_for_its_file(folder: Path) -> None:
    (folder / "reads.py").write_text('K_p = open("gains.csv")\n')
    message = r"line 5: reads\.py cannot be imported \(FileNotFoundError: .*gains\.csv'\); mend it"
    with pytest.raises(BadInput, match=message):
        read_system_file(written(folder, CONTROLLED.replace("pysim.control.PI", "reads.py:PI")))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("pysim.control.PI", "PI", "line 5: 'PI' names no class; write \"package.module.Class\""),
        ("pysim.control.PI", "pysim.control.PD", "line 5: pysim.control has no class 'PD'; its classes: .*PI, "),
        ("pysim.control.PI", "no_such_package.PI", "line 5: no_such_package cannot be imported"),
        ("pysim.control.PI", "nowhere.py:PI", "line 5: there is no file"),
        ("K_p = 1.0, ", "", r"line 5: pysim\.control\.PI does not take these settings .*; it takes K_p, T_i, dt"),
        ("T_i = 0.5", "T_i = -0.5", "line 5: PI: K_p"),
        ("dt = 0.01 }", "dt = 0.02 }", "line 5: controller: the block has dt = 0.02 s but is sampled every 0.01 s"),
        ('"reference.csv"', '"lost.csv"', r"^\S+\.toml, line \d+, controller\.reference: cannot read .*lost\.csv"),
        ('"reference.csv"', "true", r"line \d+, controller\.reference: True is no number; write one"),
    ],
)
def test_what_is_wrong_with_a_block(folder: Path, old: str, new: str, message: str) -> None:
    assert old in CONTROLLED
    with pytest.raises(BadInput, match=message):
        read_system_file(written(folder, CONTROLLED.replace(old, new, 1)))
