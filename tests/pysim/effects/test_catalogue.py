"""The catalogue read from Modelica text: a user's own library in one file, ours, and what is refused."""

import re
from pathlib import Path

import pytest

from fmu_build import build
from fmu_build.text import Libraries
from pysim.effects import Pair, law_constants, read_catalogue, read_pairs, variant
from pysim.io import read_model
from pysim.types import BadInput
from tests.modelica.library import LIBRARY

DRIVE = """
package Drive "A positioning drive; model, type and end in a text do not matter"
  type Torque = Real(final unit="N.m", nominal=2) "Torque";
  type Loss = Torque(min=0, max=50);
  partial model PartialFriction "Slot"
    input Real w(unit="rad/s");
    output Torque tau;
  end PartialFriction;
  package Effects
    model Bearing "Dry friction of the \\"bearing\\""  // with a comment; end Bearing;
      extends PartialFriction;
      parameter Loss T_c = 0 "Torque, 0 = off" annotation(__HydraulicTestBench(inverse="G", limits="tau"));
      parameter Real s(final unit="s/rad", min=-(1e1), max=2*5e2) = 1/2^2 "Steepness";
      parameter Real on(unit="1", min=0, max=2, nominal=1, start=1) = 1.0;
      final parameter Real known = 3;
      Real z[2](each start=0), other;
    protected
      parameter Torque unused(min=0, max=1) = 1;
    equation
      tau = -T_c*tanh(s*w);
      if w > 0 then
        z = {1, 2};
      end if;
      annotation(Documentation(info="<html>annotation(x=1); end Bearing;</html>"),
        __HydraulicTestBench(effect="drive.bearing", slot="friction", bypass=true));
    end Bearing;
    model Plain extends PartialFriction; equation tau = 0; end Plain;
    model Two "Sum"
      extends PartialFriction;
      annotation(__HydraulicTestBench(pair="friction", of={"a.b", "c.d"}));
    end Two;
  end Effects;
end Drive;
"""


def library(folder: Path, text: str, name: str = "Drive.mo") -> Path:
    (folder / name).write_text(text)
    return folder / name


def test_a_users_library_in_one_file(tmp_path: Path) -> None:
    (effect,) = read_catalogue(library(tmp_path, DRIVE))
    assert (effect.name, effect.slot, effect.class_name) == ("drive.bearing", "friction", "Drive.Effects.Bearing")
    assert effect.description == 'Dry friction of the "bearing"'
    assert effect.bypass
    assert effect.law.startswith("tau = -T_c*tanh(s*w);\nif w > 0 then\n")
    assert effect.law.endswith("\n  z = {1, 2};\nend if;")
    torque, steepness, on, unused = effect.parameters
    assert (torque.name, torque.unit, torque.min, torque.max, torque.nominal) == ("T_c", "N.m", 0.0, 50.0, 2.0)
    assert (torque.default, torque.off, torque.inverse, torque.description) == (0.0, 0.0, "G", "Torque, 0 = off")
    assert torque.limits == "tau"
    assert (steepness.min, steepness.max, steepness.default, steepness.off) == (-10.0, 1000.0, 0.25, None)
    assert steepness.nominal == 100.0  # a tenth of the larger bound, where nothing is said
    assert on.off == 1.0  # start says it
    assert unused.off is None
    assert effect.strengths == (torque, on)


def test_a_text_that_was_changed_is_read_again(tmp_path: Path) -> None:
    for torque in ("50", "60", "50"):
        (effect,) = read_catalogue(library(tmp_path, DRIVE.replace("max=50", f"max={torque}")))
        assert effect.parameters[0].max == float(torque)


def test_a_file_that_does_not_say_where_it_belongs_belongs_to_its_folder(tmp_path: Path) -> None:
    (tmp_path / "Lib" / "Sub").mkdir(parents=True)
    (tmp_path / "Lib" / "package.mo").write_text("package Lib\nend Lib;\n")
    (tmp_path / "Lib" / "Sub" / "package.mo").write_text("package Sub\nend Sub;\n")
    (tmp_path / "Lib" / "Sub" / "Drag.mo").write_text("model Drag\nend Drag;\n")
    assert sorted(one.full_name for one in Libraries([tmp_path / "Lib"]).classes()) == [
        "Lib",
        "Lib.Sub",
        "Lib.Sub.Drag",
    ]


VECTORS = """
package Drive
  partial model PartialTorque input Real w(unit="rad/s"); output Real tau(unit="N.m"); end PartialTorque;
  type Torque = Real(unit="N.m", min=-5, max=5);
  model Learned "A law between knots"
    import Own = Drive.Torque;
    extends PartialTorque;
    constant Integer n = 3 "Knots";
    constant Real knot[n] = linspace(-1, 1, n);
    parameter Own c[n](nominal={1, 2, 3}) = zeros(n) "Values";
    parameter Real[2] d(each unit="1", each min=0, max=fill(2, 2)) = {0.5, 1}, e(unit="1", min=0, max=1) = {1, 1};
  equation
    tau = c[1]*w;
    annotation(__HydraulicTestBench(effect="drive.learned", slot="friction"));
  end Learned;
end Drive;
"""


def test_each_element_of_an_array_is_a_parameter(tmp_path: Path) -> None:
    path = library(tmp_path, VECTORS)
    (effect,) = read_catalogue(path)
    assert [p.name for p in effect.parameters] == ["c[1]", "c[2]", "c[3]", "d[1]", "d[2]", "e[1]", "e[2]"]
    assert [p.nominal for p in effect.parameters[:3]] == [1.0, 2.0, 3.0]
    assert {(p.unit, p.min, p.max, p.default, p.off) for p in effect.strengths} == {("N.m", -5.0, 5.0, 0.0, 0.0)}
    assert [(p.max, p.default) for p in effect.parameters[3:5]] == [(2.0, 0.5), (2.0, 1.0)]
    assert law_constants(effect, [path]) == {"n": "3", "knot": "linspace(-1, 1, n)"}


def test_a_learned_class_compiles_with_its_elements_set(tmp_path: Path) -> None:
    own = VECTORS.replace(
        "end Drive;",
        """  model Rig
    replaceable Learned friction constrainedby PartialTorque;
    Real w(start=1, fixed=true);
  equation
    friction.w = w;
    der(w) = friction.tau;
  end Rig;
end Drive;""",
    )
    path = library(tmp_path, own)
    (effect,) = read_catalogue(path)
    values = {f"friction.c[{k}]": 0.5 * k for k in (1, 2, 3)}
    made = variant("Drive.Rig", [effect], [path], name="Learnt", values=values)
    (tmp_path / "Learnt.mo").write_text(made.text)
    model = read_model(build("Learnt", tmp_path / "a.fmu", libraries=[path, tmp_path / "Learnt.mo"]))
    assert {name: model[name].start for name in values} == values
    assert model[made.parameter("drive.learned", "c[3]")].max == 5


def test_pairs(tmp_path: Path) -> None:
    assert read_pairs(library(tmp_path, DRIVE)) == (Pair("friction", "Drive.Effects.Two", ("a.b", "c.d")),)


def test_a_class_stands_in_for_an_effect_with_events(tmp_path: Path) -> None:
    bearing = DRIVE[DRIVE.index("    model Bearing") : DRIVE.index("    model Plain")]
    other = bearing.replace("Bearing", "Smooth").replace("effect=", "smooth=").replace(", bypass=true", "")
    (effect,) = read_catalogue(library(tmp_path, DRIVE.replace("    model Plain", other + "    model Plain")))
    assert effect.smooth is not None
    assert (effect.smooth.name, effect.smooth.class_name) == ("drive.bearing", "Drive.Effects.Smooth")
    changed = other.replace("parameter Loss T_c", "parameter Loss T_d").replace("-T_c", "-T_d")
    path = library(tmp_path, DRIVE.replace("    model Plain", changed + "    model Plain"))
    with pytest.raises(BadInput, match="Smooth stands in for it"):
        read_catalogue(path)


def test_several_libraries_together(tmp_path: Path) -> None:
    names = [effect.name for effect in read_catalogue(LIBRARY, library(tmp_path, DRIVE))]
    ours = [effect.name for effect in read_catalogue(LIBRARY)]
    assert names == [*ours, "drive.bearing"]
    said = [re.findall(r'\(effect="([\w.]+)"', file.read_text(encoding="utf-8")) for file in LIBRARY.rglob("*.mo")]
    assert sorted(ours) == sorted(name for found in said for name in found)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("= zeros(n)", "= zeros(2)", r"c has 3 elements; give as many values, as in zeros\(3\)"),
        ("= zeros(n)", "= 0", "c has 3 elements"),
        ("={1, 2, 3}", "={1, 2}", "c has 3 elements"),
        ("c[n]", "c[m]", "'m' must be a number"),
        ("c[n]", "c[0]", "give one whole number"),
        ("c[n]", "c", "c has an array where a number is meant"),
        ("zeros(n)", "fill(0, 1000000, 1000000)", "must be a number"),
    ],
)
def test_refuses_arrays_that_do_not_agree(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in VECTORS
    with pytest.raises(BadInput, match=message):
        read_catalogue(library(tmp_path, VECTORS.replace(old, new, 1)))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("min=0, max=50", "max=50", "T_c has no min"),
        ('final unit="s/rad", ', "", "s has no unit"),
        ('unit="s/rad"', 'unit="s/rad(1/2)"', r"s: s/rad\(1/2\) is no unit of Modelica; write whole powers"),
        ("= 1/2^2", "= other", "'other' must be a number"),
        ("= 1/2^2", "", "s has no value"),
        ("max=2*5e2", "max=-20", "put the smaller first"),
        (', slot="friction"', "", "fills no slot"),
        ("T_c = 0", "T_c = 60", "60 is outside 0 ... 50"),
        ("T_c = 0", "T_c = 1", None),
    ],
)
def test_refuses(tmp_path: Path, old: str, new: str, message: str | None) -> None:
    text = DRIVE.replace(old, new)
    assert text != DRIVE
    path = library(tmp_path, text)
    if message is None:  # `on` is a strength still
        assert [p.name for p in read_catalogue(path)[0].strengths] == ["on"]
        return
    with pytest.raises(BadInput, match=message) as caught:
        read_catalogue(path)
    assert str(path) in str(caught.value)


def test_refuses_an_effect_without_strength_and_one_that_is_there_twice(tmp_path: Path) -> None:
    path = library(tmp_path, DRIVE.replace("T_c = 0", "T_c = 1").replace(", start=1", ""))
    with pytest.raises(BadInput, match="no parameter is 0 as declared"):
        read_catalogue(path)
    one, other = (
        library(tmp_path, DRIVE, "A.mo"),
        library(tmp_path, DRIVE.replace("package Drive", "package D").replace("end Drive", "end D"), "B.mo"),
    )
    with pytest.raises(BadInput, match=r"drive\.bearing is also in"):
        read_catalogue(one, other)


def test_refuses_what_is_no_library(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="is no Modelica library"):
        read_catalogue(tmp_path)
