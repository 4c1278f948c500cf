"""The way from class to file, with a model written by hand in the place of the front end and the lowering."""

import importlib
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import fmu_build
import fmu_build.front
import fmu_build.lower
from fmu_build import BuildError, CannotCompile, build
from fmu_build.build import bundled_library
from fmu_build.errors import WrongCall
from tests import ode_models
from tests.conftest import new_cache

build_module = importlib.import_module("fmu_build.build")


@pytest.fixture
def loads(tmp_path, monkeypatch):
    """Own cache, and a front end that gives the oscillator; collects the arguments it is called with."""
    monkeypatch.setenv("HTB_CACHE", str(new_cache(tmp_path / "cache")))
    calls = []

    def load(class_name, libraries, overrides):
        calls.append((class_name, libraries, overrides))
        return "flat model"

    monkeypatch.setattr(fmu_build.front, "load", load)
    monkeypatch.setattr(fmu_build.lower, "lower", lambda flat, probes: ode_models.oscillator(), raising=False)
    return calls


def test_a_second_build_comes_from_the_cache(loads, tmp_path):
    first = build("Test.Oscillator", tmp_path / "a.fmu", overrides={"m": 3.0})
    second = build("Test.Oscillator", tmp_path / "b.fmu", overrides={"m": 3.0})
    assert loads == [("Test.Oscillator", [bundled_library()], {"m": 3.0})]
    assert first.read_bytes() == second.read_bytes()
    assert zipfile.ZipFile(first).testzip() is None


def test_a_path_may_be_a_text(loads, tmp_path):
    assert build("Test.Oscillator", str(tmp_path / "a.fmu")) == tmp_path / "a.fmu"


def test_another_value_or_version_is_another_build(loads):
    paths = {build("A"), build("A", overrides={"m": 1.0}), build("A", fmi=3), build("A", probes=("x",)), build("A")}
    assert len(paths) == len(loads) == 4


def saving(library, times, monkeypatch):
    """A front end during whose first readings an editor saves the library; collects the texts it has read."""
    read = []

    def load(class_name, libraries, overrides):
        read.append(library.read_text())
        if len(read) <= times:
            library.write_text(f"model A // {len(read)}")
        return "flat model"

    monkeypatch.setattr(fmu_build.front, "load", load)
    return read


def test_a_file_saved_during_a_build_is_read_again_and_kept_under_its_new_text(loads, tmp_path, monkeypatch):
    library = tmp_path / "A.mo"
    library.write_text("model A")
    read = saving(library, 1, monkeypatch)
    built = build("A", libraries=[library])
    assert read == ["model A", "model A // 1"]
    assert build("A", libraries=[library]) == built
    library.write_text("model A")
    assert build("A", libraries=[library]) != built
    assert len(read) == 3


def test_files_that_never_rest_are_an_error(loads, tmp_path, monkeypatch):
    library = tmp_path / "A.mo"
    library.write_text("model A")
    saving(library, 100, monkeypatch)
    with pytest.raises(BuildError, match="change while they are read") as caught:
        build("A", libraries=[library])
    assert not isinstance(caught.value, CannotCompile)


def test_without_the_cache_it_is_built_again(loads):
    assert build("A") == build("A", use_cache=False)
    assert len(loads) == 2


def test_an_unchanged_model_needs_none_of_the_tools(loads, tmp_path):
    """What the cache holds is found without importing the compiler's parts, and so at once."""
    build("Test.Oscillator")
    script = (
        "import sys; from pathlib import Path; from fmu_build import build\n"
        f"build('Test.Oscillator', Path({str(tmp_path / 'c.fmu')!r}))\n"
        "print([m for m in ('casadi', 'rumoca', 'fmpy', 'numpy', 'ziglang') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
    assert (tmp_path / "c.fmu").exists()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"fmi": 1}, "FMI version 1"),
        ({"platforms": ["beos"]}, "beos"),
        ({"libraries": ["nowhere"]}, "the library nowhere does not exist"),
    ],
)
def test_wrong_arguments(loads, options, message):
    with pytest.raises(BuildError, match=message):
        build("A", **options)
    assert not loads


@pytest.mark.parametrize("form", [str, Path])
def test_an_unwritable_target_is_refused_before_any_work(loads, tmp_path, form):
    with pytest.raises(BuildError, match="does not exist; create it first"):
        build("A", form(tmp_path / "missing" / "a.fmu"))
    assert not loads


@pytest.mark.parametrize("package", ["rumoca", "ziglang"])
def test_a_missing_tool_is_named_with_its_cure(loads, monkeypatch, package):
    find = importlib.util.find_spec
    monkeypatch.setattr(build_module.importlib.util, "find_spec", lambda name: None if name == package else find(name))
    with pytest.raises(BuildError, match=f"pip install {package}"):
        build("A")


def test_a_failed_build_leaves_nothing_behind(loads, tmp_path, monkeypatch):
    def refuse(flat, probes):
        raise BuildError("no")

    monkeypatch.setattr(fmu_build.lower, "lower", refuse)
    with pytest.raises(BuildError, match="no"):
        build("A", tmp_path / "a.fmu")
    assert not [path for path in tmp_path.rglob("*") if path.is_file()]


def test_our_library_is_found():
    assert (bundled_library() / "package.mo").is_file()


@pytest.mark.parametrize("count", [450, 1000])  # the first is written by the compiler's process, but cannot be read
def test_an_expression_that_is_nested_too_deeply_is_the_models_fault(tmp_path, count):
    terms = " + ".join(f"{i}*u" for i in range(count))
    file = tmp_path / "Sum.mo"
    file.write_text(f"model Sum\n  input Real u;\n  output Real y;\nequation\n  y = {terms};\nend Sum;\n")
    with pytest.raises(BuildError, match=r"an expression (of Sum )?is nested too deeply"):
        build("Sum", tmp_path / "Sum.fmu", libraries=[file], use_cache=False)


def test_a_class_that_is_there_may_be_for_another_compiler(tmp_path):
    """What no compiler could take, an unknown class, is told apart."""
    file = tmp_path / "Far.mo"
    file.write_text("model Far\n  input Real u;\n  output Real y;\nequation\n  y = der(u);\nend Far;\n")
    with pytest.raises(CannotCompile, match=r"der\(\) of an input") as caught:
        build("Far", libraries=[file], use_cache=False)
    assert caught.value.file == file
    with pytest.raises(BuildError) as unknown:
        build("Near", libraries=[file], use_cache=False)
    assert not isinstance(unknown.value, CannotCompile)


@pytest.mark.parametrize("text", ["Real x = misspelt;", "Modelica.Units.SI.Temperature T = 3;"])
def test_a_name_that_is_not_there_is_for_no_compiler(tmp_path, text):
    file = tmp_path / "M.mo"
    file.write_text(f"model M\n  parameter Real k = 1;\n  {text}\nend M;\n")
    with pytest.raises(BuildError, match="unresolved") as caught:
        build("M", libraries=[file], use_cache=False)
    assert not isinstance(caught.value, CannotCompile)
    assert (caught.value.file, caught.value.line) == (file, 3)


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("Tank", {"overrides": {"Area": 1.0}}, "has no parameter Area that could be set; near it: area"),
        ("Tank", {"overrides": {"area": float("nan")}}, "the value set for area is nan"),
        ("Tank", {"probes": ["H"]}, "H"),
        ("Half", {}, "Half is a partial model; name a model"),
    ],
)
def test_a_wrong_call_is_wrong_for_every_compiler(tmp_path, name, options, message):
    file = tmp_path / f"{name}.mo"
    partial = "partial " if name == "Half" else ""
    text = "parameter Real area = 2;\n  output Real h(start = 1, fixed = true);\nequation\n  area*der(h) = -h;"
    file.write_text(f"{partial}model {name}\n  {text}\nend {name};\n")
    with pytest.raises(BuildError, match=message) as caught:
        build(name, libraries=[file], use_cache=False, **options)
    assert not isinstance(caught.value, CannotCompile)


def test_open_connectors_are_refused_with_the_class_to_build():
    """No compiler could do better, so no other is recommended."""
    with pytest.raises(
        WrongCall, match=r"shaft, port_A, port_B, port_D: .*build HydraulicTestBench\.Pump\.A4VSGSignals"
    ):
        build("HydraulicTestBench.Pump.A4VSG", use_cache=False)


def test_open_connectors_without_a_model_around_them(tmp_path):
    file = tmp_path / "Pipe.mo"
    file.write_text(
        "connector Port Real p; flow Real q; end Port;\n"
        "model Pipe Port a, b; Real r; equation a.q + b.q = 0; r = 2; r = a.p; end Pipe;\n"
    )
    with pytest.raises(WrongCall, match=r"open connectors, a, b: .*in a model of yours"):
        build("Pipe", libraries=[file], use_cache=False)


def test_an_error_of_the_model_goes_before_its_open_connectors(tmp_path):
    file = tmp_path / "Pipe.mo"
    file.write_text("connector Port Real p; flow Real q; end Port;\nmodel Pipe Port a; Real r = nowhere; end Pipe;\n")
    with pytest.raises(BuildError, match="nowhere"):
        build("Pipe", libraries=[file], use_cache=False)
