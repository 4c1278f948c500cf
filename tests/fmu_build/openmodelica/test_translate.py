"""What omc is asked for a build, and what comes of its answers."""

import zipfile

import numpy as np
import pytest
from fmpy import simulate_fmu

from fmu_build import BuildError, build
from fmu_build.openmodelica.translate import translate

CLASS = "Test.Oscillator"


@pytest.fixture
def library(tmp_path):
    file = tmp_path / "Test.mo"
    file.write_text("package Test\n  model Oscillator\n    parameter Real m = 1;\n  end Oscillator;\nend Test;\n")
    return file


def test_each_step_is_asked_for(omc, library, tmp_path):
    asked = omc()
    translate(CLASS, [library], {}, tmp_path / "a.fmu")
    cd, option, load, make = asked.read_text().splitlines()
    assert cd.startswith('cd("')
    assert option == 'setCommandLineOptions("--fmiFlags=s:cvode")'
    assert load == f'loadFile("{library.resolve().as_posix()}")'
    assert make.startswith('buildModelFMU(Test.Oscillator, version="2.0", fmuType="me_cs", ')
    assert 'fileNamePrefix="Test_Oscillator"' in make
    assert not zipfile.ZipFile(tmp_path / "a.fmu").testzip()


def test_values_become_modifications(omc, library, tmp_path):
    asked = omc()
    translate(CLASS, [library], {"m": 2.5, "part.on": "true"}, tmp_path / "a.fmu")
    load = next(line for line in asked.read_text().splitlines() if line.startswith("loadString"))
    text = "model Test_Oscillator_ extends Test.Oscillator(m = 2.5, part(on = true)); end Test_Oscillator_;"
    assert load == f'loadString("{text}")'
    assert "buildModelFMU(Test_Oscillator_, " in asked.read_text()


def test_a_second_build_comes_from_the_cache(omc, library, tmp_path):
    asked = omc()
    first = build(CLASS, tmp_path / "a.fmu", libraries=[library], compiler="openmodelica")
    again = build(CLASS, tmp_path / "b.fmu", libraries=[library], compiler="openmodelica")
    assert asked.read_text().count("buildModelFMU") == 1
    assert first.read_bytes() == again.read_bytes()
    loaded = [line for line in asked.read_text().splitlines() if line.startswith("loadFile")]
    assert "HydraulicTestBench/package.mo" in loaded[0]  # other libraries may use it
    assert "Test.mo" in loaded[1]


@pytest.mark.parametrize("kind", ["ModelExchange", "CoSimulation"])
def test_what_comes_out_runs(omc, library, tmp_path, kind):
    """2 kg on 50 N/m, a tenth of critical damping, let go at 0.1 m: what is checked and repacked is still the FMU."""
    fmu = build(CLASS, tmp_path / "a.fmu", libraries=[library], compiler="openmodelica")
    result = simulate_fmu(str(fmu), stop_time=2.0, output_interval=0.01, fmi_type=kind, relative_tolerance=1e-8)
    damped = 5 * np.sqrt(1 - 0.1**2)
    time = result["time"]
    force = 5 * np.exp(-0.5 * time) * (np.cos(damped * time) - 0.5 / damped * np.sin(damped * time))
    assert np.abs(result["y"] - force).max() < 5 * 1e-4


def test_an_error_of_the_model_is_passed_on_with_its_place(omc, library, tmp_path):
    messages = [["error", "Too few equations, under-determined system.", str(library), 2]]
    omc(refuses={"buildModelFMU": ['""', messages]})
    with pytest.raises(BuildError, match="under-determined") as caught:
        build(CLASS, tmp_path / "a.fmu", libraries=[library], compiler="openmodelica")
    assert (caught.value.file, caught.value.line) == (library, 2)
    assert not (tmp_path / "a.fmu").exists()


def test_no_fmu_and_no_error_is_a_failure(omc, library, tmp_path):
    omc(refuses={"buildModelFMU": ['""', []], "getErrorString": ['"make: cc: not found"', []]})
    with pytest.raises(BuildError, match=r"has built no FMU of Test.Oscillator: make: cc: not found"):
        translate(CLASS, [library], {}, tmp_path / "a.fmu")


def test_a_folder_omc_cannot_work_in(omc, library, tmp_path):
    omc(refuses={"cd(": ['""', []]})
    with pytest.raises(BuildError, match="omc cannot work in"):
        translate(CLASS, [library], {}, tmp_path / "a.fmu")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"fmi": 3}, "FMI 2 here"),
        ({"platforms": ["all"]}, "this machine only"),
        ({"probes": ["x"]}, "probes are added by our own"),
        ({"overrides": {"m": "1; end Test;"}}, "no single Modelica expression"),
    ],
)
def test_what_it_cannot_do_is_refused_at_once(omc, library, options, message):
    asked = omc()
    with pytest.raises(BuildError, match=message):
        build(CLASS, libraries=[library], compiler="openmodelica", **options)
    assert not asked.exists() or "buildModelFMU" not in asked.read_text()


def test_an_unknown_compiler_is_refused():
    with pytest.raises(BuildError, match='no compiler "dymola" here; choose among rumoca, openmodelica'):
        build(CLASS, compiler="dymola")


def test_options_of_the_user_go_to_omc_behind_ours(omc, library, tmp_path):
    asked = omc()
    build(CLASS, libraries=[library], compiler="openmodelica", omc_options=["--maxSizeLinearTearing=400", "-d=x"])
    given = [line for line in asked.read_text().splitlines() if line.startswith("setCommandLineOptions")]
    assert given == [
        f'setCommandLineOptions("{o}")' for o in ("--fmiFlags=s:cvode", "--maxSizeLinearTearing=400", "-d=x")
    ]
    build(CLASS, libraries=[library], compiler="openmodelica")
    assert asked.read_text().count("buildModelFMU") == 2  # another FMU


def test_an_option_that_omc_refuses_is_said(omc, library, tmp_path):
    omc(refuses={'setCommandLineOptions("--nonsense': ["false", []]})
    with pytest.raises(BuildError, match="--nonsense"):
        build(CLASS, libraries=[library], compiler="openmodelica", omc_options=["--nonsense=1"])


@pytest.mark.parametrize(
    ("option", "compiler"), [("-d=x", "rumoca"), ("quit()", "openmodelica"), ("-d=a\nb", "openmodelica")]
)
def test_what_is_no_option_of_omc_is_refused(library, option, compiler):
    with pytest.raises(BuildError, match="omc"):
        build(CLASS, libraries=[library], compiler=compiler, omc_options=[option])


def test_open_connectors_are_named_when_omc_finds_too_few_equations(omc, tmp_path):
    messages = [["error", "Too few equations, under-determined system.", "", 0]]
    omc(refuses={"buildModelFMU": ['""', messages]})
    with pytest.raises(BuildError, match=r"port_A, port_B, port_D: .*build HydraulicTestBench\.Pump\.A4VSGSignals"):
        build("HydraulicTestBench.Pump.A4VSG", compiler="openmodelica")
