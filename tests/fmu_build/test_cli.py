"""Exit codes and messages of `fmu-build`; the build itself is replaced by what a test needs."""

from pathlib import Path

import pytest

from fmu_build import cli
from fmu_build.build import bundled_library
from fmu_build.errors import BuildError, CannotCompile
from fmu_build.front import load


@pytest.fixture
def calls(monkeypatch):
    """Arguments of each call of `build`, which does nothing."""
    found = []

    def build(class_name, output, **options):
        found.append((class_name, output, options))
        return output

    monkeypatch.setattr(cli, "build", build)
    return found


def test_arguments_arrive(calls, capsys):
    command = ["A.B", "-o", "x.fmu", "--library", "L", "--library", "M.mo", "--fmi", "3", "--no-cache"]
    command += ["--platform", "all", "--set", "a.b=3", "--set", "on = true", "--probe", "x", "--probe", "a.f"]
    command += ["--compiler", "openmodelica", "--omc-option=-d=x", "--omc-option=--y=2"]
    assert cli.main(command) == 0
    options = {
        "libraries": [Path("L"), Path("M.mo")],
        "fmi": 3,
        "platforms": ["all"],
        "overrides": {"a.b": 3.0, "on": "true"},
        "probes": ["x", "a.f"],
        "use_cache": False,
        "compiler": "openmodelica",
        "omc_options": ["-d=x", "--y=2"],
    }
    assert calls == [("A.B", Path("x.fmu"), options)]
    assert capsys.readouterr().out.strip() == "x.fmu"


def test_defaults(calls):
    assert cli.main(["A.B"]) == 0
    options = {"libraries": [], "fmi": 2, "platforms": ["host"], "overrides": {}, "probes": [], "use_cache": True}
    options |= {"compiler": "rumoca", "omc_options": []}
    assert calls == [("A.B", Path("A.B.fmu"), options)]


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ([], "CLASS"),
        (["A", "--fmi", "4"], "--fmi"),
        (["A", "--set", "a"], "NAME=VALUE"),
        (["A", "--set", "=3"], "NAME=VALUE"),
        (["A", "--set", "a=1", "--set", "a=2"], "a is set twice"),
        (["A", "--nonsense"], "--nonsense"),
        (["A", "--compiler", "dymola"], "--compiler"),
    ],
)
def test_wrong_use(calls, capsys, command, message):
    assert cli.main(command) == 2
    assert message in capsys.readouterr().err
    assert not calls


def test_help_is_no_mistake(capsys):
    assert cli.main(["--help"]) == 0
    assert "x86_64-windows" in capsys.readouterr().out


def test_the_example_of_the_help_can_be_built(calls, capsys):
    cli.main(["--help"])
    line = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("  fmu-build "))
    assert cli.main(line.split()[1:]) == 0
    [(class_name, _, options)] = calls
    flat = load(class_name, [bundled_library()], options["overrides"])
    values = {variable.name: variable.binding for variable in flat.variables}
    assert {name: values[name].value for name in options["overrides"]} == options["overrides"]


def fail_with(monkeypatch, error):
    def build(*arguments, **options):
        raise error

    monkeypatch.setattr(cli, "build", build)


def test_a_bad_model_is_one_line_with_its_place(monkeypatch, capsys):
    fail_with(monkeypatch, BuildError("unknown class C", Path("A.mo"), 7))
    assert cli.main(["A"]) == 2
    assert capsys.readouterr().err == "fmu-build: A.mo:7: unknown class C\n"


def test_our_own_mistake_has_its_own_code(monkeypatch, capsys):
    fail_with(monkeypatch, ZeroDivisionError("x"))
    monkeypatch.delenv("HTB_DEBUG", raising=False)
    assert cli.main(["A"]) == 3
    error = capsys.readouterr().err
    assert "ZeroDivisionError: x" in error
    assert "Traceback" not in error
    monkeypatch.setenv("HTB_DEBUG", "1")
    assert cli.main(["A"]) == 3
    assert "Traceback" in capsys.readouterr().err


@pytest.fixture
def two_compilers(monkeypatch):
    """Ours takes nothing but is told of each class; `openmodelica` takes all. Returns who was asked."""
    asked = []

    def build(class_name, output, *, compiler, **options):
        asked.append(compiler)
        if compiler == "rumoca":
            raise CannotCompile("external functions are not supported", Path("A.mo"), 7)
        return output

    monkeypatch.setattr(cli, "build", build)
    return asked


def test_what_ours_cannot_take_goes_to_openmodelica(two_compilers, monkeypatch, capsys):
    monkeypatch.setattr(cli, "what_is_missing", lambda: "")
    assert cli.main(["A", "-o", "x.fmu"]) == 0
    out, err = capsys.readouterr()
    assert two_compilers == ["rumoca", "openmodelica"]
    assert out.strip() == "x.fmu"
    assert "A.mo:7: external functions are not supported" in err  # nobody is to wonder which compiler it was
    assert "now trying OpenModelica" in err


def test_where_it_is_missing_the_advice_says_what_to_do(two_compilers, monkeypatch, capsys):
    monkeypatch.setattr(cli, "what_is_missing", lambda: "omc is not installed: get it")
    assert cli.main(["A"]) == 2
    first, second = capsys.readouterr().err.splitlines()
    assert two_compilers == ["rumoca"]
    assert first == "fmu-build: A.mo:7: external functions are not supported"
    assert (
        second == "fmu-build: OpenModelica may take what our own compiler does not, but omc is not installed: get it."
    )


def test_a_compiler_that_is_named_is_the_only_one(two_compilers, monkeypatch, capsys):
    monkeypatch.setattr(cli, "what_is_missing", lambda: "")
    assert cli.main(["A", "--compiler", "rumoca"]) == 2
    assert cli.main(["A", "--compiler", "openmodelica"]) == 0
    assert two_compilers == ["rumoca", "openmodelica"]
    assert "now trying" not in capsys.readouterr().err
