"""A name that is not there: the line it is written in, and the library that may be missing."""

import textwrap
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import load
from fmu_build.front.unresolved import UnresolvedName

TEXT = """\
package P
  model Part "pp is not here, nor a part(pp = 3)"
    Real a = 1; // nor is pp here
  end Part;
  function f input Real x; output Real y;
  algorithm
    y := lost*x;
  end f;
  model M
    parameter Real k = 1;
    %s
    Part part;
    %s
  end M;
  model Base
    Real b = qq;
  end Base;
end P;
"""


def refused(tmp_path: Path, above: str = "", below: str = "") -> BuildError:
    file = tmp_path / "P.mo"
    file.write_text(TEXT % (above, below), encoding="utf-8")
    with pytest.raises(BuildError) as caught:
        load("P.M", [file])
    assert caught.value.file == file
    return caught.value


@pytest.mark.parametrize(
    ("below", "line", "message"),
    [
        ("Real x = pp;", 13, "'pp'"),
        ("Real x(start = 1);\n  equation\n    der(x) = -k*x\n      + pp;", 16, "'pp'"),
        ("Prt part2;", 13, "'Prt'"),
        ("Real y = part.a + square(k);", 13, "'square'"),
        ("Real y = Oil.rho;", 13, "'Oil.rho'"),
        ("extends Bse;", 13, "Bse"),
        ("import Nowhere.Bar;", 13, "'Nowhere.Bar'"),
        ("Real y; equation\n    y =\n    .Nowhere.c;", 15, "Nowhere.c"),
        ("extends Base;", 16, "'qq'"),
        ("Base base;", 16, "'qq'"),
        ("Real y = f(k);", 7, "'lost'"),
    ],
)
def test_the_line_is_that_of_the_name(below: str, line: int, message: str, tmp_path: Path) -> None:
    error = refused(tmp_path, below=below)
    assert message in error.message
    assert error.line == line
    assert isinstance(error, UnresolvedName)
    assert "--library" not in error.message


def test_what_is_missing_in_something_declared_may_be_known_to_another_compiler(tmp_path: Path) -> None:
    error = refused(tmp_path, below="Real y = part.b;")
    assert error.line == 13
    assert not isinstance(error, UnresolvedName)


@pytest.mark.parametrize(
    ("above", "below"),
    [
        ("Modelica.Units.SI.Temperature T = 3;", ""),
        ("Real x = Modelica.Constants.pi;", ""),
        ("import Modelica.Units.SI;", "SI.Temperature T = 3;"),
        ("extends Modelica.Icons.Example;", ""),
    ],
)
def test_the_standard_library_has_to_be_named(above: str, below: str, tmp_path: Path) -> None:
    error = refused(tmp_path, above, below)
    assert error.line == 11
    assert error.message.endswith("name the Modelica Standard Library too: --library path/to/Modelica")


@pytest.mark.parametrize(
    ("kind", "cure"),
    [
        (
            "Modelica.Mechanics.Rotational.Components.Fixed",
            "name the Modelica Standard Library too",
        ),
        ("Drives.Motor", "name its library with --library"),
    ],
)
def test_a_part_whose_library_is_not_named(kind: str, cure: str, tmp_path: Path) -> None:
    error = refused(tmp_path, below=f"{kind} motor;\n  Real w = k*motor.flange.w;")
    assert error.line == 13
    assert f"motor is a {kind}, which is in none of the libraries; {cure}" in error.message
    assert isinstance(error, UnresolvedName)


def test_a_part_inside_a_part_whose_library_is_not_named(tmp_path: Path) -> None:
    (tmp_path / "Q.mo").write_text("model Q\n  Drives.Motor motor;\nend Q;\n", encoding="utf-8")
    (tmp_path / "P.mo").write_text("model P\n  Q q;\n  Real w = q.motor.w;\nend P;\n", encoding="utf-8")
    with pytest.raises(UnresolvedName, match="motor is a Drives") as caught:
        load("P", [tmp_path / "P.mo", tmp_path / "Q.mo"])
    assert (caught.value.file, caught.value.line) == (tmp_path / "Q.mo", 2)


def test_in_a_library_it_is_the_file_of_the_name(tmp_path: Path) -> None:
    library = tmp_path / "L"
    library.mkdir()
    (library / "package.mo").write_text("package L\nend L;\n", encoding="utf-8")
    part = library / "Part.mo"
    part.write_text(
        textwrap.dedent("""\
            within L;
            model Part

              Real a = nothing;
            end Part;
            """),
        encoding="utf-8",
    )
    (library / "Whole.mo").write_text("within L;\nmodel Whole\n  Part part;\nend Whole;\n", encoding="utf-8")
    with pytest.raises(UnresolvedName) as caught:
        load("L.Whole", [library])
    assert (caught.value.file, caught.value.line) == (part, 4)
