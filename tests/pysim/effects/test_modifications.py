"""Values in modifications: beside what is there, in place of it, and inside of parts."""

from pathlib import Path

import pytest

from fmu_build import build
from pysim.effects import read_catalogue, variant
from pysim.effects._modifications import with_values
from pysim.io import read_model
from tests.pysim.diagnose.toy import library


@pytest.mark.parametrize(
    ("modifications", "values", "expected"),
    [
        ([], {"m": 2.0}, ["m=2.0"]),
        (["data=D.Free()"], {"m": 1e-8}, ["data=D.Free()", "m=1e-08"]),
        (["m=1 + x"], {"m": 2.0}, ["m=2.0"]),
        (["final k(min=0, max=a*(b + c))=3"], {"k": -4.5}, ["final k(min=0, max=a*(b + c))=-4.5"]),
        (["s(k=1, each d(min=0)=2)"], {"s.d": 5.0, "s.e": 6.0}, ["s(k=1, each d(min=0)=5.0, e=6.0)"]),
        (["redeclare A.B slot"], {"slot.F": 0.4}, ["redeclare A.B slot(F=0.4)"]),
        (["redeclare replaceable B slot(F=1)"], {"slot.F": 0.4}, ["redeclare replaceable B slot(F=0.4)"]),
        (["redeclare P s"], {"s.first.F": 1.0, "s.second.G": 2.0}, ["redeclare P s(first(F=1.0), second(G=2.0))"]),
    ],
)  # fmt: skip
def test_values_go_where_they_belong(modifications: list[str], values: dict[str, float], expected: list[str]) -> None:
    assert with_values(modifications, values) == expected


def test_the_fmu_of_a_class_with_values_starts_from_them(tmp_path: Path) -> None:
    (effect,) = (e for e in read_catalogue(library()) if e.name == "toy.friction")
    mine = tmp_path / "Mine.mo"
    mine.write_text('model Mine "A heavier mass"\n  extends Toy.Mass(m=3, d=0.5);\nend Mine;\n')
    values = {"m": 4.0, "k": 12.5, "force.F_c": 0.3}
    made = variant("Mine", [effect], [library(), mine], name="MineFitted", values=values, comment="Said\n\nabove.")
    assert made.text.startswith("// Said\n//\n// above.\nmodel MineFitted")
    (tmp_path / "MineFitted.mo").write_text(made.text)
    model = read_model(build("MineFitted", tmp_path / "a.fmu", libraries=[library(), tmp_path / "MineFitted.mo"]))
    assert {name: model[name].start for name in (*values, "d")} == {**values, "d": 0.5}
    assert (model["m"].max, model["force.F_c"].max) == (5, 5)  # bounds stay
