"""A record that a part is given stays the record that others set, also where its own modification gives the values."""

from pathlib import Path

import pytest

from fmu_build.front import load
from fmu_build.lower import lower
from tests.fmu_build.lower.reference_runner import Runner

TEXT = """
package P
  record Data Real a = 1; Real b = 2; end Data;
  model Part parameter Data d; Real y = d.a + 10*d.b; end Part;
  model Whole parameter Data d; Part x(d = d); end Whole;
  model M
    parameter Real q = 4;
    parameter Data k(a = 4);
    parameter Data follows(a = q + 0);
    parameter Data d(a = 6, b = 5);
    Part x(d = k), z[2](each d = k), f(d = follows), o(d = d), own(d(a = 4));
    Whole w(d = k), v(d(a = 4));
  end M;
end P;
"""
BEFORE = {"x": 24, "z[2]": 24, "f": 24, "o": 56, "own": 24, "w.x": 24, "v.x": 24}


@pytest.mark.parametrize(
    ("settings", "changed"),
    [
        ({}, {}),
        ({"k.a": 5}, {"x": 25, "z[2]": 25, "w.x": 25}),
        ({"k.b": 3}, {"x": 34, "z[2]": 34, "w.x": 34}),
        ({"q": 5}, {"f": 25}),
        ({"d.b": 6}, {"o": 66}),
        ({"own.d.a": 5}, {"own": 25}),
        ({"v.d.a": 5}, {"v.x": 25}),
    ],
)
def test_parts_follow_their_records(settings: dict[str, float], changed: dict[str, float], tmp_path: Path) -> None:
    file = tmp_path / "P.mo"
    file.write_text(TEXT, encoding="utf-8")
    run = Runner(lower(load("P.M", [file])), settings)
    assert {name: run.at(f"{name}.y") for name in BEFORE} == BEFORE | changed
