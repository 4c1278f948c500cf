"""A parameter that the compiler puts into the equations is fixed when the FMU is built; others can be set."""

from pathlib import Path

import pytest

from fmu_build.front import load
from fmu_build.lower import lower
from tests.fmu_build.lower.reference_runner import Runner

TEXT = """
package P
  function power input Real x; input Integer n; output Real y; algorithm y := 1; for i in 1:n loop y := y*x; end for;
  end power;
  function head input Real v[:]; input Integer n; output Real y; algorithm y := sum(v[1:n]) + 0*power(2, n); end head;
  function choose input Real v[:]; input Integer n; output Real y; algorithm y := if n > 1 then v[n] else 0; end choose;
  function count input Integer n; output Real y; protected Real a[n] = fill(1.0, n); algorithm y := sum(a); end count;
  function two input Integer n; output Real a; output Real b; algorithm a := count(n); b := a; end two;
  function first input Integer n; output Real y; protected Real z; algorithm (y, z) := two(n); end first;
  record R Real a; end R;
  function take input R r; output Real y; algorithm y := r.a; end take;
  connector C Real p; flow Real f; end C;
  model S C c; parameter Real p = 1; equation c.p = p; end S;
  model G C c; equation c.f = c.p; end G;
  model Part
    parameter Integer n = 2; parameter Real v[3] = {1, 2, 4}; S s[3](p = v); G g; parameter R r[3](a = v); Real y;
  equation
    __;
  end Part;
  model Whole parameter Integer n = 1; Part part(n = n + 1); Real y = part.y; end Whole;
end P;
"""


def run(equations: str, name: str, folder: Path, **given: int) -> Runner:
    file = folder / "P.mo"
    file.write_text(TEXT.replace("__", equations), encoding="utf-8")
    return Runner(lower(load(f"P.{name}", [file], given)))


@pytest.mark.parametrize(
    ("value", "two", "three"),
    [
        ("sum(v[i] for i in 1:n)", 3, 7),
        ("max({v[i] for i in 1:min(n, 3)})", 2, 4),
        ("if time < 1 then sum({v[i] for i in 1:n}) else 0", 3, 7),
        ("sum(v[1:n])", 3, 7),
        ("sum(fill(1.0, n)) + sum(linspace(0.0, 1.0, n))", 3, 4.5),
        ("power(3, n)", 9, 27),
        ("head(v, n)", 3, 7),
        ("head(n = n, v = v)", 3, 7),
        ("count(n)", 2, 3),
        ("first(n)", 2, 3),
    ],
)
def test_a_parameter_in_a_range_or_a_size_is_fixed(value: str, two: float, three: float, tmp_path: Path) -> None:
    part, whole = run(f"y = {value}", "Part", tmp_path), run(f"y = {value}", "Whole", tmp_path)
    assert {runner.variable("n").causality for runner in (part, whole)} == {"calculatedParameter"}
    assert [part.at("y"), whole.at("y"), part.variable("v[1]").causality] == [two, two, "parameter"]
    assert [run(f"y = {value}", name, tmp_path, n=n).at("y") for name, n in (("Part", 3), ("Whole", 2))] == [
        three,
        three,
    ]


@pytest.mark.parametrize("n", [2, 3])
@pytest.mark.parametrize(
    "equations",
    [
        "y = s[n].p",
        "y = r[n].a",
        "y = take(r[n])",
        "connect(s[n].c, g.c); y = g.c.f",
        "if n > 2 then connect(s[3].c, g.c); else connect(s[2].c, g.c); end if; y = g.c.f",
        "for i in n:n loop connect(s[i].c, g.c); end for; y = g.c.f",
        "for i in 1:3 loop if i == n then connect(s[i].c, g.c); end if; end for; y = g.c.f",
    ],
)
def test_so_is_one_that_chooses_a_part(equations: str, n: int, tmp_path: Path) -> None:
    found = run(equations, "Part", tmp_path, n=n)
    assert (found.variable("n").causality, found.at("y")) == ("calculatedParameter", {2: 2, 3: 4}[n])


@pytest.mark.parametrize(
    "value", ["v[n]", "n*sum(v[i] for i in 1:size(v, 1))", "choose(v, n)", "if n > 1 then v[n] else 0"]
)
def test_all_others_can_be_set(value: str, tmp_path: Path) -> None:
    assert run(f"y = {value}", "Part", tmp_path).variable("n").causality == "parameter"
    assert run(f"y = {value}", "Whole", tmp_path).variable("n").causality == "parameter"
