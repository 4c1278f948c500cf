"""The compiler runs in a process of its own; what it cannot say, we find out."""

import sys

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load
from fmu_build.front.rumoca import session

MODEL = "model M\n  Real x(start = 1, fixed = true);\nequation\n  der(x) = -x;\nend M;\n"


@pytest.fixture(autouse=True)
def compiler() -> None:
    """The one that users get, in its own process."""


@pytest.fixture
def file(tmp_path):
    file = tmp_path / "M.mo"
    file.write_text(MODEL, encoding="utf-8")
    return file


@pytest.mark.parametrize(
    ("worker", "said"),
    [
        ("import os, sys; print('stack overflow', file=sys.stderr, flush=True); os.abort()", "stack overflow"),
        ("raise SystemExit(7)", "exit code 7"),
        ("print('half of an ans')", "exit code 0"),
    ],
)
def test_a_compiler_that_dies_is_one_error_with_the_place_of_the_class(file, tmp_path, monkeypatch, worker, said):
    script = tmp_path / "worker.py"
    script.write_text(worker, encoding="utf-8")
    monkeypatch.setattr(session, "_WORKER", script)
    with pytest.raises(BuildError, match="the Modelica compiler crashed on M ") as caught:
        load("M", [file])
    assert said in caught.value.message
    assert (caught.value.file, caught.value.line) == (file, 1)


def test_a_compiler_without_memory_is_one_error_with_the_cure(file, tmp_path, monkeypatch):
    script = tmp_path / "worker.py"
    script.write_text(
        "import os, sys; print('memory allocation of 24 bytes failed', file=sys.stderr, flush=True); os.abort()",
        encoding="utf-8",
    )
    monkeypatch.setattr(session, "_WORKER", script)
    with pytest.raises(BuildError, match="needs more memory for M than it is given; choose smaller arrays") as caught:
        load("M", [file])
    assert (caught.value.file, caught.value.line) == (file, 1)


def test_a_compiler_that_hangs_is_ended_and_is_one_error_with_the_place_of_the_class(file, tmp_path, monkeypatch):
    script = tmp_path / "worker.py"
    script.write_text("import time; time.sleep(60)", encoding="utf-8")
    monkeypatch.setattr(session, "_WORKER", script)
    monkeypatch.setattr(session, "_LONGEST_S", 1.0)
    with pytest.raises(BuildError, match=r"not done with M within 1 s and was ended") as caught:
        load("M", [file])
    assert (caught.value.file, caught.value.line) == (file, 1)


def test_the_native_compiler_stays_out_of_this_process(file):
    loaded = {name for name in sys.modules if name.split(".")[0] == "rumoca"}
    assert load("M", [file]).name == "M"
    assert {name for name in sys.modules if name.split(".")[0] == "rumoca"} == loaded


def test_a_notebook_that_is_installed_is_not_waited_for(file, tmp_path, monkeypatch):
    """rumoca loads IPython where it finds it: as much time as it takes to start and to compile a small model."""
    (tmp_path / "IPython.py").write_text("raise SystemExit('it was loaded')", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    assert load("M", [file]).name == "M"


def test_only_libraries_that_are_named_are_read(file, tmp_path, monkeypatch):
    """What lies on MODELICAPATH is no part of the key under which the FMU is kept."""
    library = tmp_path / "path" / "Foo"
    library.mkdir(parents=True)
    (library / "package.mo").write_text("package Foo constant Real c = 9; end Foo;\n", encoding="utf-8")
    file.write_text(MODEL.replace("start = 1", "start = Foo.c"), encoding="utf-8")
    monkeypatch.setenv("MODELICAPATH", str(library.parent))
    with pytest.raises(BuildError, match=r"Foo\.c"):
        load("M", [file])
    assert load("M", [file, library]).name == "M"


def test_the_derivative_of_an_input_is_named_in_the_library_file_that_takes_it(tmp_path, capfd):
    """A panic of the compiler, which prints much to its own standard error."""
    library = tmp_path / "L"
    library.mkdir()
    (library / "package.mo").write_text("package L\nend L;\n", encoding="utf-8")
    (library / "Rate.mo").write_text(
        'within L;\nblock Rate "\N{DEGREE SIGN}/s"\n  input Real u;\n  output Real y;\n'
        "equation\n\n  y = der(u);\nend Rate;\n",
        encoding="utf-8",
    )
    with pytest.raises(BuildError, match=r"der\(\) of an input") as caught:
        load("L.Rate", [library])
    assert (caught.value.file, caught.value.line) == (library / "Rate.mo", 7)
    assert capfd.readouterr().err == ""
