"""The front end: what it reads, and that every refusal names its place."""

import textwrap
from pathlib import Path

import pytest

from fmu_build.errors import BuildError
from fmu_build.front import expression as ex
from fmu_build.front import load
from fmu_build.front.flat_model import Experiment, Role
from fmu_build.front.rumoca.form import to_flat_model
from fmu_build.front.rumoca.refused.conditions import conditions_in_clauses


@pytest.fixture
def write(tmp_path):
    def write(text: str, name: str = "M.mo") -> Path:
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(textwrap.dedent(text).lstrip("\n"), encoding="utf-8")
        return file

    return write


@pytest.fixture
def library(write) -> Path:
    write("package L end L;", "L/package.mo")
    write("within L; package Sub end Sub;", "L/Sub/package.mo")
    write(
        """
        within L.Sub;
        model Tank "A \\"round\\" tank, 20 °C"
          type Level = Real(quantity = "Length", unit = "m", displayUnit = "mm", min = 0);
          parameter Real area(unit = "m2") = 2 "Cross section";
          input Real q "Inflow";
          output Level h(start = 1, fixed = true) "Level";
          Inner part(k = 3);
          model Inner parameter Real k = 1; output Real y = k*time; end Inner;
        equation
          area*der(h) = q;
          annotation(
            experiment(StartTime = 1, StopTime = 2.5, Tolerance = 1e-8),
            Documentation(info = "<html><p>Fills at \\"q\\".</p></html>"));
        end Tank;
        """,
        "L/Sub/Tank.mo",
    )
    return write("", "L/unused").parent


def test_a_class_of_a_library(library):
    flat = load("L.Sub.Tank", [library])
    by_name = {variable.name: variable for variable in flat.variables}
    assert (flat.name, flat.description) == ("L.Sub.Tank", 'A "round" tank, 20 °C')
    assert flat.experiment == Experiment(1.0, 2.5, 1e-8, None)
    assert flat.documentation == '<html><p>Fills at "q".</p></html>'
    level = by_name["h"]
    assert (level.quantity, level.unit, level.display_unit, level.role) == ("Length", "m", "mm", Role.STATE)
    assert level.is_output
    assert not by_name["part.y"].is_output
    assert by_name["q"].role is Role.INPUT
    assert flat.equations[-1].span.file == library / "Sub" / "Tank.mo"


def test_overrides_reach_into_components(library):
    flat = load("L.Sub.Tank", [library], {"area": 5.0, "part.k": 7})
    values = {variable.name: variable.binding for variable in flat.variables if variable.binding is not None}
    assert [values[name].value for name in ("area", "part.k")] == [5.0, 7.0]


def test_override_of_what_does_not_exist(library):
    with pytest.raises(BuildError, match="nothere"):
        load("L.Sub.Tank", [library], {"nothere": 1.0})


def test_unknown_class_and_library(library, tmp_path):
    with pytest.raises(BuildError, match="there is no Pool"):
        load("L.Sub.Pool", [library])
    with pytest.raises(BuildError, match=r"package\.mo: .*there is no Sup; near it: Sub$"):
        load("L.Sup.Tank", [library])
    with pytest.raises(BuildError, match=r"there is no tanc; near it: Tank$"):
        load("L.Sub.tanc", [library])
    with pytest.raises(BuildError, match=r"class X is not in \S+/L; give its full name"):
        load("X", [library, library])
    renamed = library.rename(tmp_path / "L-main")
    with pytest.raises(BuildError, match=r"class L\.Sub\.Tank is not in \S+/L-main; rename the folder to L, as its"):
        load("L.Sub.Tank", [renamed])
    with pytest.raises(BuildError, match="does not exist"):
        load("X", [tmp_path / "none"])


def test_another_schema_is_refused():
    with pytest.raises(BuildError, match=r"install rumoca==0\.10\.2"):
        to_flat_model(
            {"schema_version": 44},
            {},
            name="M",
            span=ex.Span(),
            experiment=Experiment(),
            documentation="",
            description="",
        )


def test_conditions_are_told_from_if_expressions():
    text = """equation
      when if a then b else c then
        x = if d then 1 else if e then 2 else 3;
        if f and (if g then h else i) then y = 1; elseif j then y = if k then 1 else 2; else y = 3; end if;
      end when;
      if l then z = 1; end if;"""
    found = [text[c.start : c.end].strip() for c in conditions_in_clauses(text)]
    assert found == ["f and (if g then h else i)", "j"]


def test_the_same_text_gives_the_same_model(library):
    first, second = (load("L.Sub.Tank", [library]) for _ in range(2))
    assert [v.name for v in first.variables] == [v.name for v in second.variables]
    assert [e.span for e in first.equations] == [e.span for e in second.equations]


SIZED = """
    model M
      parameter Integer n = 2;
      Real v[n] = fill(time, n);
    end M;
    """


def test_neighbours_of_a_single_file_are_not_read(write):
    write("model Broken Real", "Before.mo")
    write("model M Real other = 1; end M;", "Z.mo")
    file = write(SIZED)
    flat = load("M", [file])
    assert [variable.name for variable in flat.variables] == ["n", "v"]
    assert {equation.span.file for equation in flat.equations} == {file}


@pytest.mark.parametrize("value", [3, "3", "1 + 2"])
def test_an_integer_parameter_can_be_set(write, value):
    flat = load("M", [write(SIZED)], {"n": value})
    assert [variable.dimensions for variable in flat.variables if variable.name == "v"] == [(3,)]


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (3.5, r"values set, \(n = 3.5\): .*expected `Integer`"),
        ("q", r"values set, \(n = q\): unresolved"),
        (float("nan"), "n is nan"),
        *((text, "no single Modelica expression") for text in ("3;", "(3", "3)", "3, v = 4", "3 // v", '"3', "")),
    ],
)
def test_a_wrong_value_is_blamed_on_the_value(write, value, message):
    with pytest.raises(BuildError, match=message) as caught:
        load("M", [write(SIZED)], {"n": value})
    assert caught.value.file is None


def test_an_element_of_an_array_cannot_be_set_by_itself(write):
    file = write("""
        model M
          parameter Real a[2] = {1, 2};
          model Part parameter Real k = 1; end Part;
          Part part[2];
          Real x = a[1]*time;
        end M;
        """)
    with pytest.raises(BuildError, match=r"a\[2\] is a single element .*; give all of a, as in a=\{1, 5\}"):
        load("M", [file], {"a[2]": 5})
    with pytest.raises(BuildError, match=r"part\[2\]\.k is a single element .* a class that extends this one"):
        load("M", [file], {"part[2].k": 5})
    assert load("M", [file], {"a": "{1, 5}"}).name == "M"


def test_single_files_see_each_other(write) -> None:
    """A package in one file, a model that uses it in another; and a place in either is named."""
    parts = write(
        "package Parts\n  model Leak\n    Real x(start=1, fixed=true);\n  equation\n    der(x) = -x;\n"
        "  end Leak;\nend Parts;\n",
        "Parts.mo",
    )
    user = write("model Uses\n  Parts.Leak leak;\n  Real y = 2*leak.x;\nend Uses;\n", "Uses.mo")
    for order in ([parts, user], [user, parts]):
        model = load("Uses", order)
        assert {v.name for v in model.variables} == {"leak.x", "y"}
        lines = {(equation.span.file.name, equation.span.line) for equation in model.equations if equation.span.file}
        assert ("Parts.mo", 5) in lines
    parts.write_text(parts.read_text().replace("der(x) = -x", "der(x) = = x"))
    with pytest.raises(BuildError, match="syntax error") as caught:
        load("Uses", [user, parts])
    assert (caught.value.file, caught.value.line) == (parts, 5)


def test_a_library_may_use_another(tmp_path):
    """rumoca alone reads no library that only the classes of another name."""
    for name, body in (
        ("Parts", "model Lag\n  Real x(start=1, fixed=true);\nequation\n  der(x) = -x;\nend Lag;"),
        ("Plant", "model Two\n  Parts.Lag first;\n  Real y = 2*first.x;\nend Two;"),
    ):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.mo").write_text(f"within ;\npackage {name}\n{body}\nend {name};\n")
    model = load("Plant.Two", [tmp_path / "Plant", tmp_path / "Parts"])
    assert {"first.x", "y"} <= {variable.name for variable in model.variables}


def test_an_outer_parameter_is_the_inner_one(write):
    """rumoca lists it beside the inner one, without a value."""
    file = write(
        """
        package P
          model Part outer parameter Real g; Real v = 2*g; end Part;
          model M inner parameter Real g = 3; Part part; parameter Real other_outer; end M;
        end P;
        """,
        "P.mo",
    )
    flat = load("P.M", [file])
    assert [v.name for v in flat.variables if v.role is Role.PARAMETER] == ["g", "other_outer"]
